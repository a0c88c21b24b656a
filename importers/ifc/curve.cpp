// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/ifc/placement.h"

namespace standpoint::ifc {

void appendPoint(Path& path, const Eigen::Vector3d& point) {
  if (path.points.empty() || (path.points.back() - point).norm() > kSamePoint_m) path.points.push_back(point);
}

void close(Path& path) {
  if (path.points.size() < 3 || (path.points.front() - path.points.back()).norm() > 10 * kSamePoint_m) return;
  path.points.pop_back();
  path.closed = true;
}

void reverse(Path& path) {
  std::reverse(path.points.begin(), path.points.end());
  path.start_tangent.swap(path.end_tangent);
  path.start_tangent *= -1;
  path.end_tangent *= -1;
}

geometry::Loop2 loop2(const Path& path) {
  geometry::Loop2 loop;
  loop.reserve(path.points.size());
  for (const auto& p : path.points) loop.emplace_back(p.x(), p.y());
  return loop;
}

double length(const Path& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.points.size(); ++i) sum += (path.points[i] - path.points[i - 1]).norm();
  if (path.closed && !path.points.empty()) sum += (path.points.front() - path.points.back()).norm();
  return sum;
}

Path portion(const Path& path, double from_m, double to_m) {
  Path part;
  double at = 0;
  const std::size_t count = path.points.size() + (path.closed ? 1 : 0);
  for (std::size_t i = 1; i < count; ++i) {
    const Eigen::Vector3d &a = path.points[i - 1], &b = path.points[i % path.points.size()];
    const double step = (b - a).norm();
    if (step > 0 && at + step >= from_m && at <= to_m) {
      appendPoint(part, a + (b - a) * std::clamp((from_m - at) / step, 0.0, 1.0));
      appendPoint(part, a + (b - a) * std::clamp((to_m - at) / step, 0.0, 1.0));
    }
    at += step;
  }
  return part;
}

namespace {

double deviation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& p) {
  const Eigen::Vector3d d = b - a;
  const double squared = d.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(d) / squared, 0.0, 1.0) : 0;
  return (a + t * d - p).norm();
}

struct Piece {
  double from, to;
  Eigen::Vector3d a, b;
  int depth;
};

}  // namespace

Path sample(const std::function<Eigen::Vector3d(double)>& at, double from, double to, int pieces, const Scope& scope) {
  Path path;
  appendPoint(path, at(from));
  for (int i = 0; i < pieces; ++i) {
    const double t0 = from + (to - from) * i / pieces, t1 = from + (to - from) * (i + 1) / pieces;
    std::vector<Piece> open{{t0, t1, at(t0), at(t1), 0}};
    while (!open.empty()) {
      const Piece piece = open.back();
      open.pop_back();
      const double mid = (piece.from + piece.to) / 2;
      const Eigen::Vector3d m = at(mid);
      // Two more looks beside the middle: an S-shaped piece crosses its chord there.
      const double off = std::max({deviation(piece.a, piece.b, m), deviation(piece.a, piece.b, at((piece.from + mid) / 2)),
                                   deviation(piece.a, piece.b, at((piece.to + mid) / 2))});
      if (piece.depth < 12 && off > scope.model.tessellation.chord_error_m) {
        open.push_back({mid, piece.to, m, piece.b, piece.depth + 1});
        open.push_back({piece.from, mid, piece.a, m, piece.depth + 1});
      } else {
        appendPoint(path, piece.b);
      }
    }
  }
  return path;
}

Result<Path> polyline(const Entity& entity, Scope& scope) {
  Path path;
  const Value points = entity[0];
  for (const Value v : points)
    if (const Entity p = entity.follow(v)) appendPoint(path, cartesianPoint(p, scope));
  if (path.points.size() < 2) return fail(entity, "the polyline has fewer than two different points");
  if (!scope.spend(path.points.size())) return fail(entity, "too many points");
  close(path);
  return path;
}

Result<Path> line(const Entity& entity, Scope& scope) {
  const Eigen::Vector3d from = cartesianPoint(entity.ref(0), scope);
  const Entity vector = entity.ref(1);
  const Eigen::Vector3d to = from + direction(vector.ref(0), Eigen::Vector3d::UnitX()) * scope.metres(vector[1].number(1));
  return Path{{from, to}, false};
}

std::vector<Eigen::Vector3d> pointList(const Entity& list, const Scope& scope) {
  std::vector<Eigen::Vector3d> points;
  const double unit = scope.model.units.length_m;
  const Value rows = list[0];
  for (const Value row : rows) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    int i = 0;
    for (auto it = row.begin(); it != row.end() && i < 3; ++it, ++i) p[i] = (*it).number(0) * unit;
    points.push_back(p);
  }
  return points;
}

Result<Path> indexedPolyCurve(const Entity& entity, Scope& scope) {
  const auto points = pointList(entity.ref(0), scope);
  if (!scope.spend(points.size())) return fail(entity, "too many points");
  Path path;
  if (!entity[1].present()) for (const auto& p : points) appendPoint(path, p);
  const Value segments = entity[1];
  for (const Value segment : segments) {
    std::vector<Eigen::Vector3d> corners;
    const Value indices = segment.inner();
    for (const Value index : indices) {
      const auto i = index.integer();
      if (i < 1 || i > static_cast<std::int64_t>(points.size())) return fail(entity, "a segment refers to point " + std::to_string(i) + " which the list does not have");
      corners.push_back(points[static_cast<std::size_t>(i - 1)]);
    }
    const bool first = path.points.empty();
    Path part{std::move(corners)};
    if (segment.typeName() == "IFCARCINDEX" && part.points.size() == 3) part = arcThrough(part.points[0], part.points[1], part.points[2], scope);
    if (first) path.start_tangent = part.start_tangent;
    path.end_tangent = part.end_tangent;
    for (const auto& p : part.points) appendPoint(path, p);
  }
  if (path.points.size() < 2) return fail(entity, "the curve has fewer than two different points");
  close(path);
  return path;
}

Result<Path> surfaceCurve(const Entity& entity, Scope& scope) { return curve(entity.ref(0), scope); }

namespace {

// A polyline's parameter is the number of its point.
Path polylinePortion(const Path& path, double t0, double t1) {
  const auto& p = path.points;
  const auto at = [&](double t) {
    const double clamped = std::clamp(t, 0.0, static_cast<double>(p.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(clamped), p.size() - 2);
    return Eigen::Vector3d(p[i] + (p[i + 1] - p[i]) * (clamped - static_cast<double>(i)));
  };
  Path part;
  appendPoint(part, at(t0));
  for (std::size_t i = 0; i < p.size(); ++i)
    if (static_cast<double>(i) > t0 && static_cast<double>(i) < t1) appendPoint(part, p[i]);
  appendPoint(part, at(t1));
  return part.points.size() >= 2 ? part : path;
}

}  // namespace

Result<Path> trimmedDirectrix(const Entity& directrix, const Value& start, const Value& end, Scope& scope) {
  const double t0 = start.number(0);
  if (directrix.is("IFCCIRCLE") || directrix.is("IFCELLIPSE")) {
    const double from = t0 * scope.model.units.angle_rad, sweep = end.number(0) * scope.model.units.angle_rad - from;
    if (const auto c = conic(directrix, scope); c && sweep > 1e-9 && sweep < 2 * std::numbers::pi - 1e-9) return arc(*c, from, sweep, scope);
  }
  auto path = curve(directrix, scope);
  if (!path || path->closed || (!start.present() && !end.present())) return path;
  const double whole = length(*path);
  const bool by_length = start.typeName() == "IFCLENGTHMEASURE" || end.typeName() == "IFCLENGTHMEASURE" || directrix.is("IFCGRADIENTCURVE");
  if (by_length) {
    Path part = portion(*path, scope.metres(t0), end.present() ? scope.metres(end.number(0)) : whole);
    return part.points.size() >= 2 ? part : *path;
  }
  if (directrix.is("IFCLINE")) {   // one parameter is one vector long
    const Eigen::Vector3d from = path->points.front(), along = path->points.back() - from;
    return Path{{from + along * t0, from + along * end.number(1)}, false};
  }
  if (!directrix.is("IFCPOLYLINE") && !directrix.is("IFCINDEXEDPOLYCURVE")) return path;   // of others the trims repeat what the curve says
  const auto last = static_cast<double>(path->points.size() - 1);
  const double t1 = end.number(last);
  // Many exporters write 0 … 1 for the whole of any curve, which is what they draw, too.
  const bool normalised = t0 == 0 && t1 == 1;
  return t1 > t0 && !normalised ? polylinePortion(*path, t0, t1) : *path;
}

}  // namespace standpoint::ifc
