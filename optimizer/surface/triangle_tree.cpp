// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/triangle_tree.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace standpoint {

namespace {

constexpr std::uint32_t kLeaf = 4;
constexpr std::uint32_t kAlone = 8192;  // triangles that one task looks at

// Nodes below one with n and with n + 1 triangles.
std::pair<std::uint32_t, std::uint32_t> below(std::uint32_t n) {
  if (n + 1 <= kLeaf) return {0, 0};
  const auto [less, more] = below(n / 2);
  const auto even = 2 + 2 * less, odd = 2 + less + more;
  return n % 2 == 0 ? std::pair(n <= kLeaf ? 0 : even, odd) : std::pair(odd, 2 + 2 * more);
}

}  // namespace

Eigen::Vector3d closestPoint(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return a + ab * (d1 / (d1 - d3));
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  const double e = d4 - d3, f = d5 - d6;
  if (va <= 0 && e >= 0 && f >= 0 && e + f > 0) return b + (c - b) * (e / (e + f));
  const double sum = va + vb + vc;
  return sum > 0 ? Eigen::Vector3d(a + ab * (vb / sum) + ac * (vc / sum)) : a;
}

TriangleTree::TriangleTree(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size()) {
  if (triangles.empty()) return;
  std::vector<Item> items(triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(items.size()), kAlone),
                    [&](const auto& range) {
                      for (auto i = range.begin(); i < range.end(); ++i) {
                        const auto& t = triangles[i];
                        const Eigen::Vector3d centre = positions[t[0]] / 3 + positions[t[1]] / 3 + positions[t[2]] / 3;
                        items[i].centre = centre.cast<float>();
                        items[i].triangle = i;
                      }
                    });
  pairs_.resize(1 + below(static_cast<std::uint32_t>(items.size())).first / 2);
  node(0) = {{}, {}, 0, static_cast<std::uint32_t>(items.size())};
  build(0, 2, items);
}

// The node's triangles are items [first, first + count); the nodes below it begin at `below`: its two children, then
// all below the left one, then all below the right one. So each task has its own place, whoever runs it. A median split
// bounds the depth to log2 n.
void TriangleTree::build(std::uint32_t index, std::uint32_t below_node, std::vector<Item>& items) {
  const auto [first, count] = std::pair(node(index).first, node(index).count);
  if (count <= kLeaf) {
    for (auto i = first; i < first + count; ++i) order_[i] = items[i].triangle;
    fitLeaf(node(index));
    return;
  }
  Eigen::Vector3f low = items[first].centre, high = low;
  for (auto i = first; i < first + count; ++i) {
    low = low.cwiseMin(items[i].centre);
    high = high.cwiseMax(items[i].centre);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t half = count / 2;
  std::nth_element(items.begin() + first, items.begin() + first + half, items.begin() + first + count,
                   [axis](const Item& a, const Item& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis]
                                                             : a.triangle < b.triangle;
                   });
  Node &left = node(below_node), &right = node(below_node + 1);
  left = {{}, {}, first, half};
  right = {{}, {}, first + half, count - half};
  const auto below_left = below_node + 2, below_right = below_left + below(half).first;
  if (count > kAlone)
    tbb::parallel_invoke([&] { build(below_node, below_left, items); },
                         [&] { build(below_node + 1, below_right, items); });
  else
    build(below_node, below_left, items), build(below_node + 1, below_right, items);
  node(index) = {left.low.cwiseMin(right.low), left.high.cwiseMax(right.high), below_node, 0};
}

void TriangleTree::fitLeaf(Node& node) const {
  Eigen::Vector3d low = positions_[triangles_[order_[node.first]][0]], high = low;
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (const auto corner : triangles_[order_[i]]) {
      low = low.cwiseMin(positions_[corner]);
      high = high.cwiseMax(positions_[corner]);
    }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k) {
    node.low[k] = std::nextafter(static_cast<float>(low[k]), -kFar);
    node.high[k] = std::nextafter(static_cast<float>(high[k]), kFar);
  }
}

TriangleTree::Near TriangleTree::nearestTriangle(const Eigen::Vector3d& p, double bound, double enough) const {
  Near result{bound};
  result.squared = nearest(
      p, bound,
      [&](std::uint32_t i, double best) {
        const auto& t = triangles_[i];
        const double squared =
            (closestPoint(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]) - p).squaredNorm();
        if (squared < best) result.triangle = i;
        return squared;
      },
      enough);
  return result;
}

bool TriangleTree::meetsBox(std::uint32_t triangle, const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
  const auto& t = triangles_[triangle];
  const auto &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
  return (a.cwiseMin(b).cwiseMin(c).array() <= high.array()).all() &&
         (a.cwiseMax(b).cwiseMax(c).array() >= low.array()).all();
}

bool TriangleTree::isOutside(const Eigen::Vector3d& p) const {
  double side = 0;
  nearest(p, std::numeric_limits<double>::infinity(), [&](std::uint32_t i, double bound) {
    const auto &a = positions_[triangles_[i][0]], &b = positions_[triangles_[i][1]], &c = positions_[triangles_[i][2]];
    const Eigen::Vector3d away = p - closestPoint(p, a, b, c);
    if (away.squaredNorm() < bound) side = away.dot((b - a).cross(c - a));
    return away.squaredNorm();
  });
  return side > 0;
}

double TriangleTree::squaredDistance(const Eigen::Vector3d& p, double bound) const {
  return nearest(p, bound, [&](std::uint32_t i, double) {
    const auto& t = triangles_[i];
    return (closestPoint(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]) - p).squaredNorm();
  });
}

// Möller and Trumbore 1997, both sides.
double TriangleTree::firstHit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double reach) const {
  return alongRay(origin, direction, reach, [&](std::uint32_t i, double far) {
    const auto& t = triangles_[i];
    const Eigen::Vector3d e1 = positions_[t[1]] - positions_[t[0]], e2 = positions_[t[2]] - positions_[t[0]],
                          h = direction.cross(e2);
    const double determinant = e1.dot(h);
    if (determinant == 0) return far;
    const Eigen::Vector3d s = origin - positions_[t[0]], q = s.cross(e1);
    const double u = s.dot(h) / determinant, v = direction.dot(q) / determinant, distance = e2.dot(q) / determinant;
    return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : far;
  });
}

}  // namespace standpoint
