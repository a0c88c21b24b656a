// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/curve.h"

namespace standpoint::ifc {
namespace {

constexpr double kJoin_m = 1e-5;  // exporters round the ends of neighbouring segments differently

bool meets(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm() <= kJoin_m; }

// Some exporters state the wrong sense; a segment is turned when only that way it meets its neighbour.
void orientToNeighbours(std::vector<Path>& segments) {
  if (segments.size() > 1) {
    const auto &a = segments[0].points, &b = segments[1].points;
    const bool meets_now = meets(a.back(), b.front()) || meets(a.back(), b.back());
    if (!meets_now && (meets(a.front(), b.front()) || meets(a.front(), b.back()))) reverse(segments[0]);
  }
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const Eigen::Vector3d end = segments[i - 1].points.back();
    if (!meets(end, segments[i].points.front()) && meets(end, segments[i].points.back())) reverse(segments[i]);
  }
}

}  // namespace

Result<Path> compositeCurve(const Entity& entity, Scope& scope) {
  std::vector<Path> segments;
  for (const Entity& segment : entity.refs(0)) {
    if (segment.is("IFCCURVESEGMENT")) return alignmentPlan(entity, scope);
    auto part = curve(segment.ref(2), scope);
    if (!part) return part;
    if (part->closed) part->points.push_back(part->points.front());
    if (part->points.size() < 2) continue;
    if (segment[1].symbol() == "F") reverse(*part);
    segments.push_back(std::move(*part));
  }
  if (segments.empty()) return fail(entity, "the composite curve has no valid segment");
  orientToNeighbours(segments);
  Path path;
  for (Path& segment : segments) {
    // Where neighbours nearly meet one point stands for both, else slivers stay in the outline.
    const bool joined = !path.points.empty() && meets(path.points.back(), segment.points.front());
    for (std::size_t i = joined ? 1 : 0; i < segment.points.size(); ++i) appendPoint(path, segment.points[i]);
  }
  path.start_tangent = segments.front().start_tangent;
  path.end_tangent = segments.back().end_tangent;
  if (path.points.size() > 2 && meets(path.points.front(), path.points.back())) {
    path.points.pop_back();
    path.closed = true;
  }
  if (path.points.size() < 2) return fail(entity, "the composite curve has fewer than two different points");
  return path;
}

}  // namespace standpoint::ifc
