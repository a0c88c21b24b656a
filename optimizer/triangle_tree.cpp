// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace standpoint {

namespace {

constexpr std::uint32_t kLeaf = 4;

}  // namespace

Eigen::Vector3d closestPoint(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
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
  std::iota(order_.begin(), order_.end(), 0U);
  std::vector<Eigen::Vector3d> centres(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    centres[i] = positions[triangles[i][0]] + positions[triangles[i][1]] + positions[triangles[i][2]];

  nodes_.reserve(triangles.size());
  nodes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(triangles.size())});
  for (std::size_t at = 0; at < nodes_.size(); ++at) {  // breadth first; a median split bounds the depth to log2 n
    fit(nodes_[at]);
    const auto [first, count] = std::pair(nodes_[at].first, nodes_[at].count);
    if (count <= kLeaf) continue;
    Eigen::Vector3d low = centres[order_[first]], high = low;
    for (std::uint32_t i = first; i < first + count; ++i) {
      low = low.cwiseMin(centres[order_[i]]);
      high = high.cwiseMax(centres[order_[i]]);
    }
    int axis = 0;
    (high - low).maxCoeff(&axis);
    const std::uint32_t half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
                     });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, {}, first, half});
    nodes_.push_back({{}, {}, first + half, count - half});
    nodes_[at].first = children;
    nodes_[at].count = 0;
  }
}

void TriangleTree::fit(Node& node) const {
  node.low = node.high = positions_[triangles_[order_[node.first]][0]];
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (const auto corner : triangles_[order_[i]]) {
      node.low = node.low.cwiseMin(positions_[corner]);
      node.high = node.high.cwiseMax(positions_[corner]);
    }
}

bool TriangleTree::meetsBox(std::uint32_t triangle, const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
  const auto& t = triangles_[triangle];
  const auto &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
  return (a.cwiseMin(b).cwiseMin(c).array() <= high.array()).all() && (a.cwiseMax(b).cwiseMax(c).array() >= low.array()).all();
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

}  // namespace standpoint
