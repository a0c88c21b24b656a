// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/points/node_choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>

namespace standpoint {

namespace {

double radius_m(const OctreeNode& node) { return node.size_m * std::numbers::sqrt3 / 2; }
Eigen::Vector3d centre_m(const OctreeNode& node) { return node.min_m.array() + node.size_m / 2; }

// Its sphere is not wholly beyond one side of what is seen.
bool inSight(const OctreeNode& node, const Eigen::Matrix4d& clip) {
  const Eigen::Vector3d centre = centre_m(node);
  const double radius = radius_m(node);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector4d side = clip.row(3).transpose() + sign * clip.row(axis).transpose();
      if (side.head<3>().dot(centre) + side.w() < -radius * side.head<3>().norm()) return false;
    }
  return true;
}

}  // namespace

double NodeView::pixelsPerMetre(const OctreeNode& node) const {
  if (parallel) return pixels;
  // Of its nearest point; from within, as near as half of the node is large.
  return pixels / std::max((centre_m(node) - eye_m).norm() - radius_m(node), node.size_m / 4);
}

NodeChoice chooseNodes(const std::vector<OctreeNode>& nodes, const NodeView& view, std::uint64_t most_points) {
  NodeChoice choice;
  std::priority_queue<std::pair<double, std::uint32_t>> open;  // size in the picture, node
  open.emplace(0, 0);
  while (!open.empty()) {
    const auto index = open.top().second;
    const auto& node = nodes[index];
    open.pop();
    if (!choice.nodes.empty() && choice.points + node.points > most_points) {
      choice.all = false;
      break;
    }
    choice.nodes.push_back(index);
    choice.points += node.points;
    if (node.spacing_m() * view.pixelsPerMetre(node) <= 1) continue;
    for (std::uint32_t c = node.first_child; c < node.first_child + node.children; ++c)
      if (inSight(nodes[c], view.clip_from_cloud)) open.emplace(nodes[c].size_m * view.pixelsPerMetre(nodes[c]), c);
  }
  return choice;
}

}  // namespace standpoint
