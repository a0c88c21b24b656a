// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "pointclouds/octree/octree_file.h"
#include "pointclouds/octree/octree_plan.h"

namespace standpoint::octree {

// What is known when all points are in their chunks: the rest of the build needs it and the spool, and not the cloud.
struct Sorted {
  OctreeKey key;                     // of the cloud
  std::uint64_t points_at_once = 0;  // that the plan was made for
  Bounds bounds_m;
  std::uint64_t left_out = 0;
  CloudHeader header;
  std::vector<PlanNode> nodes;  // of the plan; chunks are the spool's
};

// For PointSpool::keep; what cannot be read back is nothing.
std::string textOf(const Sorted& sorted);
std::optional<Sorted> sortedFrom(const std::string& text);

}  // namespace standpoint::octree
