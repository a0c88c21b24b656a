// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "scanners/engine/beam_paths.h"
#include "scanners/engine/edge_map.h"

namespace standpoint {

// Light that a spot in a concave corner sends to the surface beside it, from there it comes to the receiver as long as
// that sees it: later than the spot's own, so that the range is too long (physics.md §4.14). A phase-shift instrument
// adds it to the phasor of the spot's.
//
// One bounce: x_b / x = ρ_Q ∫ cos α cos β cos γ / (π d²) dQ / cos θ over what the field of view holds, by sixteen rays
// from the receiver in a pattern of the pulse's own. The bounce adds to power and path of the ends themselves.
class CornerLight {
 public:
  CornerLight(const ScanPlan& plan, FacetCache& facets) : plan_(plan), facets_(facets) {}
  // To the ends from `from` on, of the pulse of this column and row, that light reaches directly.
  void add(const Beam& beam, std::uint32_t column, std::uint32_t row, std::vector<PathEnd>& ends, std::size_t from);

 private:
  // What a ray of the field of view meets.
  struct Patch {
    Eigen::Vector3d place, normal;                // towards the receiver
    double range_m = 0, area_m2 = 0, facing = 0;  // of the surface; cos γ
    double reflectance = 0;
    std::uint64_t facet = kNoFacet;
  };
  void look(const Beam& beam, std::uint32_t column, std::uint32_t row);
  void addTo(PathEnd& end) const;

  const ScanPlan& plan_;
  FacetCache& facets_;
  std::vector<Patch> patches_;
};

// Whether light goes on from one surface to another beside an edge: the surfaces at it bend towards the scanner, or
// beside the one that is seen something else stands. Corners of the edge in the scanner's frame, which is where
// `local_from_scanner` says; `right` is null where the mesh ends.
bool isConcave(const EmbreeScene& scene, const Eigen::Affine3d& local_from_scanner, const Eigen::Vector3d& from,
               const Eigen::Vector3d& to, const Eigen::Vector3d& left, const Eigen::Vector3d* right);

}  // namespace standpoint
