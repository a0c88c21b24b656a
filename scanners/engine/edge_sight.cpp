// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_sight.h"

#include <algorithm>
#include <cmath>

#include "scanners/engine/scan_plan.h"

namespace standpoint {

namespace {

constexpr double kCreaseReach = 0.8;  // in w: beyond that a beam's light is too little for a bend to matter
constexpr double kSteepest = 20;      // beyond it: tan of the incidence at which a surface still shows its edge

// How much the range changes along the plane of edge and `beside` for each metre across the edge: the plane's slope to
// the beam. `lateral` is across both, a unit vector.
double slopeOf(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& beside,
               const Eigen::Vector3d& lateral) {
  const Eigen::Vector3d normal = (to - from).cross(beside - from);
  const Eigen::Vector3d middle = 0.5 * (from + to);
  return -normal.dot(lateral) * middle.norm() / normal.dot(middle);
}

}  // namespace

double edgeReach(const Instrument& instrument, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                 const Eigen::Vector3d& left, const Eigen::Vector3d& right) {
  Eigen::Vector3d lateral = from.cross(to);  // the plane of edge and eye
  const double length = lateral.norm();
  if (!(length > 1e-12 * from.norm() * to.norm())) return kBeamEdge;  // seen end-on
  lateral /= length;
  if (lateral.dot(left) * lateral.dot(right) >= 0) return kBeamEdge;  // both go on to the same side: an outline
  const double bend = std::abs(slopeOf(from, to, left, lateral) - slopeOf(from, to, right, lateral));
  const double range = std::max(0.01, std::max(from.norm(), to.norm()));
  const double off = bend * kCreaseReach * beamRadius(instrument, range);
  return off > edgeTolerance(instrument, range) || !std::isfinite(off) ? kCreaseReach : 0;
}

// `towards` meets the plane of what the axis meets before the edge.
bool edgeShows(const ScanPlan& plan, FacetCache& facets, const NearestHit& axis, const Eigen::Vector3d& origin,
               const Eigen::Vector3d& towards, float range_m, double time_s) {
  if (axis.facet == kNoFacet) return true;
  const MetFacet& met = facets.of(axis.facet);
  if (plan.passes(*met.optics)) return true;
  const auto range = static_cast<double>(range_m);
  const double aside = kBeamEdge * beamRadius(plan.instrument, range);
  if (range - static_cast<double>(axis.range_m) > kSteepest * aside) return false;
  const bool moves = met.facet.body != kNoBody;
  const Facet moved = moves ? facets.met(axis.facet, origin, towards, time_s).facet : Facet{};
  const Facet& facet = moves ? moved : met.facet;
  const double on_plane = (facet.offset - facet.normal.dot(origin)) / facet.normal.dot(towards);
  return on_plane < 0 || range <= on_plane + edgeTolerance(plan.instrument, range);
}

// The range r for which r - hit = kSteepest times the beam's edge there, of which w(r) ≤ D/2 + γr/2.
double farthestEdge_m(const ScanPlan& plan, FacetCache& facets, const NearestHit& axis) {
  if (axis.facet == kNoFacet || plan.passes(*facets.of(axis.facet).optics)) return plan.farthest_m;
  const double lean = kSteepest * kBeamEdge / 2, divergence = lean * plan.instrument.divergence_rad;
  if (divergence >= 1) return plan.farthest_m;
  const double from = std::max(static_cast<double>(axis.range_m + kBehindHit_m),
                               static_cast<double>(axis.range_m) + lean * plan.instrument.exit_diameter_m);
  return std::min(plan.farthest_m, from / (1 - divergence));
}

}  // namespace standpoint
