// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces that are bodies on their own: of no thickness, but a beam meets them.
#include <algorithm>
#include <numbers>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/faceted.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/profile.h"
#include "importers/ifc/shapes/solid.h"
#include "importers/ifc/shapes/surfaces.h"

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
  if (!plane.is("IFCPLANE")) return fail(entity, "its basis surface is not planar");
  TRY_ASSIGN(const auto outer, curve(entity.ref(1), scope));
  if (outer.points.size() < 3) return fail(entity, "its outline encloses no area");
  geometry::PolyMesh mesh;
  geometry::Face face;
  appendLoop(mesh, outer, face.outer);
  for (const Entity& boundary : entity.refs(2))
    if (const auto inner = curve(boundary, scope); inner && inner->points.size() >= 3)
      appendLoop(mesh, *inner, face.holes.emplace_back());
  mesh.faces.push_back(std::move(face));
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(plane.ref(0), scope)));
  return mesh;
}

Result<geometry::PolyMesh> curveBoundedSurface(const Entity& entity, Scope& scope) {
  if (entity[2].isTrue()) return fail(entity, "an implicit outer boundary is not supported");
  TRY_ASSIGN(const auto on, surface(entity.ref(0), scope));
  Outlines outlines;
  for (const Entity& boundary : entity.refs(1)) {
    TRY_ASSIGN(auto path, curve(boundary, scope));
    outlines.push_back(std::move(path.points));
  }
  geometry::PolyMesh mesh;
  TRY(appendOnSurface(mesh, *on, outlines, false, entity, scope));
  if (mesh.faces.empty()) return fail(entity, "the surface has no area");
  return mesh;
}

namespace {

// From a to b in the stated direction, around a surface that closes.
void orderBounds(double& a, double& b, bool forward, double period) {
  if (!forward) std::swap(a, b);
  if (b <= a && period > 0) b += period;
  if (b < a) std::swap(a, b);
}

// Into how many equal pieces a range of one parameter has to be cut for chords to keep the tolerance.
int piecesAlong(const ParametricSurface& on, const Eigen::Vector2d& low, const Eigen::Vector2d& high, int axis,
                double tolerance_m) {
  constexpr int kMost = 256, kLines = 4;
  const auto at = [&](double t, int line) {
    Eigen::Vector2d fraction = Eigen::Vector2d::Constant(static_cast<double>(line) / kLines);
    fraction[axis] = t;
    return on.at(low + (high - low).cwiseProduct(fraction));
  };
  for (int n = 1; n < kMost; n *= 2) {
    double off = 0;
    for (int i = 0; i < n; ++i)
      for (int line = 0; line <= kLines; ++line) {
        const double a = static_cast<double>(i) / n, b = static_cast<double>(i + 1) / n;
        const Eigen::Vector3d from = at(a, line), to = at(b, line);
        for (const double t : {0.25, 0.5, 0.75})
          off = std::max(off, (from + (to - from) * t - at(a + (b - a) * t, line)).norm());
      }
    if (off <= tolerance_m) return n;
  }
  return kMost;
}

}  // namespace

Result<geometry::PolyMesh> rectangularTrimmedSurface(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto on, surface(entity.ref(0), scope));
  const auto bound = [&](std::size_t u, std::size_t v) {
    return on->fromFile({entity[u].number(0), entity[v].number(0)}, scope.model.units.length_m,
                        scope.model.units.angle_rad);
  };
  auto low = bound(1, 2), high = bound(3, 4);
  if (!low || !high)
    return fail(entity, "trims in the parameters of " + std::string(entity.ref(0).typeName()) + " are not supported");
  for (const int k : {0, 1})
    orderBounds((*low)[k], (*high)[k], entity[k == 0 ? 5 : 6].symbol() != "F", on->period()[k]);
  const int nu = piecesAlong(*on, *low, *high, 0, scope.tessellation.chord_error_m),
            nv = piecesAlong(*on, *low, *high, 1, scope.tessellation.chord_error_m);
  if (!scope.spend(static_cast<std::size_t>(nu + 1) * static_cast<std::size_t>(nv + 1)))
    return fail(entity, "too many points");
  geometry::PolyMesh mesh;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i)
      mesh.points.push_back(on->at(
          *low +
          (*high - *low).cwiseProduct(Eigen::Vector2d(static_cast<double>(i) / nu, static_cast<double>(j) / nv))));
  const auto triangle = [&](int a, int b, int c) {
    geometry::Face face;
    for (const int i : {a, b, c}) face.outer.push_back(static_cast<std::uint32_t>(i));
    const auto& p = mesh.points;
    if ((p[face.outer[1]] - p[face.outer[0]]).cross(p[face.outer[2]] - p[face.outer[0]]).norm() > 1e-12)
      mesh.faces.push_back(std::move(face));  // at a pole
  };
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      const int a = j * (nu + 1) + i, above = a + nu + 1;
      triangle(a, a + 1, above + 1);
      triangle(a, above + 1, above);
    }
  if (mesh.faces.empty()) return fail(entity, "the surface has no area");
  return mesh;
}

Result<geometry::PolyMesh> extrudedSurface(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(auto path, profileCurve(entity.ref(0), scope));
  const Eigen::Vector3d along =
      direction(entity.ref(2), Eigen::Vector3d::UnitZ(), scope) * scope.metres(entity[3].number(0));
  if (path.points.size() < 2 || !(along.norm() > 1e-9)) return fail(entity, "the extruded surface has no area");
  if (!scope.spend(path.points.size())) return fail(entity, "too many points");
  if (path.closed) path.points.push_back(path.points.front());
  geometry::PolyMesh mesh;
  for (const auto& p : path.points) mesh.points.push_back(p), mesh.points.push_back(p + along);
  for (std::uint32_t i = 0; i + 3 < mesh.points.size(); i += 2) {
    geometry::Face face;
    face.outer = {i, i + 2, i + 3, i + 1};
    mesh.faces.push_back(std::move(face));
  }
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(1), scope)));
  return mesh;
}

// A whole turn of the curve around the axis.
Result<geometry::PolyMesh> revolvedSurface(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(auto path, profileCurve(entity.ref(0), scope));
  if (path.points.size() < 2) return fail(entity, "the revolved surface has no area");
  if (path.closed) path.points.push_back(path.points.front());
  const Eigen::Isometry3d position = axisPlacement(entity.ref(1), scope);
  const Axis axis = axisOfRevolution(entity, position, scope);
  double radius_m = 0;
  for (const auto& p : path.points) radius_m = std::max(radius_m, axis.direction.cross(p - axis.point).norm());
  constexpr double kWholeTurn_rad = 2 * std::numbers::pi;
  const auto segments =
      static_cast<std::uint32_t>(geometry::segmentCount(radius_m, kWholeTurn_rad, scope.tessellation));
  const auto length = static_cast<std::uint32_t>(path.points.size());
  if (!scope.spend(static_cast<std::size_t>(segments) * length)) return fail(entity, "too many points");
  geometry::PolyMesh mesh;
  for (std::uint32_t k = 0; k < segments; ++k) {
    const Eigen::AngleAxisd turn(kWholeTurn_rad * k / segments, axis.direction);
    for (const auto& p : path.points) mesh.points.push_back(axis.point + turn * (p - axis.point));
  }
  for (std::uint32_t k = 0; k < segments; ++k)
    for (std::uint32_t i = 0; i + 1 < length; ++i) {
      const std::uint32_t here = k * length + i, there = (k + 1) % segments * length + i;
      geometry::Face face;
      face.outer = {here, here + 1, there + 1, there};
      mesh.faces.push_back(std::move(face));
    }
  geometry::orientOutward(mesh);  // and welds: at the axis four points are three
  if (mesh.faces.empty()) return fail(entity, "the revolved surface has no area");
  geometry::transform(mesh, Eigen::Affine3d(position));
  return mesh;
}

// The surfaces and solids of a set; its curves and points are drawing, no body.
Result<geometry::PolyMesh> geometricSet(const Entity& entity, Scope& scope) {
  geometry::PolyMesh mesh;
  for (const Entity& element : entity.refs(0)) {
    const Mapping* mapping = scope.model.mapping_of_type[element.type()];
    if (isUnreadBody(element, scope.model))
      scope.report.lose(element.place(), std::string(element.typeName()) + " is not supported as a surface");
    if (!mapping || !mapping->item) continue;
    const auto part = item(element, scope);
    if (part) {
      geometry::append(mesh, *part);
      continue;
    }
    scope.report.lose(element.place(), "has no geometry: " + part.error().message);
    // A part that fails does not end the set, so sets that contain themselves would fail twice as often at each depth.
    constexpr std::size_t kCostOfAFailure = Scope::kMost / 10'000;
    if (!scope.spend(kCostOfAFailure)) return fail(entity, "too many parts of the set have no geometry");
  }
  if (mesh.faces.empty()) return fail(entity, "the set contains no surface");
  return mesh;
}

}  // namespace standpoint::ifc
