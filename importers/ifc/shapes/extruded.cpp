// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {

Result<geometry::PolyMesh> extrudedAreaSolid(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto regions, profile(entity.ref(0), scope));
  const double depth = scope.metres(entity[3].number(0));
  const Eigen::Vector3d along = direction(entity.ref(2), Eigen::Vector3d::UnitZ(), scope);
  if (!(std::abs(depth) > 1e-9)) return fail(entity, "the depth of the extrusion is zero or missing");
  if (std::abs(along.z()) < 1e-6) return fail(entity, "the extrusion runs within the plane of its profile");
  geometry::PolyMesh mesh;
  for (const auto& region : regions)
    geometry::append(mesh, geometry::extrude(region, depth < 0 ? Eigen::Vector3d(-along) : along, std::abs(depth)));
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(1), scope)));
  return mesh;
}

Result<geometry::PolyMesh> extrudedAreaSolidTapered(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto from, profile(entity.ref(0), scope));
  TRY_ASSIGN(const auto to, profile(entity.ref(4), scope));
  const double depth = scope.metres(entity[3].number(0));
  if (!(depth > 0)) return fail(entity, "the depth of the extrusion is not positive");
  const Eigen::Vector3d along = direction(entity.ref(2), Eigen::Vector3d::UnitZ(), scope);
  geometry::PolyMesh mesh;
  for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) {
    const auto &a = from[i], &b = to[i];
    bool alike = a.outer.size() == b.outer.size() && a.holes.size() == b.holes.size();
    for (std::size_t h = 0; alike && h < a.holes.size(); ++h) alike = a.holes[h].size() == b.holes[h].size();
    if (!alike) return fail(entity, "the profiles at both ends have different numbers of points");
    geometry::append(mesh, geometry::extrudeTapered(a, b, along, depth));
  }
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(1), scope)));
  return mesh;
}

}  // namespace standpoint::ifc
