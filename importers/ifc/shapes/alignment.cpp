// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/alignment.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

// Farther from the curve than that a stated position means another place: curves keep 1 mm, exporters some millimetres.
constexpr double kStatedWithin_m = 0.05;

// Distances along an alignment count in its plan, so that a slope does not stretch them.
double planLength(const Eigen::Vector3d& step) {
  const double plan = step.head<2>().norm();
  return plan > 1e-9 ? plan : step.norm();
}

Eigen::Vector3d upBetween(const Path& path, std::size_t i, double t) {
  if (path.ups.size() != path.points.size()) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up = path.ups[i - 1] + t * (path.ups[i] - path.ups[i - 1]);
  return up.norm() > 1e-9 ? Eigen::Vector3d(up.normalized()) : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
}

}  // namespace

Station stationAt(const Path& path, double distance) {
  double at = 0;
  const auto& p = path.points;
  for (std::size_t i = 1; i < p.size(); ++i) {
    const Eigen::Vector3d step = p[i] - p[i - 1];
    const double here = planLength(step);
    if (at + here >= distance || i + 1 == p.size()) {
      const double t = (distance - at) / here;
      return {p[i - 1] + step * t, step.normalized(), upBetween(path, i, std::clamp(t, 0.0, 1.0))};
    }
    at += here;
  }
  return {p.front(), Eigen::Vector3d::UnitX()};
}

double lengthTo(const Path& path, double distance) {
  double at = 0, sum = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Eigen::Vector3d step = path.points[i] - path.points[i - 1];
    const double here = planLength(step);
    if (at + here >= distance) return sum + step.norm() * std::max(distance - at, 0.0) / here;
    at += here;
    sum += step.norm();
  }
  return sum;
}

std::vector<double> distancesBetween(const Path& path, double from_m, double to_m) {
  std::vector<double> inner;
  double at = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    at += planLength(path.points[i] - path.points[i - 1]);
    if (at > from_m + 1e-6 && at < to_m - 1e-6) inner.push_back(at);
  }
  return inner;
}

Offsets offsetsAt(const Entity& position, const Scope& scope) {
  const Entity expression = position.is("IFCAXIS2PLACEMENTLINEAR") ? position.ref(0) : position;
  const auto m = [&](std::size_t i) { return scope.metres(expression[i].number(0)); };
  return {m(0), m(1), m(2), m(3)};
}

Result<Eigen::Isometry3d> placeAlong(const Entity& position, const Path& directrix, Scope& scope) {
  Entity expression = position;
  if (position.is("IFCAXIS2PLACEMENTLINEAR")) expression = position.ref(0);
  if (!expression.is("IFCPOINTBYDISTANCEEXPRESSION") && !expression.is("IFCDISTANCEEXPRESSION"))
    return fail(position, "a position along a curve of this kind is not supported");
  if (directrix.points.size() < 2) return fail(position, "the curve has no length");
  const Offsets o = offsetsAt(position, scope);
  const Station s = stationAt(directrix, o.along);
  const Eigen::Vector3d forward = s.tangent;
  // A stated Axis is the exact one, and exporters count the cant into it; only where there is none the curve's own
  // counts.
  const bool has_axis = position.is("IFCAXIS2PLACEMENTLINEAR") && position.ref(1);
  const Eigen::Vector3d left =
      (has_axis ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : s.up).cross(forward).normalized();
  const Eigen::Vector3d up = forward.cross(left);
  const Eigen::Vector3d origin = s.point + left * o.lateral + up * o.vertical + forward * o.longitudinal;
  Eigen::Isometry3d f = Eigen::Isometry3d::Identity();
  f.linear() << forward, left, up;
  if (position.is("IFCAXIS2PLACEMENTLINEAR")) {
    // Axis and RefDirection are stated in the curve's own frame at that place.
    const Eigen::Vector3d z = direction(position.ref(1), Eigen::Vector3d::UnitZ(), scope),
                          x = direction(position.ref(2), Eigen::Vector3d::UnitX(), scope);
    f.linear() = f.linear() * frame(Eigen::Vector3d::Zero(), z, x).linear();
  }
  f.translation() = origin;
  return f;
}

Result<Eigen::Isometry3d> linearPlacement(const Entity& placement, Scope& scope) {
  const Entity relative = placement.ref(1), cartesian = placement.ref(2);
  const Entity expression = relative.ref(0);
  if (relative.is("IFCAXIS2PLACEMENTLINEAR") && expression.is("IFCPOINTBYDISTANCEEXPRESSION")) {
    const auto path = curve(expression.ref(4), scope);
    if (!path && !cartesian) return failure(path.error());
    if (path) {
      auto along = placeAlong(relative, *path, scope);
      if (!along || !cartesian.is("IFCAXIS2PLACEMENT3D")) return along;
      const Eigen::Isometry3d stated = axisPlacement(cartesian, scope);
      const double off_m = (stated.translation() - along->translation()).norm();
      if (off_m <= kStatedWithin_m) return along;
      scope.report.warn(placement.place(),
                        fmt::format("the stated CartesianPosition is {:.3f} m from the place on the curve; it is used "
                                    "instead",
                                    off_m));
      return stated;
    }
  }
  for (std::size_t i = 1; i < 6; ++i)
    if (const Entity e = placement.ref(i); e.is("IFCAXIS2PLACEMENT3D")) return axisPlacement(e, scope);
  return fail(placement, "a linear placement of this kind is not supported");
}

}  // namespace standpoint::ifc
