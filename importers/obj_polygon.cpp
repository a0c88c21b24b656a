// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/obj_polygon.h"

#include <cmath>

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

void fan(const std::vector<std::uint32_t>& rest, PolygonTriangles& out) {
  for (std::size_t i = 1; i + 1 < rest.size(); ++i) out.triangles.push_back({rest[0], rest[i], rest[i + 1]});
}

class EarClipper {
 public:
  explicit EarClipper(const std::vector<Point>& p) : p_(p), steps_(100000 + 1000 * p.size()) {
    for (std::uint32_t i = 0; i < p.size(); ++i) rest_.push_back(i);
  }

  PolygonTriangles run() {
    PolygonTriangles out;
    std::size_t at = 0, misses = 0;
    while (rest_.size() > 3) {
      if (misses > rest_.size() || steps_ == 0) {
        out.clean = false;
        break;
      }
      at %= rest_.size();
      if (!isEar(at)) {
        ++at;
        ++misses;
        continue;
      }
      out.triangles.push_back({before(at), rest_[at], after(at)});
      rest_.erase(rest_.begin() + static_cast<std::ptrdiff_t>(at));
      misses = 0;
    }
    fan(rest_, out);
    return out;
  }

 private:
  std::uint32_t before(std::size_t i) const { return rest_[(i + rest_.size() - 1) % rest_.size()]; }
  std::uint32_t after(std::size_t i) const { return rest_[(i + 1) % rest_.size()]; }

  bool isEar(std::size_t i) {
    const Point &a = p_[before(i)], &b = p_[rest_[i]], &c = p_[after(i)];
    if (cross(a, b, c) < 0) return false;
    for (const auto k : rest_) {
      if (steps_ > 0) --steps_;
      const Point& q = p_[k];
      if (q == a || q == b || q == c) continue;
      if (cross(a, b, q) >= 0 && cross(b, c, q) >= 0 && cross(c, a, q) >= 0) return false;
    }
    return true;
  }

  const std::vector<Point>& p_;
  std::vector<std::uint32_t> rest_;
  std::size_t steps_;
};

}  // namespace

PolygonTriangles triangulatePolygon(std::span<const Eigen::Vector3d> corners) {
  PolygonTriangles out;
  if (corners.size() < 3) return out;
  if (corners.size() == 3) return {{{0, 1, 2}}, true};
  const Eigen::Vector3d normal = newellNormal(corners);
  const auto flat = projected(corners, normal);
  if (!(normal.norm() > 0) || isConvex(flat)) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < corners.size(); ++i) all.push_back(i);
    fan(all, out);
    out.clean = normal.norm() > 0;
    return out;
  }
  return EarClipper(flat).run();
}

}  // namespace standpoint
