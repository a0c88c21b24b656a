// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/soup/obj_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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
  return turned < 6.3;  // once round: a star polygon turns twice
}

// Of each corner of closed rings the next one.
std::vector<std::size_t> nextCorners(std::span<const std::size_t> ring_ends) {
  std::vector<std::size_t> next;
  std::size_t begin = 0;
  for (const std::size_t end : ring_ends) {
    for (std::size_t i = begin; i < end; ++i) next.push_back(i + 1 < end ? i + 1 : begin);
    begin = end;
  }
  return next;
}

// The axis along which fewer edges lie above each other.
int sweepAxis(const std::vector<Point>& p, const std::vector<std::size_t>& next) {
  Point low = p[0], high = p[0], along = Point::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    low = low.cwiseMin(p[i]), high = high.cwiseMax(p[i]);
    along += (p[next[i]] - p[i]).cwiseAbs();
  }
  return along.x() * (high.y() - low.y()) <= along.y() * (high.x() - low.x()) ? 0 : 1;
}

// Whether edges cross more often than rounding makes them, or lie so that telling it would take too long. Edges are met
// in the order of their first ends, so that only those are compared that lie above each other.
bool crossesOften(const std::vector<Point>& p, std::span<const std::size_t> ring_ends) {
  constexpr int kOften = 16;
  std::int64_t budget = 1'000'000 + 1000 * static_cast<std::int64_t>(p.size());
  struct Edge {
    Point left, right;
  };
  const auto next = nextCorners(ring_ends);
  const int axis = sweepAxis(p, next), across = 1 - axis;
  std::vector<Edge> edges, open;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point &a = p[i], &b = p[next[i]];
    Edge e{{a[axis], a[across]}, {b[axis], b[across]}};
    if (e.right.x() < e.left.x()) std::swap(e.left, e.right);
    edges.push_back(e);
  }
  std::stable_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.left.x() < b.left.x(); });
  int crossings = 0;
  for (const Edge& e : edges) {
    budget -= static_cast<std::int64_t>(open.size());
    std::erase_if(open, [&](const Edge& other) { return other.right.x() < e.left.x(); });
    for (const Edge& o : open)
      if (cross(o.left, o.right, e.left) * cross(o.left, o.right, e.right) < 0 &&
          cross(e.left, e.right, o.left) * cross(e.left, e.right, o.right) < 0)
        ++crossings;
    if (crossings > kOften || budget < 0) return true;
    open.push_back(e);
  }
  return false;
}

PolygonTriangles fan(std::size_t corners, bool clean) {
  PolygonTriangles out;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) out.triangles.push_back({0, i, i + 1});
  out.clean = clean;
  return out;
}

// Nobody's floor has more; the time that a hostile outline takes grows faster than its corners.
constexpr std::size_t kMaxConcave = 100000, kFew = 64;

}  // namespace

PolygonTriangles triangulatePolygon(std::span<const Eigen::Vector3d> corners) {
  if (corners.size() <= 3) return fan(corners.size(), true);
  const Eigen::Vector3d normal = newellNormal(corners);
  if (!(normal.norm() > 0)) return fan(corners.size(), false);
  const auto flat = projected(corners, normal);
  if (isConvex(flat)) return fan(corners.size(), true);
  const std::size_t whole[] = {corners.size()};
  if (corners.size() > kMaxConcave || (corners.size() > kFew && crossesOften(flat, whole)))
    return fan(corners.size(), false);
  geometry::Face face;
  for (std::uint32_t i = 0; i < corners.size(); ++i) face.outer.push_back(i);
  PolygonTriangles out;
  return geometry::triangulate(corners, face, out.triangles) ? out : fan(corners.size(), false);
}

PolygonTriangles triangulateRings(std::span<const Eigen::Vector3d> corners, std::span<const std::size_t> ring_ends) {
  if (ring_ends.size() == 1) return triangulatePolygon(corners);
  const auto outline = corners.first(ring_ends[0]);
  const auto without_holes = [&] {
    auto filled = triangulatePolygon(outline);
    filled.clean = false;
    return filled;
  };
  const Eigen::Vector3d normal = newellNormal(outline);
  if (!(normal.norm() > 0) || corners.size() > kMaxConcave) return without_holes();
  if (corners.size() > kFew && crossesOften(projected(corners, normal), ring_ends)) return without_holes();
  geometry::Face face;
  std::uint32_t corner = 0;
  for (; corner < ring_ends[0]; ++corner) face.outer.push_back(corner);
  for (const std::size_t end : ring_ends.subspan(1))
    for (face.holes.emplace_back(); corner < end; ++corner) face.holes.back().push_back(corner);
  PolygonTriangles out;
  return geometry::triangulate(corners, face, out.triangles) ? out : without_holes();
}

}  // namespace standpoint
