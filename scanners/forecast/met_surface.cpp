// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/forecast/met_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "scanners/engine/embree_scene.h"
#include "scanners/engine/pane_passage.h"

namespace standpoint {

namespace {

// Whether beams a little beside the point meet the same surface in the same plane.
bool isEdge(const RayScene& scene, const Eigen::Vector3d& station, const Eigen::Vector3d& point, const MetSurface& met,
            double edge_m) {
  const Eigen::Vector3d direction = (point - station) / met.range_m;
  const Eigen::Vector3d u = direction.unitOrthogonal() * edge_m, v = direction.cross(u);
  for (const Eigen::Vector3d& beside : {u, Eigen::Vector3d(-u), v, Eigen::Vector3d(-v)}) {
    const Eigen::Vector3d way = point + beside - station;
    const auto hit = scene.intersect(station, way.normalized(), std::numeric_limits<double>::infinity());
    if (!hit || hit->product != met.product || hit->surface != met.surface) return true;
    if (std::abs(met.normal.dot(hit->position - point) - met.off_m) > edge_m / 2) return true;
  }
  return false;
}

}  // namespace

MetSurface meetSurface(const Expectation& expectation, const Eigen::Vector3d& station, const Eigen::Vector3d& point,
                       const MeetingTolerance& tolerance) {
  const auto& scene = static_cast<const EmbreeScene&>(expectation.scene());
  MetSurface met;
  const Eigen::Vector3d way = point - station;
  met.range_m = way.norm();
  if (!(met.range_m > 1e-3)) return met;
  const Eigen::Vector3d direction = way / met.range_m;
  bool through_glass = false;
  double from = 0;
  for (int face = 0; face < kMostPanes; ++face) {
    const NearestHit hit = scene.nearest(station, direction, from, std::numeric_limits<double>::infinity());
    if (hit.facet == kNoFacet) break;
    const Facet facet = scene.facet(hit.facet).metBy(station, direction);
    const double range = rangeOnPlane(facet, station, direction, hit.range_m);
    const double cosine = std::abs(facet.normal.dot(direction));
    const Eigen::Vector3d met_side = facet.normal.dot(direction) < 0 ? facet.normal : Eigen::Vector3d(-facet.normal);
    const double off = (met.range_m - range) * cosine;
    if (off < -tolerance.window_m) break;
    const bool pane = expectation.opticsAt(facet.instance, facet.triangle).transparent;
    if (off <= tolerance.window_m && (!pane || std::abs(off) <= tolerance.met_m)) {
      met.meeting = std::abs(off) > tolerance.met_m ? BeamMeeting::near
                    : through_glass                 ? BeamMeeting::behind_pane
                                                    : BeamMeeting::met;
      met.cosine = cosine;
      met.off_m = off;
      met.normal = met_side;
      met.product = facet.product;
      met.surface = facet.surface;
      met.material = expectation.materialAt(facet.instance, facet.triangle);
      if (met.meeting == BeamMeeting::met && isEdge(scene, station, point, met, tolerance.edge_m))
        met.meeting = BeamMeeting::edge;
      return met;
    }
    if (!pane) {
      met.meeting = BeamMeeting::behind;
      met.product = facet.product;
      met.surface = facet.surface;
      return met;
    }
    through_glass = true;
    from = hit.range_m + kBehindFace_m;
  }
  return met;
}

}  // namespace standpoint
