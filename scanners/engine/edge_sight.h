// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "scanners/engine/facet_cache.h"
#include "scanners/engine/footprint.h"

namespace standpoint {

constexpr float kBehindHit_m = 0.1F;  // that an edge of a round body may be behind what the axis meets of it

// How far out in a beam an edge matters, in w; 0: nowhere. Corners as seen from the scanner at the origin; `left` and
// `right` are what the two triangles at the edge have beside it.
double edgeReach(const Instrument& instrument, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                 const Eigen::Vector3d& left, const Eigen::Vector3d& right);

// Of an edge at a range, farther off than what the beam's axis meets: is it seen all the same, since that surface runs
// away from the scanner, or is glass? `towards` is the way from the beam's origin to it, of about unit length;
// `time_s` that of the pulse, by the clock of what moves.
bool edgeShows(const ScanPlan& plan, FacetCache& facets, const NearestHit& axis, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& towards, float range_m, double time_s);

// No edge shows that is farther off than this.
double farthestEdge_m(const ScanPlan& plan, FacetCache& facets, const NearestHit& axis);

}  // namespace standpoint
