// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_writer.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "pointclouds/e57/crc32c.h"

namespace standpoint::octree {

namespace {

template <class T>
std::span<const std::uint8_t> bytesOf(const T* first, std::size_t count) {
  return {reinterpret_cast<const std::uint8_t*>(first), count * sizeof(T)};
}

}  // namespace

Result<OctreeWriter> OctreeWriter::create(const std::filesystem::path& file) {
  TRY_ASSIGN(auto part, PartFile::create(file));
  TRY(part.append(std::vector<std::uint8_t>(kHeadBytes, 0)));
  return OctreeWriter(std::move(part));
}

std::size_t OctreeWriter::add(const Cube& cube, const std::array<std::int32_t, 8>& children) {
  nodes_.push_back({0, 0, 0, children, cube.level});
  levels_ = std::max(levels_, cube.level + 1);
  return nodes_.size() - 1;
}

Result<std::size_t> OctreeWriter::add(std::vector<FullNode>& subtree) {
  const std::size_t begin = nodes_.size();
  for (const auto& n : subtree) {
    auto children = n.children;
    for (auto& c : children)
      if (c >= 0) c += static_cast<std::int32_t>(begin);
    add(n.cube, children);
  }
  for (std::size_t i = 1; i < subtree.size(); ++i) TRY(write(begin + i, subtree[i]));
  return begin;
}

Result<void> OctreeWriter::write(std::size_t node, FullNode& full) {
  std::vector<CloudPoint> points;
  points.reserve(full.points.size());
  for (const auto& ranked : full.points) {
    CloudPoint p = ranked.point;
    for (int k = 0; k < 3; ++k) {
      auto& x = p.position_m[static_cast<std::size_t>(k)];
      // What lies next to nothing before a border is placed beyond it.
      x = static_cast<float>(std::clamp(static_cast<double>(x) - full.cube.min_m[k], 0.0, full.cube.size_m));
    }
    points.push_back(p);
  }
  std::vector<Ranked>().swap(full.points);
  const auto bytes = bytesOf(points.data(), points.size());
  auto& n = nodes_[node];
  n.offset = file_.size();
  n.points = static_cast<std::uint32_t>(points.size());
  n.checksum = crc32c(bytes);
  points_ += points.size();
  return file_.append(bytes);
}

// By levels, so that children stand side by side.
std::vector<TableNode> OctreeWriter::table(std::size_t root) const {
  std::vector<std::size_t> order = {root};
  std::vector<TableNode> rows;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& n = nodes_[order[i]];
    TableNode row{n.offset, n.points, 0, n.checksum, 0, static_cast<std::uint8_t>(n.level), 0};
    for (std::size_t octant = 0; octant < 8; ++octant) {
      if (n.children[octant] < 0) continue;
      if (row.children == 0) row.first_child = static_cast<std::uint32_t>(order.size());
      row.children = static_cast<std::uint8_t>(row.children | 1U << octant);
      order.push_back(static_cast<std::size_t>(n.children[octant]));
    }
    rows.push_back(row);
  }
  return rows;
}

Result<void> OctreeWriter::close(std::size_t root, const Cube& cube, const OctreeKey& key, const CloudHeader& header,
                                 const Bounds& bounds) {
  Head head;
  head.cloud_bytes = key.bytes;
  head.cloud_modified_ns = key.modified_ns;
  head.points = points_;
  head.root_size_m = cube.size_m;
  const auto rows = table(root);
  const std::string tables = tablesOf(header);
  head.nodes = rows.size();
  head.nodes_at = file_.size();
  head.nodes_checksum = crc32c(bytesOf(rows.data(), rows.size()));
  TRY(file_.append(bytesOf(rows.data(), rows.size())));
  head.tables_at = file_.size();
  head.tables_bytes = tables.size();
  head.tables_checksum = crc32c(bytesOf(tables.data(), tables.size()));
  TRY(file_.append(tables));
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    head.root_min_m[k] = cube.min_m[i];
    head.least_m[k] = bounds.empty() ? 0 : bounds.min[i];
    head.most_m[k] = bounds.empty() ? 0 : bounds.max[i];
  }
  head.checksum = crc32c(bytesOf(&head, 1).first(offsetof(Head, checksum)));
  TRY(file_.overwrite(0, bytesOf(&head, 1)));
  return file_.commit();
}

}  // namespace standpoint::octree
