// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/footprint.h"
#include "scanners/scan_plan.h"

namespace standpoint {

// How many pulses aside a beam may reach.
constexpr std::uint32_t kMostReach = 8;

// The beams of one column: where they start and what their axes meet first.
class ColumnHits {
 public:
  explicit ColumnHits(const ScanPlan& plan);
  void trace(std::uint32_t column);
  std::uint32_t column() const { return column_; }
  NearestHit hit(std::uint32_t row) const { return {facets_[row + kMostReach], ranges_[row]}; }
  // Facets from a row on; kMostReach before the first row and as many beyond the last packet are there, without a facet.
  const std::uint64_t* facets(std::uint32_t row) const { return facets_.data() + row + kMostReach; }
  RayLine axis(std::uint32_t row) const;
  Beam beam(std::uint32_t row) const;

 private:
  struct Axes {
    Eigen::Vector3d origin, ahead, across, up;
  };
  Axes axes(std::uint32_t row) const;

  const ScanPlan* plan_;                // they change places
  std::uint32_t column_ = ~0U;
  Eigen::Vector3d ahead_, lateral_;     // horizontal unit vectors of the scanner's frame; up is its z
  Axes still_;                          // of a scanner that does not move
  std::vector<std::uint64_t> facets_;
  std::vector<float> ranges_;
};

}  // namespace standpoint
