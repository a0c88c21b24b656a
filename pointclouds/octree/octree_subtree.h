// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pointclouds/octree/cloud_point.h"
#include "pointclouds/octree/octree_grid.h"

namespace standpoint::octree {

constexpr std::size_t kLeafPoints = 20000;  // a cube with more is divided

// A point and its rank, which is drawn by lot from its bytes: the same whatever order the points come in.
struct Ranked {
  std::uint64_t rank = 0;
  CloudPoint point;  // its place from the cloud's origin
};
std::uint64_t rankOf(const CloudPoint& point);

// A node with all its points.
struct FullNode {
  Cube cube;
  std::vector<Ranked> points;
  std::array<std::int32_t, 8> children = {-1, -1, -1, -1, -1, -1, -1, -1};  // indices
};

// The octree below a cube, of points that are in memory: [0] is the cube's own node. A node that is not divided has all
// points of its cube, another one the first by rank in each of its cells. Some of the root's points are later taken by
// its parent.
std::vector<FullNode> subtreeOf(const Cube& cube, std::vector<CloudPoint> points);

// Puts the points of a node into the order of their ranks, which is that of the file.
void settle(FullNode& node);

// Gives a node what it takes from its children: of each of its cells the first by rank. What stays is
// settled.
void takeFromChildren(FullNode& node, std::span<FullNode* const> children);

}  // namespace standpoint::octree
