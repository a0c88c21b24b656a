// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/facet_cache.h"
#include "scanners/engine/footprint.h"
#include "scanners/engine/scan_plan.h"

namespace standpoint {

// How many pulses aside a beam may reach.
constexpr std::uint32_t kMostReach = 8;

// Axes of sixteen beams side by side, local frame.
struct alignas(64) AxisLanes {
  double origin_x[kPacket] = {}, origin_y[kPacket] = {}, origin_z[kPacket] = {};
  double direction_x[kPacket] = {}, direction_y[kPacket] = {}, direction_z[kPacket] = {};
};

// The beams of one column: where they start and what their axes meet first. Sixteen rows are traced when they are
// needed: of the columns beside those that are worked on, few are.
class ColumnHits {
 public:
  explicit ColumnHits(const ScanPlan& plan);
  void begin(std::uint32_t column);
  // Of the sixteen rows from a multiple of sixteen on. What is asked below must have been needed before.
  void need(std::uint32_t first_row, FacetCache& facets) {
    if (!traced_[first_row / kPacket]) trace(first_row, facets);
  }
  std::uint32_t column() const { return column_; }
  NearestHit hit(std::uint32_t row) const { return {facets_[row], ranges_[row]}; }
  // From a row on; there is a whole packet's worth, beyond the last row without a facet and at the longest range.
  const std::uint64_t* facets(std::uint32_t row) const { return facets_.data() + row; }
  const float* ranges_m(std::uint32_t row) const { return ranges_.data() + row; }
  // Planes from a row on, where beams have a width; kMostReach before the first row and as many beyond the last packet
  // are there, without a plane.
  const std::uint32_t* planes(std::uint32_t row) const { return planes_.data() + row + kMostReach; }
  RayLine axis(std::uint32_t row) const;
  // The same of the rows from one on; good until more rows are needed or asked for.
  const AxisLanes& axes(std::uint32_t first_row);
  Beam beam(std::uint32_t row) const;
  // Horizontal unit vectors of the scanner's frame.
  const Eigen::Vector3d& ahead() const { return ahead_; }
  const Eigen::Vector3d& lateral() const { return lateral_; }

 private:
  struct Axes {
    Eigen::Vector3d origin, ahead, across, up;
  };
  Axes axesAt(std::uint32_t row) const;
  void trace(std::uint32_t first_row, FacetCache& facets);
  void findPlanes(std::uint32_t first_row, FacetCache& facets);

  const ScanPlan* plan_;  // they change places
  std::uint32_t column_ = ~0U;
  Eigen::Vector3d ahead_, lateral_;  // up is the scanner's z
  Axes still_;                       // of a scanner that does not move
  AxisLanes lanes_;                  // of the rows looked at last
  RayPacket rays_{};
  std::vector<char> traced_;  // each sixteen rows
  std::vector<std::uint64_t> facets_;
  std::vector<float> ranges_;
  std::vector<std::uint32_t> planes_;
  std::uint64_t last_facet_ = kNoFacet;  // looked up last
  std::uint32_t last_plane_ = kNoPlane;
};

}  // namespace standpoint
