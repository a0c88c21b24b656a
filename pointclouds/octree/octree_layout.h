// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "core/result.h"
#include "pointclouds/octree/cloud_point.h"

// How an octree file is laid out, little endian throughout: a head of fixed size; the points of the nodes, one node
// after the other, 32 bytes each (CloudPoint); the table of nodes, in the order of their levels, children of one node
// side by side; the tables of the header as JSON.
namespace standpoint::octree {

inline constexpr std::array<char, 8> kMagic = {'S', 'P', 'O', 'C', 'T', 'R', 'E', 'E'};
inline constexpr std::uint32_t kVersion = 1;
inline constexpr std::uint64_t kHeadBytes = 256;
inline constexpr int kCellBits = 7;  // 128 cells of a node each way
inline constexpr int kDeepest = 60;  // level
inline constexpr std::uint64_t kMostNodes = std::uint64_t{1} << 26;
inline constexpr std::uint64_t kMostTableBytes = std::uint64_t{1} << 28;  // of the JSON

struct Head {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t record_bytes = sizeof(CloudPoint);
  std::uint64_t cloud_bytes = 0;
  std::int64_t cloud_modified_ns = 0;
  std::uint64_t points = 0, nodes = 0;
  std::uint64_t nodes_at = 0, tables_at = 0, tables_bytes = 0;
  std::array<double, 3> root_min_m = {};
  double root_size_m = 0;
  std::array<double, 3> least_m = {}, most_m = {};  // of the points
  std::uint32_t nodes_checksum = 0, tables_checksum = 0;
  std::array<std::uint8_t, 256 - 168> zero = {};
  std::uint32_t checksum = 0;  // of all before it
  std::uint32_t end = 0;
};
static_assert(sizeof(Head) == kHeadBytes);

struct TableNode {
  std::uint64_t offset = 0;
  std::uint32_t points = 0, first_child = 0, checksum = 0;
  std::uint8_t children = 0;  // a bit for each octant that has a child: 1 << (x + 2 y + 4 z)
  std::uint8_t level = 0;
  std::uint16_t zero = 0;
};
static_assert(sizeof(TableNode) == 24);

std::string tablesOf(const CloudHeader& header);
Result<CloudHeader> headerFrom(const std::string& tables, const std::string& file);

}  // namespace standpoint::octree
