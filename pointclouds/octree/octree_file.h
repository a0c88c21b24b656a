// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/environment.h"
#include "core/result.h"
#include "pointclouds/files/file_access.h"
#include "pointclouds/octree/cloud_point.h"

namespace standpoint {

// What a cloud's file was when an octree was made of it. A file of another size or time needs another one.
struct OctreeKey {
  std::uint64_t bytes = 0;
  std::int64_t modified_ns = 0;
  bool operator==(const OctreeKey&) const = default;
};
Result<OctreeKey> octreeKeyOf(const std::filesystem::path& cloud);

// Each point of the cloud is in one node: in the coarsest whose grid of 128³ cells has it in a cell to itself, as far
// as coarser nodes have left it. So a node and all above it are an even part of what is there, as fine as the node's
// spacing. The points of a node are in no order of place: its first n are an even part of it, too.
struct OctreeNode {
  Eigen::Vector3d min_m = Eigen::Vector3d::Zero();  // of its cube, from CloudHeader::origin_m; points from here
  double size_m = 0;
  std::uint64_t offset = 0;  // of its points in the file
  std::uint32_t points = 0;
  std::uint32_t first_child = 0;  // those that there are follow each other
  std::uint32_t checksum = 0;     // CRC-32C of its points
  std::uint8_t children = 0;      // how many
  std::uint8_t level = 0;         // 0: the root
  double spacing_m() const { return size_m / 128; }
};

// A cloud in levels of detail, in a file. Only its table of nodes is in memory; points are read when they are wanted,
// by any number of threads. A file that is not what it should be is refused with the place: on opening, or when the
// node is read.
class OctreeFile {
 public:
  // `key`: of the cloud that it must be of.
  static Result<std::shared_ptr<const OctreeFile>> open(const std::filesystem::path& file,
                                                        const std::optional<OctreeKey>& key = {});
  const CloudHeader& header() const { return header_; }
  const Bounds& bounds() const { return bounds_; }  // of the points, from header().origin_m
  std::uint64_t points() const { return points_; }
  const std::vector<OctreeNode>& nodes() const { return nodes_; }  // parents before their children
  Result<std::vector<CloudPoint>> read(std::size_t node) const;

 private:
  explicit OctreeFile(InputFile file) : file_(std::move(file)) {}
  Result<void> readHead(const std::optional<OctreeKey>& key);
  Result<void> readTable(std::uint64_t at, std::uint64_t bytes, std::uint32_t checksum, std::uint64_t count);
  Result<void> checkNodes(std::uint64_t data_end) const;
  InputFile file_;
  CloudHeader header_;
  Bounds bounds_;
  Eigen::Vector3d root_min_m_ = Eigen::Vector3d::Zero();
  double root_size_m_ = 0;
  std::uint64_t points_ = 0;
  std::vector<OctreeNode> nodes_;
};

}  // namespace standpoint
