// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "pointclouds/octree/octree_grid.h"
#include "pointclouds/octree/octree_spool.h"

namespace standpoint::octree {

// The upper part of the octree, down to cubes whose points fit into memory.
struct PlanNode {
  Cube cube;
  std::int32_t parent = -1;
  std::array<std::int32_t, 8> children = {-1, -1, -1, -1, -1, -1, -1, -1};
  std::int64_t chunk = -1;  // of the spool; less than 0: it is divided
};

class Plan {
 public:
  // The points of `cube`, counted in its cells.
  Plan(const Cube& cube, std::span<const std::uint64_t> counts, std::size_t most_points, PointSpool& spool);
  // As it was when all points were in their chunks.
  Plan(std::vector<PlanNode> nodes, PointSpool& spool) : most_points_(0), spool_(spool), nodes_(std::move(nodes)) {}
  // The chunk for a point of the whole cube; less than 0: none was counted there.
  std::int64_t chunkOf(const CloudPoint& point) const {
    return chunk_of_cell_[cellOf(nodes_[0].cube, point.position_m, 7)];
  }
  // Divides what is too much for one chunk, once all points are in theirs.
  Result<void> refine(Progress& progress);
  const std::vector<PlanNode>& nodes() const { return nodes_; }
  std::vector<std::int32_t> chunkNodes() const;  // in the order of their places along the octree

 private:
  void divide(std::int32_t node, std::span<const std::uint64_t> counts, std::size_t first_cell);
  Result<void> split(std::int32_t node);
  std::size_t most_points_;
  PointSpool& spool_;
  std::vector<PlanNode> nodes_;
  std::vector<std::int64_t> chunk_of_cell_;  // of the cube that was divided last
};

}  // namespace standpoint::octree
