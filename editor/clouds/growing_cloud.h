// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "editor/bodies/sweep.h"
#include "editor/clouds/underlay_view.h"

namespace standpoint {

// A thinned scan that appears in the scene as the beam passes: written by the thread that simulates it, looked at by
// the one that draws. It is cut like a cake, so that what is there already stays as it is when more comes.
class GrowingCloud : public PointSink {
 public:
  static constexpr std::uint64_t kMostPoints = 160000;
  static constexpr std::size_t kParts = 96;  // all around

  GrowingCloud(const SweepShape& shape, const Eigen::Vector3d& shift_m) : shape_(shape), maker_(shift_m) {}
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

  // What the beam has passed when the head has done that share of its turn, as far as it is simulated; local frame.
  std::vector<ShownUnderlay> shown(double share) const;

 private:
  void finish(std::size_t part);
  double endOf(std::size_t part) const;

  SweepShape shape_;
  mutable std::mutex mutex_;
  CloudPointMaker maker_;
  std::uint64_t step_ = 1, seen_ = 0, columns_ = 1;
  std::optional<CloudColouring> colouring_;  // of the first part: the same for all
  std::vector<std::vector<CloudPoint>> points_;
  std::vector<std::shared_ptr<const Cloud>> parts_;  // null: not all of it is there
};

}  // namespace standpoint
