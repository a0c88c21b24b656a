// SPDX-License-Identifier: GPL-3.0-or-later
// Cross sections that stand along a curve: IfcSectionedSolidHorizontal and IfcSectionedSurface. Between two stated
// sections the body follows every bend of its directrix.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "importers/ifc/shapes/alignment.h"
#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"
#include "importers/ifc/shapes/profile.h"
#include "importers/ifc/shapes/sections.h"
#include "importers/ifc/shapes/solid.h"

namespace standpoint::ifc {

bool alike(const geometry::Region2& a, const geometry::Region2& b) {
  if (a.outer.size() != b.outer.size() || a.holes.size() != b.holes.size()) return false;
  for (std::size_t h = 0; h < a.holes.size(); ++h)
    if (a.holes[h].size() != b.holes[h].size()) return false;
  return true;
}

geometry::Region2 blend(const geometry::Region2& a, const geometry::Region2& b, double t) {
  geometry::Region2 mid = a;
  const auto mix = [t](geometry::Loop2& to, const geometry::Loop2& other) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += (other[i] - to[i]) * t;
  };
  mix(mid.outer, b.outer);
  for (std::size_t h = 0; h < mid.holes.size(); ++h) mix(mid.holes[h], b.holes[h]);
  return mid;
}

namespace {

struct Position {
  Offsets at;
  std::optional<double> roll_rad;  // where an Axis is stated: of "up" to the left
};

Position positionOf(const Entity& position, Scope& scope) {
  Position p{offsetsAt(position, scope), {}};
  if (const Entity axis = position.is("IFCAXIS2PLACEMENTLINEAR") ? position.ref(1) : Entity()) {
    const Eigen::Vector3d up = direction(axis, Eigen::Vector3d::UnitZ(), scope);
    p.roll_rad = std::atan2(up.y(), up.z());
  }
  return p;
}

Position between(const Position& a, const Position& b, double t) {
  const auto mix = [t](double from, double to) { return from + (to - from) * t; };
  Position p{{mix(a.at.along, b.at.along), mix(a.at.lateral, b.at.lateral), mix(a.at.vertical, b.at.vertical), 0}, {}};
  if (a.roll_rad && b.roll_rad) p.roll_rad = mix(*a.roll_rad, *b.roll_rad);
  return p;
}

// The plane of a section stands upright across the directrix: x to the left, y up; it rolls as stated, else with the
// cant.
Eigen::Isometry3d sectionFrame(const Path& directrix, const Position& p) {
  const Station s = stationAt(directrix, p.at.along);
  const Eigen::Vector3d forward = Eigen::Vector3d(s.tangent.x(), s.tangent.y(), 0).normalized();
  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forward);
  const double roll = p.roll_rad ? *p.roll_rad : std::atan2(s.up.dot(left), s.up.z());
  const Eigen::Vector3d up = left * std::sin(roll) + Eigen::Vector3d::UnitZ() * std::cos(roll);
  Eigen::Isometry3d f = Eigen::Isometry3d::Identity();
  f.linear() << up.cross(forward), up, forward;
  f.translation() = s.point;
  return f * Eigen::Translation3d(p.at.lateral, p.at.vertical, 0);
}

// The shares of the way at which the directrix bends between two positions, after the first of them.
std::vector<double> fractionsAfter(const Path& directrix, const Position& a, const Position& b) {
  std::vector<double> fractions;
  for (const double d : distancesBetween(directrix, a.at.along, b.at.along))
    fractions.push_back((d - a.at.along) / (b.at.along - a.at.along));
  fractions.push_back(1);
  return fractions;
}

struct Sections {
  Path directrix;
  std::vector<Entity> profiles;
  std::vector<Position> positions;
};

Result<Sections> sectionsOf(const Entity& entity, std::size_t profiles, std::size_t positions, Scope& scope) {
  TRY_ASSIGN(auto directrix, curve(entity.ref(0), scope));
  Sections found{std::move(directrix), entity.refs(profiles), {}};
  for (const Entity& p : entity.refs(positions)) found.positions.push_back(positionOf(p, scope));
  if (found.positions.size() != found.profiles.size() || found.positions.size() < 2)
    return fail(entity, "cross sections and their positions do not match");
  if (found.directrix.points.size() < 2) return fail(entity, "its directrix has no length");
  return found;
}

// An open cross section, with the tags of its points where it has some.
struct Chain {
  geometry::Loop2 points;
  std::vector<std::string> tags;
};

Result<Chain> chainOf(const Entity& profile_entity, Scope& scope) {
  TRY_ASSIGN(auto path, profileCurve(profile_entity, scope));
  if (path.closed) path.points.push_back(path.points.front());
  Chain chain{loop2(path), {}};
  if (profile_entity.is("IFCOPENCROSSPROFILEDEF"))
    for (const Value tag : profile_entity[5]) chain.tags.push_back(tag.text());
  if (chain.tags.size() != chain.points.size()) chain.tags.clear();
  if (!scope.spend(chain.points.size())) return fail(profile_entity, "too many points");
  return chain;
}

// Where both chains are bound to each other: at their ends, and at points of the same tag.
std::vector<std::pair<std::size_t, std::size_t>> anchors(const Chain& a, const Chain& b) {
  std::vector<std::pair<std::size_t, std::size_t>> found{{0, 0}};
  if (a.tags.empty() || b.tags.empty()) {
    if (a.points.size() == b.points.size())
      for (std::size_t i = 1; i + 1 < a.points.size(); ++i) found.emplace_back(i, i);
  } else {
    for (std::size_t i = 1; i + 1 < a.points.size(); ++i)
      for (std::size_t j = found.back().second + 1; j + 1 < b.points.size(); ++j)
        if (!a.tags[i].empty() && a.tags[i] == b.tags[j]) {
          found.emplace_back(i, j);
          break;
        }
  }
  found.emplace_back(a.points.size() - 1, b.points.size() - 1);
  return found;
}

// The shares of the length at which a part of a chain has its points.
std::vector<double> weightsOf(const Chain& c, std::size_t from, std::size_t to) {
  std::vector<double> at{0};
  for (std::size_t i = from; i < to; ++i) at.push_back(at.back() + (c.points[i + 1] - c.points[i]).norm());
  const double whole = at.back();
  for (double& fraction : at) fraction = whole > 0 ? fraction / whole : 0;
  return at;
}

Eigen::Vector2d pointAt(const Chain& c, std::size_t from, const std::vector<double>& fractions, double fraction) {
  for (std::size_t i = 1; i < fractions.size(); ++i)
    if (fraction <= fractions[i] && fractions[i] > fractions[i - 1])
      return c.points[from + i - 1] + (c.points[from + i] - c.points[from + i - 1]) *
                                          ((fraction - fractions[i - 1]) / (fractions[i] - fractions[i - 1]));
  return c.points[from + fractions.size() - 1];
}

// Both chains with as many points as the other: between two anchors each has the points of both.
std::pair<geometry::Loop2, geometry::Loop2> paired(const Chain& a, const Chain& b) {
  std::pair<geometry::Loop2, geometry::Loop2> both{{a.points.front()}, {b.points.front()}};
  const auto bound = anchors(a, b);
  for (std::size_t k = 1; k < bound.size(); ++k) {
    const auto [i0, j0] = bound[k - 1];
    const auto [i1, j1] = bound[k];
    const auto of_a = weightsOf(a, i0, i1), of_b = weightsOf(b, j0, j1);
    std::vector<double> fractions;
    std::merge(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(fractions));
    double last = 0;
    for (const double fraction : fractions) {
      if (fraction - last < 1e-9) continue;
      last = fraction;
      both.first.push_back(pointAt(a, i0, of_a, fraction));
      both.second.push_back(pointAt(b, j0, of_b, fraction));
    }
  }
  return both;
}

void joinRows(geometry::PolyMesh& mesh, std::size_t first, std::size_t count) {
  const auto triangle = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Eigen::Vector3d u = mesh.points[b] - mesh.points[a], v = mesh.points[c] - mesh.points[a];
    if (u.cross(v).norm() < 1e-12) return;  // where rows meet in a point
    geometry::Face face;
    for (const std::size_t i : {a, b, c}) face.outer.push_back(static_cast<std::uint32_t>(i));
    mesh.faces.push_back(std::move(face));
  };
  for (std::size_t i = first; i + 1 < first + count; ++i) {
    triangle(i, i + count, i + 1);
    triangle(i + 1, i + count, i + count + 1);
  }
}

Result<geometry::PolyMesh> surfaceAlong(const Entity& entity, const Sections& s, Scope& scope) {
  geometry::PolyMesh mesh;
  TRY_ASSIGN(auto before, chainOf(s.profiles[0], scope));
  for (std::size_t i = 1; i < s.profiles.size(); ++i) {
    TRY_ASSIGN(auto next, chainOf(s.profiles[i], scope));
    if (before.points.size() < 2 || next.points.size() < 2) return fail(entity, "a cross section has no length");
    const auto [from, to] = paired(before, next);
    const Position &a = s.positions[i - 1], &b = s.positions[i];
    if (!(b.at.along > a.at.along)) return fail(entity, "the positions of the cross sections are not in order");
    std::vector<double> fractions = fractionsAfter(s.directrix, a, b);
    fractions.insert(fractions.begin(), 0);
    if (!scope.spend(fractions.size() * from.size())) return fail(entity, "too many points");
    for (const double t : fractions) {
      const Eigen::Isometry3d frame_here = sectionFrame(s.directrix, between(a, b, t));
      for (std::size_t k = 0; k < from.size(); ++k) {
        const Eigen::Vector2d p = from[k] + (to[k] - from[k]) * t;
        mesh.points.emplace_back(frame_here * Eigen::Vector3d(p.x(), p.y(), 0));
      }
      if (t > 0) joinRows(mesh, mesh.points.size() - 2 * from.size(), from.size());
    }
    before = std::move(next);
  }
  if (mesh.faces.empty()) return fail(entity, "the surface has no area");
  return mesh;
}

}  // namespace

Result<geometry::PolyMesh> sectionedSurface(const Entity& entity, Scope& scope) {
  const auto s = sectionsOf(entity, 2, 1, scope);
  return s ? surfaceAlong(entity, *s, scope) : Result<geometry::PolyMesh>(failure(s.error()));
}

Result<geometry::PolyMesh> sectionedSolidHorizontal(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto s, sectionsOf(entity, 1, 2, scope));
  if (s.profiles[0].is("IFCOPENCROSSPROFILEDEF")) {
    scope.report.warn(entity.place(), "its cross sections are open: treated as a surface");
    return surfaceAlong(entity, s, scope);
  }
  std::vector<geometry::Region2> regions;
  std::vector<Eigen::Isometry3d> frames;
  for (std::size_t i = 0; i < s.profiles.size(); ++i) {
    TRY_ASSIGN(auto region, profile(s.profiles[i], scope));
    const geometry::Region2 next = std::move(region.front());
    if (i > 0) {
      if (!alike(regions.back(), next)) return fail(entity, "the cross sections have different numbers of points");
      const geometry::Region2 from = regions.back();
      for (const double t : fractionsAfter(s.directrix, s.positions[i - 1], s.positions[i])) {
        regions.push_back(blend(from, next, t));
        frames.push_back(sectionFrame(s.directrix, between(s.positions[i - 1], s.positions[i], t)));
        if (!scope.spend(next.outer.size())) return fail(entity, "too many points");
      }
    } else {
      regions.push_back(next);
      frames.push_back(sectionFrame(s.directrix, s.positions[i]));
    }
  }
  auto mesh = geometry::loft(regions, frames, false);
  if (mesh) geometry::orientOutward(*mesh);
  return mesh;
}

}  // namespace standpoint::ifc
