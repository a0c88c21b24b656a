// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numbers>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/faceted.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

Eigen::Vector3d vertex(const Entity& v, Scope& scope) { return cartesianPoint(v.ref(0), scope); }

// The part of a closed or open curve between two of its points, in the curve's own direction.
Path between(const Path& path, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  std::vector<Eigen::Vector3d> ring = path.points;
  const auto nearest = [&](const Eigen::Vector3d& p) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < ring.size(); ++i)
      if ((ring[i] - p).squaredNorm() < (ring[best] - p).squaredNorm()) best = i;
    return best;
  };
  if (!path.closed) {
    Path part;
    const std::size_t a = nearest(from), b = nearest(to);
    appendPoint(part, from);
    for (std::size_t i = a + 1; i < b; ++i) appendPoint(part, ring[i]);
    appendPoint(part, to);
    return part;
  }
  Path part;
  appendPoint(part, from);
  const std::size_t n = ring.size(), a = nearest(from), b = nearest(to);
  for (std::size_t i = (a + 1) % n, k = 0; i != b && k < n; i = (i + 1) % n, ++k) appendPoint(part, ring[i]);
  appendPoint(part, to);
  return part;
}

// Along the edge from its start to its end vertex.
Result<Path> edgePath(const Entity& edge, Scope& scope) {
  const Eigen::Vector3d start = vertex(edge.ref(0), scope), end = vertex(edge.ref(1), scope);
  if (!edge.is("IFCEDGECURVE")) return Path{{start, end}, false};
  Entity basis = edge.ref(2);
  if (basis.is("IFCSURFACECURVE") || basis.is("IFCSEAMCURVE") || basis.is("IFCINTERSECTIONCURVE"))
    basis = spatialCurve(basis);
  const bool same_sense = edge[3].symbol() != "F";
  const Eigen::Vector3d &from = same_sense ? start : end, &to = same_sense ? end : start;
  Path path;
  if (basis.is("IFCLINE")) {
    path.points = {from, to};
  } else if (basis.is("IFCCIRCLE") || basis.is("IFCELLIPSE")) {
    TRY_ASSIGN(const auto c, conic(basis, scope));
    const double a = c.angleOf(from);
    double sweep = c.angleOf(to) - a;
    if (sweep <= 1e-9) sweep += 2 * std::numbers::pi;
    path = arc(c, a, sweep, scope);
    path.points.front() = from;
    path.points.back() = to;
  } else {
    auto whole = curve(basis, scope);
    if (!whole && (from - to).norm() < 1e-6) return Path{{from}, false};  // an edge without length, at a pole
    if (!whole) return whole;
    if ((from - to).norm() < 1e-6) {
      if (whole->closed) whole->points.push_back(whole->points.front());
      path.points = whole->points;
    } else {
      path = between(*whole, from, to);
    }
  }
  if (!same_sense) reverse(path);
  return path;
}

}  // namespace

Result<std::vector<Eigen::Vector3d>> loopPoints(const Entity& loop, Scope& scope) {
  std::vector<Eigen::Vector3d> points;
  if (loop.is("IFCPOLYLOOP")) {
    for (const Entity& p : loop.refs(0)) points.push_back(cartesianPoint(p, scope));
    return points;
  }
  if (loop.is("IFCVERTEXLOOP")) return points;  // an apex or a pole: bounds nothing
  if (!loop.is("IFCEDGELOOP")) return fail(loop, "a loop of this kind is not supported");
  Path path;
  for (const Entity& oriented : loop.refs(0)) {
    TRY_ASSIGN(auto edge, edgePath(oriented.is("IFCORIENTEDEDGE") ? oriented.ref(2) : oriented, scope));
    if (oriented[3].symbol() == "F" && oriented.is("IFCORIENTEDEDGE")) reverse(edge);
    if (!scope.spend(edge.points.size())) return fail(loop, "too many points");
    for (const auto& p : edge.points) appendPoint(path, p);
  }
  if (path.points.size() > 1 && (path.points.front() - path.points.back()).norm() < 1e-6) path.points.pop_back();
  return path.points;
}

}  // namespace standpoint::ifc
