// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/part_file.h"
#include "core/result.h"
#include "pointclouds/octree/octree_file.h"
#include "pointclouds/octree/octree_layout.h"
#include "pointclouds/octree/octree_subtree.h"

namespace standpoint::octree {

// Writes the nodes of an octree as they get complete, then what leads to them.
class OctreeWriter {
 public:
  static Result<OctreeWriter> create(const std::filesystem::path& file);
  // Adds the nodes of a subtree but the first, whose points may still be taken from; returns the number of that.
  Result<std::size_t> add(std::vector<FullNode>& subtree);
  std::size_t add(const Cube& cube, const std::array<std::int32_t, 8>& children);  // without points yet
  Result<void> write(std::size_t node, FullNode& full);                            // its points, once
  Result<void> close(std::size_t root, const Cube& cube, const OctreeKey& key, const CloudHeader& header,
                     const Bounds& bounds);
  std::size_t nodes() const { return nodes_.size(); }
  std::uint64_t points() const { return points_; }
  int levels() const { return levels_; }

 private:
  struct Node {
    std::uint64_t offset = 0;
    std::uint32_t points = 0, checksum = 0;
    std::array<std::int32_t, 8> children = {};
    int level = 0;
  };
  explicit OctreeWriter(PartFile file) : file_(std::move(file)) {}
  std::vector<TableNode> table(std::size_t root) const;
  PartFile file_;
  std::vector<Node> nodes_;
  std::uint64_t points_ = 0;
  int levels_ = 0;
};

}  // namespace standpoint::octree
