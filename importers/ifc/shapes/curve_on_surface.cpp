// SPDX-License-Identifier: GPL-3.0-or-later
// Curves in the parameters of a surface (IfcPcurve), and those that have such curves beside them.
#include "importers/ifc/shapes/curve.h"

namespace standpoint::ifc {

Entity spatialCurve(const Entity& surface_curve) {
  if (const Entity in_space = surface_curve.ref(0)) return in_space;
  for (const Entity& associated : surface_curve.refs(1))
    if (associated.is("IFCPCURVE")) return associated;
  return {};
}

Result<Path> surfaceCurve(const Entity& entity, Scope& scope) {
  const Entity found = spatialCurve(entity);
  return found ? curve(found, scope) : Result<Path>(fail(entity, "has neither a curve in space nor one on a surface"));
}

Result<Path> pcurve(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto on, surface(entity.ref(0), scope));
  const double length_m = scope.model.units.length_m, angle_rad = scope.model.units.angle_rad;
  if (!on->fromFile(Eigen::Vector2d::Zero(), length_m, angle_rad))
    return fail(entity, "a curve in the parameters of " + std::string(entity.ref(0).typeName()) + " is not supported");
  const geometry::Tessellation of_scope = scope.tessellation;
  // Parameters are angles or knots rather than lengths: their curve is read to a ten-thousandth of their unit.
  if (!entity.ref(0).is("IFCPLANE")) scope.tessellation.chord_error_m = 1e-4 * length_m;
  auto flat = curve(entity.ref(1), scope);
  scope.tessellation = of_scope;
  if (!flat) return flat;
  if (flat->closed) flat->points.push_back(flat->points.front());
  Path path;
  for (std::size_t i = 1; i < flat->points.size(); ++i) {
    const Eigen::Vector2d a = flat->points[i - 1].head<2>() / length_m, b = flat->points[i].head<2>() / length_m;
    const auto at = [&](double t) { return on->at(*on->fromFile(a + (b - a) * t, length_m, angle_rad)); };
    const Path piece = sample(at, 0, 1, 1, scope);
    if (!scope.spend(piece.points.size())) return fail(entity, "too many points");
    for (const auto& p : piece.points) appendPoint(path, p);
  }
  if (path.points.size() < 2) return fail(entity, "the curve has no length");
  close(path);
  return path;
}

}  // namespace standpoint::ifc
