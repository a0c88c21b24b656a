// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "pointclouds/octree/octree_file.h"

namespace standpoint {

// From where an octree is looked at, in its own frame.
struct NodeView {
  Eigen::Matrix4d clip_from_cloud = Eigen::Matrix4d::Identity();
  Eigen::Vector3d eye_m = Eigen::Vector3d::Zero();
  double pixels = 1000;  // that a metre takes at a distance of 1 m; seen in parallel: everywhere
  bool parallel = false;
  double pixelsPerMetre(const OctreeNode& node) const;
};

struct NodeChoice {
  std::vector<std::uint32_t> nodes;  // a parent before its children, what is large in the picture before what is small
  std::uint64_t points = 0;
  bool all = true;  // nothing was left out for want of room
};

// What of an octree is worth drawing: nodes in sight, from the root on, until the gaps between points are less than a
// pixel or `most_points` would be exceeded. The root is always one of them.
NodeChoice chooseNodes(const std::vector<OctreeNode>& nodes, const NodeView& view, std::uint64_t most_points);

}  // namespace standpoint
