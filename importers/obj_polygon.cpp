// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj_polygon.h"

#include <cmath>
#include <utility>

#include "importers/geometry/kernel.h"

namespace standpoint {

namespace {

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

Eigen::Vector3d newellNormal(std::span<const Eigen::Vector3d> p) {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) n += (p[i] - p[0]).cross(p[(i + 1) % p.size()] - p[0]);
  return n;
}

// Drops the axis along which the normal is longest, keeping the turn.
std::vector<Point> projected(std::span<const Eigen::Vector3d> corners, const Eigen::Vector3d& normal) {
  int drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  int u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);
  std::vector<Point> result;
  for (const auto& p : corners) result.emplace_back(p[u] - corners[0][u], p[v] - corners[0][v]);
  return result;
}

bool isConvex(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  double turned = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
    const double turn = cross(a, b, c);
    if (turn < 0) return false;
    turned += std::atan2(turn, (b - a).dot(c - b));
  }
  return turned < 6.3;   // once round: a star polygon turns twice
}

PolygonTriangles fan(std::size_t corners, bool clean) {
  PolygonTriangles out;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) out.triangles.push_back({0, i, i + 1});
  out.clean = clean;
  return out;
}

}  // namespace

PolygonTriangles triangulatePolygon(std::span<const Eigen::Vector3d> corners) {
  // Nobody's floor has more; the time that a hostile outline takes grows faster than its corners.
  constexpr std::size_t kMaxConcave = 20000;
  if (corners.size() <= 3) return fan(corners.size(), true);
  const Eigen::Vector3d normal = newellNormal(corners);
  if (!(normal.norm() > 0)) return fan(corners.size(), false);
  if (isConvex(projected(corners, normal))) return fan(corners.size(), true);
  if (corners.size() > kMaxConcave) return fan(corners.size(), false);
  geometry::Face face;
  for (std::uint32_t i = 0; i < corners.size(); ++i) face.outer.push_back(i);
  PolygonTriangles out;
  return geometry::triangulate(corners, face, out.triangles) ? out : fan(corners.size(), false);
}

}  // namespace standpoint
