// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that are bodies on their own: of no thickness, but a beam meets them.
#include "importers/ifc/curve.h"
#include "importers/ifc/placement.h"
#include "importers/ifc/profile.h"
#include "importers/ifc/solid.h"

namespace standpoint::ifc {
namespace {

void appendLoop(geometry::PolyMesh& mesh, const Path& path, std::vector<std::uint32_t>& loop) {
  for (const auto& p : path.points) {
    loop.push_back(static_cast<std::uint32_t>(mesh.points.size()));
    mesh.points.push_back(p);
  }
}

}  // namespace

Result<geometry::PolyMesh> curveBoundedPlane(const Entity& entity, Scope& scope) {
  const Entity plane = entity.ref(0);
  if (!plane.is("IFCPLANE")) return fail(entity, "its basis surface is no plane");
  const auto outer = curve(entity.ref(1), scope);
  if (!outer) return failure(outer.error());
  if (outer->points.size() < 3) return fail(entity, "its outline encloses nothing");
  geometry::PolyMesh mesh;
  geometry::Face face;
  appendLoop(mesh, *outer, face.outer);
  for (const Entity& boundary : entity.refs(2))
    if (const auto inner = curve(boundary, scope); inner && inner->points.size() >= 3) appendLoop(mesh, *inner, face.holes.emplace_back());
  mesh.faces.push_back(std::move(face));
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(plane.ref(0), scope)));
  return mesh;
}

Result<geometry::PolyMesh> extrudedSurface(const Entity& entity, Scope& scope) {
  auto path = profileCurve(entity.ref(0), scope);
  if (!path) return failure(path.error());
  const Eigen::Vector3d along = direction(entity.ref(2), Eigen::Vector3d::UnitZ()) * scope.metres(entity[3].number(0));
  if (path->points.size() < 2 || !(along.norm() > 1e-9)) return fail(entity, "the extruded surface has no area");
  if (!scope.spend(path->points.size())) return fail(entity, "too many points");
  if (path->closed) path->points.push_back(path->points.front());
  geometry::PolyMesh mesh;
  for (const auto& p : path->points) mesh.points.push_back(p), mesh.points.push_back(p + along);
  for (std::uint32_t i = 0; i + 3 < mesh.points.size(); i += 2) {
    geometry::Face face;
    face.outer = {i, i + 2, i + 3, i + 1};
    mesh.faces.push_back(std::move(face));
  }
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(1), scope)));
  return mesh;
}

// The surfaces and solids of a set; its curves and points are drawing, no body.
Result<geometry::PolyMesh> geometricSet(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  for (const Entity& element : entity.refs(0)) {
    const Mapping* mapping = scope.model.mapping_of_type[element.type()];
    if (!mapping || !mapping->item) continue;
    const auto part = item(element, scope);
    if (part) geometry::append(mesh, *part);
    else scope.report.lose(element.place(), "has no geometry: " + part.error().message);
  }
  if (mesh.faces.empty()) return fail(entity, "the set holds no surface");
  return mesh;
}

}  // namespace standpoint::ifc
