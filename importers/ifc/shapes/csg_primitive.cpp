// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {
namespace {

Result<geometry::PolyMesh> placed(const Entity& entity, geometry::PolyMesh mesh, Scope& scope) {
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(0), scope)));
  return mesh;
}

double m(const Entity& entity, std::size_t index, const Scope& scope) { return scope.metres(entity[index].number(0)); }

tl::unexpected<Error> notPositive(const Entity& entity) {
  return fail(entity, "a dimension of the primitive is missing or not positive");
}

}  // namespace

Result<geometry::PolyMesh> block(const Entity& e, Scope& s) {
  const Eigen::Vector3d size(m(e, 1, s), m(e, 2, s), m(e, 3, s));
  if (!(size.minCoeff() > 0)) return notPositive(e);
  return placed(e, geometry::box(size), s);
}

Result<geometry::PolyMesh> rectangularPyramid(const Entity& e, Scope& s) {
  const double x = m(e, 1, s), y = m(e, 2, s), height = m(e, 3, s);
  if (!(x > 0 && y > 0 && height > 0)) return notPositive(e);
  return placed(e, geometry::pyramid(x, y, height), s);
}

Result<geometry::PolyMesh> rightCircularCone(const Entity& e, Scope& s) {
  const double height = m(e, 1, s), radius = m(e, 2, s);
  if (!(height > 0 && radius > 0)) return notPositive(e);
  return placed(e, geometry::cone(radius, height, s.tessellation), s);
}

Result<geometry::PolyMesh> rightCircularCylinder(const Entity& e, Scope& s) {
  const double height = m(e, 1, s), radius = m(e, 2, s);
  if (!(height > 0 && radius > 0)) return notPositive(e);
  return placed(e, geometry::cylinder(radius, height, s.tessellation), s);
}

Result<geometry::PolyMesh> sphereSolid(const Entity& e, Scope& s) {
  const double radius = m(e, 1, s);
  if (!(radius > 0)) return notPositive(e);
  return placed(e, geometry::sphere(radius, s.tessellation), s);
}

Result<geometry::PolyMesh> csgSolid(const Entity& e, Scope& s) { return item(e.ref(0), s); }

}  // namespace standpoint::ifc
