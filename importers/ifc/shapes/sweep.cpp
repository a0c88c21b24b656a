// SPDX-License-Identifier: GPL-3.0-or-later
// Profiles along curves: swept disks, fixed-reference and surface-curve sweeps, sectioned spines, tapered revolutions.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/shortest_rotation.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/profile.h"
#include "importers/ifc/shapes/sections.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {
namespace {

// Replaces each corner of a polyline by an arc of that radius, as far as its legs allow.
Path filleted(const Path& path, double radius, const Scope& scope) {
  Path round;
  const auto& p = path.points;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (i == 0 || i + 1 == p.size()) {
      appendPoint(round, p[i]);
      continue;
    }
    const Eigen::Vector3d u = (p[i - 1] - p[i]).normalized(), v = (p[i + 1] - p[i]).normalized();
    const double half = std::acos(std::clamp(u.dot(v), -1.0, 1.0)) / 2;
    const double room = std::min((p[i - 1] - p[i]).norm(), (p[i + 1] - p[i]).norm());
    const double reach = radius / std::tan(half);
    if (half > std::numbers::pi / 2 - 1e-4 || half < 1e-3 || reach > room) {
      appendPoint(round, p[i]);
      continue;
    }
    const Eigen::Vector3d centre = p[i] + (u + v).normalized() * (radius / std::sin(half));
    const Eigen::Vector3d a = p[i] + u * reach, b = p[i] + v * reach;
    const Eigen::Vector3d middle = centre + (p[i] - centre).normalized() * radius;
    for (const auto& q : arcThrough(a, middle, b, scope).points) appendPoint(round, q);
  }
  return round;
}

geometry::Region2 stretched(const geometry::Region2& region, const Eigen::Vector2d& along, double factor) {
  geometry::Region2 s = region;
  const auto move = [&](geometry::Loop2& loop) {
    for (auto& q : loop) q += along * (q.dot(along) * (factor - 1));
  };
  move(s.outer);
  for (auto& hole : s.holes) move(hole);
  return s;
}

// The profile at each point of the path, mitred; `reference(i, tangent)` is where its x axis points to at point i.
template <class Reference>
Result<geometry::PolyMesh> along(const geometry::Region2& region, const Path& path, const Reference& reference) {
  std::vector<geometry::Region2> profiles;
  std::vector<Eigen::Isometry3d> frames;
  const auto& p = path.points;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0 && !path.closed, last = i + 1 == n && !path.closed;
    const Eigen::Vector3d in = first ? p[1] - p[0] : p[i] - p[(i + n - 1) % n];
    const Eigen::Vector3d out = last ? in : p[(i + 1) % n] - p[i];
    const Eigen::Vector3d t0 = in.normalized(), t1 = out.normalized();
    Eigen::Vector3d tangent = t0 + t1;
    tangent = tangent.norm() > 1e-3 ? Eigen::Vector3d(tangent.normalized()) : t1;
    if (first && !path.start_tangent.isZero()) tangent = path.start_tangent;
    if (last && !path.end_tangent.isZero()) tangent = path.end_tangent;
    const Eigen::Isometry3d f = frame(p[i], tangent, reference(i, tangent));
    const double factor = first || last ? 1 : std::min(1 / std::max(tangent.dot(t0), 0.1), 10.0);
    const Eigen::Vector3d bend = f.linear().transpose() * (t1 - t0);
    profiles.push_back(factor > 1 + 1e-9 && bend.head<2>().norm() > 1e-9
                           ? stretched(region, bend.head<2>().normalized(), factor)
                           : region);
    frames.push_back(f);
  }
  return geometry::loft(profiles, frames, path.closed);
}

// A direction that is meant with "up" being Z, where "up" leans.
Eigen::Vector3d rolled(const Eigen::Vector3d& direction_unit, const Eigen::Vector3d& up) {
  return shortestRotation(Eigen::Vector3d::UnitZ(), up) * direction_unit;
}

}  // namespace

Result<geometry::PolyMesh> sweptDiskSolid(const Entity& entity, Scope& scope) {
  const double radius = scope.metres(entity[1].number(0));
  double inner = scope.metres(entity[2].number(0));
  if (!(radius > 0)) return fail(entity, "the radius of the disk is missing or not positive");
  if (!(inner > 0 && inner < radius)) inner = 0;
  TRY_ASSIGN(auto path, trimmedDirectrix(entity.ref(0), entity[3], entity[4], scope));
  if (entity.is("IFCSWEPTDISKSOLIDPOLYGONAL") && entity[5].number(0) > 0)
    path = filleted(path, scope.metres(entity[5].number(0)), scope);
  if (!scope.spend(path.points.size() * 16)) return fail(entity, "too many points");
  return geometry::sweepDisk(path.points, path.closed, radius, inner, scope.tessellation,
                             {path.start_tangent, path.end_tangent});
}

namespace {

// Whether a curve begins within the height of an extruded surface, as a curve on it does.
bool liesOn(const Path& path, const Entity& extrusion, Scope& scope) {
  const auto swept = profileCurve(extrusion.ref(0), scope);
  if (!swept || swept->points.empty() || path.points.empty()) return true;
  const Eigen::Isometry3d position = axisPlacement(extrusion.ref(1), scope);
  const Eigen::Vector3d along = position.linear() * direction(extrusion.ref(2), Eigen::Vector3d::UnitZ(), scope);
  const double height = (path.points.front() - position * swept->points.front()).dot(along);
  constexpr double kSlack_m = 1e-4;
  return height > -kSlack_m && height < scope.metres(extrusion[3].number(0)) + kSlack_m;
}

}  // namespace

Result<geometry::PolyMesh> curveSweptAreaSolid(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto regions, profile(entity.ref(0), scope));
  TRY_ASSIGN(const auto path, trimmedDirectrix(entity.ref(2), entity[3], entity[4], scope));
  const Entity reference = entity.ref(5);
  Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  if (reference.is("IFCDIRECTION"))
    x = direction(reference, x, scope);
  else if (reference.is("IFCPLANE"))
    x = axisPlacement(reference.ref(0), scope).linear().col(2);
  else if (reference.is("IFCSURFACEOFLINEAREXTRUSION"))
    x = axisPlacement(reference.ref(1), scope).linear() * direction(reference.ref(2), Eigen::Vector3d::UnitZ(), scope);
  else
    return fail(entity,
                "a reference surface of this kind (" + std::string(reference.typeName()) + ") is not supported");
  const bool across = reference.is("IFCSURFACEOFLINEAREXTRUSION") && liesOn(path, reference, scope);
  if (reference.is("IFCSURFACEOFLINEAREXTRUSION") && !across) {
    scope.report.note(
        entity.place(),
        "its directrix is not on its reference surface, as in old Revit exports; the profile's x axis is reversed");
    x = -x;
  }
  // A derived reference follows the cant of its directrix, a fixed one does not.
  const bool rolls = entity.is("IFCDIRECTRIXDERIVEDREFERENCESWEPTAREASOLID") && path.ups.size() == path.points.size();
  geometry::PolyMesh mesh;
  for (const auto& region : regions) {
    if (!scope.spend(path.points.size() * region.outer.size())) return fail(entity, "too many points");
    auto part =
        across ? along(region, path, [&](std::size_t, const Eigen::Vector3d& t) { return Eigen::Vector3d(t.cross(x)); })
               : along(region, path,
                       [&](std::size_t i, const Eigen::Vector3d&) { return rolls ? rolled(x, path.ups[i]) : x; });
    if (!part) return part;
    geometry::append(mesh, *part);
  }
  geometry::orientOutward(mesh);
  geometry::transform(mesh, Eigen::Affine3d(axisPlacement(entity.ref(1), scope)));
  return mesh;
}

namespace {

Result<geometry::PolyMesh> sections(const Entity& entity, const std::vector<Entity>& profiles,
                                    const std::vector<Eigen::Isometry3d>& frames, Scope& scope) {
  std::vector<geometry::Region2> regions;
  for (const Entity& p : profiles) {
    TRY_ASSIGN(auto r, profile(p, scope));
    if (!scope.spend(r.front().outer.size())) return fail(entity, "too many points");
    regions.push_back(std::move(r.front()));
  }
  if (regions.size() != frames.size() || regions.size() < 2)
    return fail(entity, "cross sections and their positions do not match");
  auto mesh = geometry::loft(regions, frames, false);
  if (mesh) geometry::orientOutward(*mesh);
  return mesh;
}

}  // namespace

Result<geometry::PolyMesh> sectionedSpine(const Entity& entity, Scope& scope) {
  std::vector<Eigen::Isometry3d> frames;
  for (const Entity& position : entity.refs(2)) frames.push_back(axisPlacement(position, scope));
  return sections(entity, entity.refs(1), frames, scope);
}

// The profile turns into the other one on its way around the axis.
Result<geometry::PolyMesh> revolvedAreaSolidTapered(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto from, profile(entity.ref(0), scope));
  TRY_ASSIGN(const auto to, profile(entity.ref(4), scope));
  const geometry::Region2 &start = from.front(), &end = to.front();
  if (!alike(start, end)) return fail(entity, "the profiles at both ends have different numbers of points");
  const double angle =
      std::clamp(entity[3].number(0) * scope.model.units.angle_rad, -2 * std::numbers::pi, 2 * std::numbers::pi);
  if (std::abs(angle) < 1e-9) return fail(entity, "the angle of the revolution is zero or missing");
  const Axis axis = axis1Placement(entity.ref(2), scope);
  double radius = 0;
  for (const auto& p : start.outer)
    radius = std::max(radius, (Eigen::Vector3d(p.x(), p.y(), 0) - axis.point).cross(axis.direction).norm());
  const int steps =
      geometry::segmentCount(radius, std::min(std::abs(angle), 2 * std::numbers::pi - 1e-6), scope.tessellation);
  if (!scope.spend(start.outer.size() * static_cast<std::size_t>(steps))) return fail(entity, "too many points");
  std::vector<geometry::Region2> regions;
  std::vector<Eigen::Isometry3d> frames;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    regions.push_back(blend(start, end, t));
    frames.push_back(Eigen::Translation3d(axis.point) * Eigen::AngleAxisd(angle * t, axis.direction) *
                     Eigen::Translation3d(-axis.point));
  }
  auto mesh = geometry::loft(regions, frames, false);
  if (!mesh) return mesh;
  geometry::orientOutward(*mesh);
  geometry::transform(*mesh, Eigen::Affine3d(axisPlacement(entity.ref(1), scope)));
  return mesh;
}

}  // namespace standpoint::ifc
