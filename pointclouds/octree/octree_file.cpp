// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>
#include <sys/stat.h>

#include "pointclouds/e57/crc32c.h"
#include "pointclouds/octree/octree_layout.h"

namespace standpoint {

static_assert(std::endian::native == std::endian::little, "records are read as they lie in the file");

namespace {

template <class T>
std::span<std::uint8_t> bytesOf(T* first, std::size_t count) {
  return {reinterpret_cast<std::uint8_t*>(first), count * sizeof(T)};
}

bool finite(const std::array<double, 3>& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::abs(x) < 1e12; });
}

Eigen::Vector3d vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// Whether a point lies in its node, and is of a scan, a product and a material that there are.
bool belongs(const CloudPoint& point, const CloudHeader& header, double size_m) {
  const auto listed = [](std::uint16_t label, std::size_t count) { return label == kNoLabel || label < count; };
  return point.station < header.stations.size() && listed(point.product, header.products.size()) &&
         listed(point.material, header.materials.size()) &&
         std::all_of(point.position_m.begin(), point.position_m.end(),
                     [&](float x) { return x >= 0 && static_cast<double>(x) <= size_m; });
}

Result<void> readAll(const InputFile& file, std::uint64_t at, std::span<std::uint8_t> bytes, const std::string& place) {
  TRY_ASSIGN(const auto got, file.read(at, bytes));
  if (got != bytes.size()) return failure(ErrorKind::unusable, "the octree file ends early", file.name() + " " + place);
  return {};
}

}  // namespace

Result<OctreeKey> octreeKeyOf(const std::filesystem::path& cloud) {
  struct stat status {};
  if (::stat(cloud.c_str(), &status) != 0) return failure(ErrorKind::file_system, "cannot open", cloud.string());
  return OctreeKey{static_cast<std::uint64_t>(status.st_size),
                   std::int64_t{status.st_mtim.tv_sec} * 1000000000 + status.st_mtim.tv_nsec};
}

Result<std::shared_ptr<const OctreeFile>> OctreeFile::open(const std::filesystem::path& file,
                                                           const std::optional<OctreeKey>& key) {
  TRY_ASSIGN(auto opened, InputFile::open(file));
  std::shared_ptr<OctreeFile> octree(new OctreeFile(std::move(opened)));
  TRY(octree->readHead(key));
  return octree;
}

Result<void> OctreeFile::readHead(const std::optional<OctreeKey>& key) {
  octree::Head head;
  TRY(readAll(file_, 0, bytesOf(&head, 1), "head"));
  const auto refuse = [&](const char* why) { return failure(ErrorKind::unusable, why, file_.name() + " head"); };
  if (head.magic != octree::kMagic) return refuse("not an octree file");
  if (head.version != octree::kVersion) return refuse("made by another version");
  if (head.checksum != crc32c(bytesOf(&head, 1).first(offsetof(octree::Head, checksum)))) return refuse("damaged");
  if (key && *key != OctreeKey{head.cloud_bytes, head.cloud_modified_ns}) return refuse("the cloud has changed since");
  const std::uint64_t size = file_.size();
  if (head.record_bytes != sizeof(CloudPoint) || head.nodes == 0 || head.nodes > octree::kMostNodes ||
      head.nodes_at < octree::kHeadBytes || head.nodes_at > size ||
      head.nodes * sizeof(octree::TableNode) > size - head.nodes_at || head.tables_at > size ||
      head.tables_bytes > size - head.tables_at || head.tables_bytes > octree::kMostTableBytes)
    return refuse("its parts do not lie in the file");
  if (!finite(head.root_min_m) || !finite(head.least_m) || !finite(head.most_m) || !(head.root_size_m > 0) ||
      head.root_size_m > 1e12)
    return refuse("its extent is not one");
  root_min_m_ = vectorOf(head.root_min_m);
  root_size_m_ = head.root_size_m;
  bounds_ = {vectorOf(head.least_m), vectorOf(head.most_m)};
  points_ = head.points;
  TRY(readTable(head.nodes_at, head.nodes * sizeof(octree::TableNode), head.nodes_checksum, head.nodes));
  TRY(checkNodes(head.nodes_at));
  std::string tables(head.tables_bytes, '\0');
  TRY(readAll(file_, head.tables_at, bytesOf(tables.data(), tables.size()), "tables"));
  if (crc32c(bytesOf(tables.data(), tables.size())) != head.tables_checksum)
    return failure(ErrorKind::unusable, "damaged", file_.name() + " tables");
  TRY_ASSIGN(header_, octree::headerFrom(tables, file_.name() + " tables"));
  return {};
}

Result<void> OctreeFile::readTable(std::uint64_t at, std::uint64_t bytes, std::uint32_t checksum, std::uint64_t count) {
  const auto refuse = [&](std::size_t i, const char* why) {
    return failure(ErrorKind::unusable, why, file_.name() + " node " + std::to_string(i));
  };
  std::vector<octree::TableNode> table(count);
  TRY(readAll(file_, at, bytesOf(table.data(), table.size()), "table of nodes"));
  if (crc32c(bytesOf(table.data(), table.size())) != checksum || bytes != table.size() * sizeof(octree::TableNode))
    return failure(ErrorKind::unusable, "damaged", file_.name() + " table of nodes");
  nodes_.resize(count);
  nodes_[0].min_m = root_min_m_;
  nodes_[0].size_m = root_size_m_;
  std::uint64_t next = 1;  // node that is nobody's child yet
  for (std::size_t i = 0; i < count; ++i) {
    const auto& row = table[i];
    auto& node = nodes_[i];
    if (i > 0 && i >= next) return refuse(i, "is nobody's child");
    if (row.level != node.level || row.level > octree::kDeepest) return refuse(i, "has a wrong level");
    node.offset = row.offset;
    node.points = row.points;
    node.checksum = row.checksum;
    node.children = static_cast<std::uint8_t>(std::popcount(row.children));
    node.first_child = row.first_child;
    if (row.children == 0) continue;
    if (row.first_child != next || next + node.children > count) return refuse(i, "has children that are not its own");
    for (unsigned octant = 0; octant < 8; ++octant) {
      if ((row.children >> octant & 1U) == 0) continue;
      auto& child = nodes_[next++];
      child.size_m = node.size_m / 2;
      child.min_m = node.min_m + child.size_m * Eigen::Vector3d(octant & 1U, octant >> 1 & 1U, octant >> 2 & 1U);
      child.level = static_cast<std::uint8_t>(node.level + 1);
    }
  }
  if (next != count)
    return failure(ErrorKind::unusable, "has nodes without a parent", file_.name() + " table of nodes");
  return {};
}

// Side by side, from the head to the table: no byte is two nodes', or nobody's.
Result<void> OctreeFile::checkNodes(std::uint64_t data_end) const {
  std::vector<std::size_t> by_place(nodes_.size());
  for (std::size_t i = 0; i < by_place.size(); ++i) by_place[i] = i;
  std::sort(by_place.begin(), by_place.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(nodes_[a].offset, nodes_[a].points) < std::pair(nodes_[b].offset, nodes_[b].points);
  });
  std::uint64_t at = octree::kHeadBytes, points = 0;
  for (const std::size_t i : by_place) {
    if (nodes_[i].offset != at)
      return failure(ErrorKind::unusable, "has points that are not its own",
                     file_.name() + " node " + std::to_string(i));
    at += std::uint64_t{nodes_[i].points} * sizeof(CloudPoint);
    points += nodes_[i].points;
  }
  if (at != data_end || points != points_)
    return failure(ErrorKind::unusable, "has other points than its head says", file_.name() + " table of nodes");
  return {};
}

Result<std::vector<CloudPoint>> OctreeFile::read(std::size_t node) const {
  const std::string place = "node " + std::to_string(node);
  std::vector<CloudPoint> points(nodes_[node].points);
  TRY(readAll(file_, nodes_[node].offset, bytesOf(points.data(), points.size()), place));
  if (crc32c(bytesOf(points.data(), points.size())) != nodes_[node].checksum)
    return failure(ErrorKind::unusable, "the points are damaged", file_.name() + " " + place);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!belongs(points[i], header_, nodes_[node].size_m))
      return failure(ErrorKind::unusable, "has a point that is not its own",
                     file_.name() + " " + place + " point " + std::to_string(i));
  return points;
}

}  // namespace standpoint
