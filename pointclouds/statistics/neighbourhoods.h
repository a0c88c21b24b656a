// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "core/points.h"
#include "pointclouds/statistics/coverage.h"

namespace standpoint {

// A point of the cloud and what lies around it.
struct Neighbourhood {
  std::uint64_t index = 0;  // of the point, in the order of the file
  std::uint32_t scan = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // file frame
  Eigen::Vector3d beam = Eigen::Vector3d::Zero();    // unit, from the scanner
  double intensity = 0;
  struct Neighbour {
    Eigen::Vector3f from_centre;
    bool same_scan;
  };
  std::vector<Neighbour> neighbours;  // without the point itself; at most kMostNeighbours, drawn evenly
  std::uint64_t seen = 0;
};
inline constexpr std::size_t kMostNeighbours = 512;

// The 1 sigma of a plane's points along the beam. Nothing where they are no plane: fewer than 12, a strip rather than a
// patch (its middle spread below five times the smallest), a residual beyond four sigma, grazing (cos below 0.3).
std::optional<double> planeNoise(const Neighbourhood& at);
// Distance of the centre to the plane of its neighbours; nothing with fewer than three.
std::optional<double> roughness(const Neighbourhood& at);

// Second pass: hands each point to the neighbourhoods that it belongs to.
class NeighbourSink final : public PointSink {
 public:
  NeighbourSink(std::vector<Neighbourhood>& all, double radius_m);
  Result<void> begin(const ScanHeader& header) override;
  Result<void> write(const PointBlock& block) override;
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }

 private:
  struct Entry {
    std::uint64_t cell;
    std::uint32_t neighbourhood;
  };
  void offer(Neighbourhood& to, const Eigen::Vector3d& point);
  std::vector<Neighbourhood>& all_;
  double radius_m_;
  std::vector<Entry> entries_;  // sorted by cell
  std::vector<bool> any_;       // by the low bits of a cell's hash: rules most points out at once
  Pose pose_;
  std::uint32_t scan_ = 0;
  std::uint64_t index_ = 0;
  bool begun_ = false;
};

}  // namespace standpoint
