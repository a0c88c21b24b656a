// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numbers>

#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {

Result<geometry::PolyMesh> revolvedAreaSolid(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto regions, profile(entity.ref(0), scope));
  const Axis axis = axis1Placement(entity.ref(2), scope);
  double angle = entity[3].number(0) * scope.model.units.angle_rad;
  if (std::abs(angle) < 1e-9) return fail(entity, "the angle of the revolution is zero or missing");
  angle = std::clamp(angle, -2 * std::numbers::pi, 2 * std::numbers::pi);
  geometry::PolyMesh mesh;
  for (const auto& region : regions) {
    const Eigen::Vector3d along = angle < 0 ? Eigen::Vector3d(-axis.direction) : axis.direction;
    geometry::append(mesh, geometry::revolve(region, axis.point, along, std::abs(angle), scope.tessellation));
  }
  geometry::orientOutward(mesh);
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(1), scope)));
  return mesh;
}

}  // namespace standpoint::ifc
