// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_tree.h"

#include <algorithm>

namespace standpoint {

namespace {

// The middle of them, by which they are halved along the longest side, in an order that does not depend on the
// library's.
std::size_t halve(std::vector<EdgeTree::Edge>& edges, std::size_t from, std::size_t to) {
  if (to - from < 2) return to;
  Eigen::AlignedBox3f middles;
  for (std::size_t i = from; i < to; ++i) middles.extend(edges[i].from + edges[i].to);
  int side = 0;
  middles.sizes().maxCoeff(&side);
  const auto at = [&edges](std::size_t i) { return edges.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t middle = from + (to - from) / 2;
  std::nth_element(at(from), at(middle), at(to), [side](const EdgeTree::Edge& a, const EdgeTree::Edge& b) {
    const float one = a.from[side] + a.to[side], other = b.from[side] + b.to[side];
    return one != other ? one < other : a.number < b.number;
  });
  return middle;
}

}  // namespace

EdgeTree::EdgeTree(std::vector<Edge> edges) {
  for (const Edge& edge : edges)
    farthest_coordinate_m_ = std::max(
        farthest_coordinate_m_, static_cast<double>(edge.from.cwiseAbs().cwiseMax(edge.to.cwiseAbs()).maxCoeff()));
  if (!edges.empty()) root_ = build(edges, 0, edges.size());
}

std::uint32_t EdgeTree::build(std::vector<Edge>& edges, std::size_t from, std::size_t to) {
  if (to - from <= kEight) {
    Leaf& leaf = leaves_.emplace_back();
    for (std::size_t i = from; i < to; ++i) {
      for (int side = 0; side < 3; ++side) {
        leaf.edges.from[side][i - from] = edges[i].from[side];
        leaf.edges.to[side][i - from] = edges[i].to[side];
      }
      leaf.number[i - from] = edges[i].number;
    }
    return kLeaf | static_cast<std::uint32_t>(leaves_.size() - 1);
  }
  // Halves of halves of halves, from the last one on as they move up.
  std::array<std::size_t, kEight + 1> bounds{from, to};
  for (std::size_t parts = 1; parts < kEight; parts *= 2)
    for (std::size_t part = parts; part-- > 0;) {
      const std::size_t first = bounds[part], end = bounds[part + 1];
      bounds[2 * part] = first, bounds[2 * part + 1] = halve(edges, first, end), bounds[2 * part + 2] = end;
    }
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  for (std::uint32_t k = 0; k < kEight; ++k) {
    if (bounds[k] == bounds[k + 1]) continue;
    Eigen::AlignedBox3f box;
    for (std::size_t i = bounds[k]; i < bounds[k + 1]; ++i) box.extend(edges[i].from), box.extend(edges[i].to);
    const std::uint32_t held = build(edges, bounds[k], bounds[k + 1]);
    Node& node = nodes_[at];
    for (int side = 0; side < 3; ++side) {
      node.boxes.low[side][k] = box.min()[side];
      node.boxes.high[side][k] = box.max()[side];
    }
    node.held[k] = held;
  }
  return at;
}

}  // namespace standpoint
