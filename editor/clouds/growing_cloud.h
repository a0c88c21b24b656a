// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "editor/bodies/sweep.h"
#include "editor/clouds/underlay_view.h"

namespace standpoint {

// A thinned scan that appears in the scene as the beam passes: written by the thread that simulates it, looked at by
// the one that draws. It is cut like a cake, so that what is there already stays as it is when more comes. Where the
// beam is ahead of the simulation, plain rays say what it meets, until the measured points take their place.
class GrowingCloud : public PointSink {
 public:
  static constexpr std::uint64_t kMostPoints = 160000;
  static constexpr std::size_t kParts = 96;  // all around

  GrowingCloud(const SweepShape& shape, const Eigen::Vector3d& shift_m) : shape_(shape), maker_(shift_m) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  // From where it is truly scanned: said before the scan begins, its points are shown where the beam was, whatever the
  // surveyor believes of the station. Without a scene nothing is shown ahead of the simulation.
  void foresee(std::shared_ptr<const RayScene> scene, const StandingInstrument& stands);
  // What the beam has passed when the head has done that share of its turn; nothing: it measures no more, so what it
  // had passed, or all when all is simulated. Local frame.
  std::vector<ShownUnderlay> shown(std::optional<double> share);

 private:
  void finish(std::size_t part);
  double endOf(std::size_t part) const;

  SweepShape shape_;
  mutable std::mutex mutex_;
  CloudPointMaker maker_;
  std::uint64_t step_ = 1, seen_ = 0, columns_ = 1;
  std::optional<CloudColouring> colouring_;  // of the first part: the same for all
  std::vector<std::vector<CloudPoint>> points_;
  std::vector<std::shared_ptr<const Cloud>> parts_ =
      std::vector<std::shared_ptr<const Cloud>>(kParts);  // null: not all of it is there
  bool whole_ = false;                                    // all of them are
  double passed_ = 0;
  std::shared_ptr<const RayScene> scene_;
  StandingInstrument stands_;
  std::vector<std::shared_ptr<const Cloud>> foreseen_ = std::vector<std::shared_ptr<const Cloud>>(kParts);
};

}  // namespace standpoint
