// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/profile.h"

namespace standpoint::ifc {
namespace {

Result<geometry::Loop2> outline(const Entity& curve_entity, Scope& scope) {
  TRY_ASSIGN(const auto path, curve(curve_entity, scope));
  if (path.points.size() < 3) return fail(curve_entity, "an outline requires three distinct points");
  return loop2(path);
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

// An outline in the shape of an eight is two areas that meet at its crossing; each crossing splits it once more.
Regions partsOfCrossing(const geometry::Loop2& outline) {
  std::vector<geometry::Loop2> open{outline};
  Regions parts;
  for (int splits = 0; !open.empty() && splits < 1000; ++splits) {
    const geometry::Loop2 loop = std::move(open.back());
    open.pop_back();
    bool split = false;
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i + 2 < n && !split; ++i)
      for (std::size_t j = i + 2; j < n && !split; ++j) {
        const Eigen::Vector2d &a = loop[i], &b = loop[j];
        const Eigen::Vector2d u = loop[i + 1] - a, v = loop[(j + 1) % n] - b;
        const double det = cross(u, v), s = cross(b - a, v) / det, t = cross(b - a, u) / det;
        if (!(s > 1e-9 && s < 1 - 1e-9 && t > 1e-9 && t < 1 - 1e-9)) continue;
        geometry::Loop2 inner(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                              loop.begin() + static_cast<std::ptrdiff_t>(j) + 1),
            rest(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        inner.push_back(a + u * s);
        rest.push_back(a + u * s);
        rest.insert(rest.end(), loop.begin() + static_cast<std::ptrdiff_t>(j) + 1, loop.end());
        open.push_back(std::move(rest));
        open.push_back(std::move(inner));
        split = true;
      }
    if (split) continue;
    geometry::Region2 part{loop, {}};
    geometry::normalise(part);
    if (part.outer.size() >= 3) parts.push_back(std::move(part));
  }
  return parts;
}

// The band on both sides of a path, mitred at its corners.
geometry::Loop2 band(const Path& path, double half_width) {
  const geometry::Loop2 line = loop2(path);
  const std::size_t n = line.size();
  const auto normal = [&](std::size_t i) {
    const Eigen::Vector2d d = (line[i + 1] - line[i]).normalized();
    return Eigen::Vector2d(-d.y(), d.x());
  };
  geometry::Loop2 left, right;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d a = normal(i > 0 ? i - 1 : 0), b = normal(i + 1 < n ? i : n - 2);
    Eigen::Vector2d m = a + b;
    const double stretch = m.squaredNorm() / 2;            // 1 + cos of the turn
    m = stretch > 0.1 ? Eigen::Vector2d(m / stretch) : b;  // a hairpin gets no endless mitre
    left.push_back(line[i] + m * half_width);
    right.push_back(line[i] - m * half_width);
  }
  left.insert(left.end(), right.rbegin(), right.rend());
  return left;
}

}  // namespace

Result<Regions> arbitraryClosedProfile(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(auto outer, outline(entity.ref(2), scope));
  geometry::Region2 region{outer, {}};
  if (entity.is("IFCARBITRARYPROFILEDEFWITHVOIDS"))
    for (const Entity& inner : entity.refs(3)) {
      auto hole = outline(inner, scope);
      if (hole)
        region.holes.push_back(std::move(*hole));
      else
        scope.report.warn(hole.error().source, "a hole of the profile was skipped: " + hole.error().message);
    }
  geometry::normalise(region);
  if (region.outer.size() >= 3) return Regions{std::move(region)};
  Regions parts = outer.size() <= 1000 ? partsOfCrossing(outer) : Regions();
  if (parts.empty()) return fail(entity, "the outline of the profile encloses no area");
  scope.report.warn(entity.place(), "the outline of the profile intersects itself; each of its " +
                                        std::to_string(parts.size()) + " parts is filled");
  return parts;
}

Result<Regions> centreLineProfile(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(auto path, curve(entity.ref(2), scope));
  const double half = scope.metres(entity[3].number(0)) / 2;
  if (!(half > 0)) return fail(entity, "the thickness is not positive");
  if (path.closed) path.points.push_back(path.points.front());
  geometry::Region2 region{band(path, half), {}};
  geometry::normalise(region);
  return Regions{std::move(region)};
}

Result<Regions> compositeProfile(const Entity& entity, Scope& scope) {
  Regions all;
  for (const Entity& part : entity.refs(2)) {
    auto regions = profile(part, scope);
    if (!regions) return regions;
    all.insert(all.end(), regions->begin(), regions->end());
  }
  if (all.empty()) return fail(entity, "the composite profile has no parts");
  return all;
}

Result<Regions> derivedProfile(const Entity& entity, Scope& scope) {
  auto regions = profile(entity.ref(2), scope);
  if (!regions) return regions;
  Eigen::Affine3d t = transformationOperator(entity.ref(3), scope);
  if (entity.is("IFCMIRROREDPROFILEDEF")) t.linear().col(0) *= -1;  // its operator is derived: x → −x
  for (auto& region : *regions) {
    const auto move = [&](geometry::Loop2& loop) {
      for (auto& p : loop) p = (t * Eigen::Vector3d(p.x(), p.y(), 0)).head<2>();
    };
    move(region.outer);
    for (auto& hole : region.holes) move(hole);
    geometry::normalise(region);
  }
  return regions;
}

Result<Path> profileCurve(const Entity& entity, Scope& scope) {
  if (entity.is("IFCARBITRARYOPENPROFILEDEF") || entity.is("IFCARBITRARYCLOSEDPROFILEDEF"))
    return curve(entity.ref(2), scope);
  if (entity.is("IFCOPENCROSSPROFILEDEF")) return openCrossProfile(entity, scope);
  TRY_ASSIGN(const auto regions, profile(entity, scope));
  Path path;
  for (const auto& p : regions.front().outer) path.points.emplace_back(p.x(), p.y(), 0);
  path.closed = true;
  return path;
}

}  // namespace standpoint::ifc
