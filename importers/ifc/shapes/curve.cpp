// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/shapes/curve.h"

#include <algorithm>
#include <cmath>

#include "importers/ifc/shapes/placement.h"

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
  std::reverse(path.ups.begin(), path.ups.end());
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
      for (const double end_m : {from_m, to_m}) {
        const double t = std::clamp((end_m - at) / step, 0.0, 1.0);
        appendPoint(part, a + (b - a) * t);
        if (!path.closed && path.ups.size() == path.points.size() && part.ups.size() < part.points.size())
          part.ups.push_back(path.ups[i - 1] + t * (path.ups[i] - path.ups[i - 1]));
      }
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
      const double off =
          std::max({deviation(piece.a, piece.b, m), deviation(piece.a, piece.b, at((piece.from + mid) / 2)),
                    deviation(piece.a, piece.b, at((piece.to + mid) / 2))});
      if (piece.depth < 12 && off > scope.tessellation.chord_error_m) {
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
    if (const Entity p = entity.follow(v))
      appendPoint(path, cartesianPoint(p, scope));
    else
      scope.misread(entity, "refers to " + notInFile(v));
  if (path.points.size() < 2) return fail(entity, "the polyline has fewer than two different points");
  if (!scope.spend(path.points.size())) return fail(entity, "too many points");
  close(path);
  return path;
}

Result<Path> line(const Entity& entity, Scope& scope) {
  const Eigen::Vector3d from = cartesianPoint(entity.ref(0), scope);
  const Entity vector = entity.ref(1);
  const Eigen::Vector3d to =
      from + direction(vector.ref(0), Eigen::Vector3d::UnitX(), scope) * scope.metres(vector[1].number(1));
  return Path{{from, to}, false};
}

std::vector<Eigen::Vector3d> pointList(const Entity& list, Scope& scope) {
  std::vector<Eigen::Vector3d> points;
  const double unit = scope.model.units.length_m;
  const Value rows = list[0];
  for (const Value row : rows) {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    int i = 0;
    for (auto it = row.begin(); it != row.end() && i < 3; ++it, ++i) p[i] = scope.number(*it, list) * unit;
    points.push_back(p);
  }
  return points;
}

Result<Path> indexedPolyCurve(const Entity& entity, Scope& scope) {
  const auto points = pointList(entity.ref(0), scope);
  if (!scope.spend(points.size())) return fail(entity, "too many points");
  Path path;
  if (!entity[1].present())
    for (const auto& p : points) appendPoint(path, p);
  const Value segments = entity[1];
  for (const Value segment : segments) {
    std::vector<Eigen::Vector3d> corners;
    const Value indices = segment.inner();
    for (const Value index : indices) {
      const auto i = index.integer();
      if (i < 1 || i > static_cast<std::int64_t>(points.size()))
        return fail(entity, "a segment refers to point " + std::to_string(i) + " which is not in the list");
      corners.push_back(points[static_cast<std::size_t>(i - 1)]);
    }
    const bool first = path.points.empty();
    Path part{std::move(corners)};
    if (segment.typeName() == "IFCARCINDEX" && part.points.size() == 3)
      part = arcThrough(part.points[0], part.points[1], part.points[2], scope);
    if (first) path.start_tangent = part.start_tangent;
    path.end_tangent = part.end_tangent;
    for (const auto& p : part.points) appendPoint(path, p);
  }
  if (path.points.size() < 2) return fail(entity, "the curve has fewer than two different points");
  close(path);
  return path;
}

}  // namespace standpoint::ifc
