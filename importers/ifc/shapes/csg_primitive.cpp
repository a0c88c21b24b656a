// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {
namespace {

Result<geometry::PolyMesh> placed(const Entity& entity, geometry::PolyMesh mesh, Scope& scope) {
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(0), scope)));
  return mesh;
}

double m(const Entity& entity, std::size_t index, const Scope& scope) { return scope.metres(entity[index].number(0)); }

bool isSize(double metres) { return metres > 0 && metres < kFarthest_m; }

tl::unexpected<Error> noSize(const Entity& entity) {
  return fail(entity, "a dimension of the primitive is missing, not positive, or more than 1e15 m");
}

// A face takes the memory of some eight points.
bool spendFaces(std::size_t count, Scope& scope) { return scope.spend(8 * count); }

std::size_t facesAround(double radius_m, const Scope& scope) {
  return static_cast<std::size_t>(geometry::segmentCount(radius_m, 2 * std::numbers::pi, scope.tessellation));
}

}  // namespace

Result<geometry::PolyMesh> block(const Entity& e, Scope& s) {
  const Eigen::Vector3d size(m(e, 1, s), m(e, 2, s), m(e, 3, s));
  if (!isSize(size.x()) || !isSize(size.y()) || !isSize(size.z())) return noSize(e);
  return placed(e, geometry::box(size), s);
}

Result<geometry::PolyMesh> rectangularPyramid(const Entity& e, Scope& s) {
  const double x = m(e, 1, s), y = m(e, 2, s), height = m(e, 3, s);
  if (!isSize(x) || !isSize(y) || !isSize(height)) return noSize(e);
  return placed(e, geometry::pyramid(x, y, height), s);
}

Result<geometry::PolyMesh> rightCircularCone(const Entity& e, Scope& s) {
  const double height = m(e, 1, s), radius = m(e, 2, s);
  if (!isSize(height) || !isSize(radius)) return noSize(e);
  if (!spendFaces(facesAround(radius, s), s)) return fail(e, "the representation is too complex");
  return placed(e, geometry::cone(radius, height, s.tessellation), s);
}

Result<geometry::PolyMesh> rightCircularCylinder(const Entity& e, Scope& s) {
  const double height = m(e, 1, s), radius = m(e, 2, s);
  if (!isSize(height) || !isSize(radius)) return noSize(e);
  if (!spendFaces(facesAround(radius, s), s)) return fail(e, "the representation is too complex");
  return placed(e, geometry::cylinder(radius, height, s.tessellation), s);
}

Result<geometry::PolyMesh> sphereSolid(const Entity& e, Scope& s) {
  const double radius = m(e, 1, s);
  if (!isSize(radius)) return noSize(e);
  const std::size_t around = facesAround(radius, s);
  if (!spendFaces(around * around / 2, s)) return fail(e, "the sphere is too large for its chord error");
  return placed(e, geometry::sphere(radius, s.tessellation), s);
}

Result<geometry::PolyMesh> csgSolid(const Entity& e, Scope& s) { return item(e.ref(0), s); }

}  // namespace standpoint::ifc
