// SPDX-License-Identifier: GPL-3.0-or-later
// Curves at a distance from another one.
#include "importers/ifc/shapes/alignment.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

// Each point moved to the left of the curve as seen against `up`, mitred: the distance holds on both sides of a corner.
Path movedLeft(const Path& basis, const Eigen::Vector3d& up, double distance_m) {
  Path moved;
  moved.closed = basis.closed;
  const auto& p = basis.points;
  const std::size_t n = p.size();
  const auto left = [&](std::size_t i) { return Eigen::Vector3d(up.cross(p[(i + 1) % n] - p[i]).normalized()); };
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0 && !basis.closed, last = i + 1 == n && !basis.closed;
    const Eigen::Vector3d out = last ? left(i - 1) : left(i), in = first ? out : left((i + n - 1) % n);
    const double both = 1 + in.dot(out);
    appendPoint(moved, p[i] + (both > 0.1 ? Eigen::Vector3d((in + out) / both) : out) * distance_m);
  }
  return moved;
}

// Lateral and vertical distances between the stated ones change in a straight line along the curve.
Result<Path> offsetByDistances(const Entity& entity, const Path& basis, Scope& scope) {
  std::vector<Offsets> stated;
  for (const Entity& position : entity.refs(1)) stated.push_back(offsetsAt(position, scope));
  if (stated.empty()) return fail(entity, "no offset specified");
  std::vector<double> places{stated.front().along};
  for (std::size_t i = 1; i < stated.size(); ++i) {
    const auto between = distancesBetween(basis, stated[i - 1].along, stated[i].along);
    places.insert(places.end(), between.begin(), between.end());
    places.push_back(stated[i].along);
  }
  if (stated.size() == 1) places = distancesBetween(basis, -1, 1e300), places.insert(places.begin(), 0);
  Path moved;
  std::size_t next = 1;
  for (const double at : places) {
    while (next + 1 < stated.size() && stated[next].along < at) ++next;
    const Offsets &a = stated[next > 0 && stated.size() > 1 ? next - 1 : 0], &b = stated[stated.size() > 1 ? next : 0];
    const double t = b.along > a.along ? (at - a.along) / (b.along - a.along) : 0;
    const Station s = stationAt(basis, at);
    const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(s.tangent).normalized();
    appendPoint(moved, s.point + left * (a.lateral + (b.lateral - a.lateral) * t) +
                           Eigen::Vector3d::UnitZ() * (a.vertical + (b.vertical - a.vertical) * t));
  }
  return moved;
}

}  // namespace

Result<Path> offsetCurve(const Entity& entity, Scope& scope) {
  const auto basis = curve(entity.ref(0), scope);
  if (!basis) return basis;
  if (basis->points.size() < 2) return fail(entity, "its basis curve has no length");
  if (entity.is("IFCOFFSETCURVEBYDISTANCES")) return offsetByDistances(entity, *basis, scope);
  const Eigen::Vector3d up = entity.is("IFCOFFSETCURVE3D") ? direction(entity.ref(3), Eigen::Vector3d::UnitZ(), scope)
                                                           : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
  return movedLeft(*basis, up, scope.metres(entity[1].number(0)));
}

}  // namespace standpoint::ifc
