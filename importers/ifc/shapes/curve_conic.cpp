// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/ifc/shapes/curve.h"
#include "importers/ifc/shapes/placement.h"

namespace standpoint::ifc {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// A trim is a set of a parameter, a point or both.
struct Trim {
  std::optional<double> parameter;
  std::optional<Eigen::Vector3d> point;
};

Trim trim(const Entity& entity, std::size_t index, Scope& scope) {
  Trim t;
  const Value choices = entity[index];
  for (const Value v : choices) {
    if (const Entity p = entity.follow(v))
      t.point = cartesianPoint(p, scope);
    else if (const auto x = v.number())
      t.parameter = x;
  }
  return t;
}

// Where both are given and disagree the point is trusted: files state degrees under a radian unit.
double angle(const Trim& t, const Conic& c, bool points_first, double otherwise, const Scope& scope) {
  if (t.point && (points_first || !t.parameter)) return c.angleOf(*t.point);
  if (!t.parameter) return otherwise;
  const double by_parameter = *t.parameter * scope.model.units.angle_rad;
  if (t.point && (c.at(by_parameter) - *t.point).norm() > 1e-3 + 0.01 * std::max(c.a, c.b)) return c.angleOf(*t.point);
  return by_parameter;
}

Result<Path> trimmedConic(const Entity& entity, const Entity& basis, Scope& scope) {
  TRY_ASSIGN(const auto c, conic(basis, scope));
  const bool points_first = entity[4].symbol() == "CARTESIAN";
  const bool forward = entity[3].symbol() != "F";
  const double from = angle(trim(entity, 1, scope), c, points_first, 0, scope);
  const double to = angle(trim(entity, 2, scope), c, points_first, kTurn, scope);
  double sweep = std::fmod(to - from, kTurn);
  // from = to is the whole turn, and so is a turn that rounding carried a little beyond it.
  const double kNothing = std::abs(to - from) > kTurn ? 1e-4 : 1e-9;
  if (forward && sweep < kNothing) sweep += kTurn;
  if (!forward && sweep > -kNothing) sweep -= kTurn;
  Path path = arc(c, from, sweep, scope);
  close(path);
  return path;
}

Result<Path> trimmedLine(const Entity& entity, const Entity& basis, Scope& scope) {
  const auto whole = line(basis, scope);
  if (!whole) return whole;
  const Eigen::Vector3d from = whole->points[0], along = whole->points[1] - from;
  const bool points_first = entity[4].symbol() == "CARTESIAN";
  const auto at = [&](const Trim& t, double otherwise) -> Eigen::Vector3d {
    if (t.point && (points_first || !t.parameter)) return *t.point;
    return from + along * t.parameter.value_or(otherwise);
  };
  return Path{{at(trim(entity, 1, scope), 0), at(trim(entity, 2, scope), 1)}, false};
}

// Nearest place on the path, measured along it.
double measure(const Path& path, const Eigen::Vector3d& point) {
  double best = 0, nearest = 1e300, at = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Eigen::Vector3d a = path.points[i - 1], d = path.points[i] - a;
    const double t = std::clamp((point - a).dot(d) / std::max(d.squaredNorm(), 1e-300), 0.0, 1.0);
    if (const double off = (a + t * d - point).norm(); off < nearest) nearest = off, best = at + t * d.norm();
    at += d.norm();
  }
  return best;
}

Result<Path> trimmedOther(const Entity& entity, const Entity& basis, Scope& scope) {
  auto whole = curve(basis, scope);
  if (!whole) return whole;
  if (whole->closed) whole->points.push_back(whole->points.front()), whole->closed = false;
  const Trim from = trim(entity, 1, scope), to = trim(entity, 2, scope);
  if (basis.is("IFCPOLYLINE") && from.parameter && to.parameter && !from.point) {
    auto part = trimmedDirectrix(basis, *entity[1].begin(), *entity[2].begin(), scope);
    return part;
  }
  const double whole_length = length(*whole);
  double start = from.point ? measure(*whole, *from.point) : 0,
         end = to.point ? measure(*whole, *to.point) : whole_length;
  if (from.parameter && !from.point)
    scope.report.warn(entity.place(), "parameter trimming is not supported on this curve: kept untrimmed");
  const bool backward = entity[3].symbol() == "F";
  if (backward) std::swap(start, end);
  if (end <= start) end = whole_length;
  Path part = portion(*whole, start, end);
  if (backward) reverse(part);
  return part;
}

}  // namespace

double Conic::angleOf(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = frame.inverse() * point;
  return std::atan2(p.y() / b, p.x() / a);
}

Result<Conic> conic(const Entity& entity, Scope& scope) {
  Conic c;
  c.frame = axisPlacement(entity.ref(0), scope);
  c.a = scope.metres(entity[1].number(0));
  c.b = entity.is("IFCELLIPSE") ? scope.metres(entity[2].number(0)) : c.a;
  if (!(c.a > 0 && c.b > 0)) return fail(entity, "a circle or ellipse requires a positive radius");
  return c;
}

Path arc(const Conic& c, double from, double sweep, const Scope& scope) {
  const int n = geometry::segmentCount(std::max(c.a, c.b), std::abs(sweep), scope.tessellation);
  Path path;
  for (int i = 0; i <= n; ++i) appendPoint(path, c.at(from + sweep * i / n));
  path.start_tangent = c.tangent(from) * (sweep < 0 ? -1 : 1);
  path.end_tangent = c.tangent(from + sweep) * (sweep < 0 ? -1 : 1);
  return path;
}

Path arcThrough(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Scope& scope) {
  const Eigen::Vector3d u = b - a, v = c - a, n = u.cross(v);
  const double twice = 2 * n.squaredNorm();
  if (twice < 1e-24 || n.norm() < 1e-9 * u.norm() * v.norm()) return Path{{a, b, c}, false};  // straight
  const Eigen::Vector3d centre = a + (v.squaredNorm() * n.cross(u) - u.squaredNorm() * n.cross(v)) / twice;
  Conic circle{frame(centre, n.normalized(), a - centre), (a - centre).norm(), (a - centre).norm()};
  double sweep = circle.angleOf(c);
  if (sweep <= 0) sweep += kTurn;
  Path path = arc(circle, 0, sweep, scope);
  if (!path.points.empty()) path.points.front() = a, path.points.back() = c;
  return path;
}

Result<Path> conicCurve(const Entity& entity, Scope& scope) {
  TRY_ASSIGN(const auto c, conic(entity, scope));
  Path path = arc(c, 0, kTurn, scope);
  close(path);
  return path;
}

Result<Path> trimmedCurve(const Entity& entity, Scope& scope) {
  const Entity basis = entity.ref(0);
  if (basis.is("IFCCIRCLE") || basis.is("IFCELLIPSE")) return trimmedConic(entity, basis, scope);
  if (basis.is("IFCLINE")) return trimmedLine(entity, basis, scope);
  return trimmedOther(entity, basis, scope);
}

}  // namespace standpoint::ifc
