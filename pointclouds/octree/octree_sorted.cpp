// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_sorted.h"

#include <nlohmann/json.hpp>

#include "pointclouds/octree/octree_layout.h"

namespace standpoint::octree {

namespace {

using nlohmann::json;

json threeOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d threeFrom(const json& v) {
  return Eigen::Vector3d(v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>());
}

// Parents before their children, and each child knows its parent.
bool isTree(const std::vector<PlanNode>& nodes) {
  if (nodes.empty() || nodes[0].parent != -1) return false;
  const auto count = static_cast<std::int64_t>(nodes.size());
  for (std::int64_t i = 0; i < count; ++i)
    for (const auto child : nodes[static_cast<std::size_t>(i)].children)
      if (child != -1 && (child <= i || child >= count || nodes[static_cast<std::size_t>(child)].parent != i))
        return false;
  return true;
}

}  // namespace

std::string textOf(const Sorted& sorted) {
  json nodes = json::array();
  for (const auto& n : sorted.nodes)
    nodes.push_back({threeOf(n.cube.min_m), n.cube.size_m, n.cube.level, n.parent, n.children, n.chunk});
  return json{
      {"cloud_bytes", sorted.key.bytes},
      {"cloud_modified_ns", sorted.key.modified_ns},
      {"points_at_once", sorted.points_at_once},
      {"bounds", sorted.bounds_m.empty() ? json() : json{threeOf(sorted.bounds_m.min), threeOf(sorted.bounds_m.max)}},
      {"left_out", sorted.left_out},
      {"tables", tablesOf(sorted.header)},
      {"nodes", std::move(nodes)}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<Sorted> sortedFrom(const std::string& text) {
  try {
    const auto root = json::parse(text);
    Sorted sorted;
    sorted.key = {root.at("cloud_bytes").get<std::uint64_t>(), root.at("cloud_modified_ns").get<std::int64_t>()};
    sorted.points_at_once = root.at("points_at_once");
    if (const auto& b = root.at("bounds"); !b.is_null()) sorted.bounds_m = {threeFrom(b.at(0)), threeFrom(b.at(1))};
    sorted.left_out = root.at("left_out");
    auto header = headerFrom(root.at("tables").get<std::string>(), "");
    if (!header) return std::nullopt;
    sorted.header = *std::move(header);
    for (const auto& row : root.at("nodes")) {
      auto& node = sorted.nodes.emplace_back();
      node.cube = {threeFrom(row.at(0)), row.at(1).get<double>(), row.at(2).get<int>()};
      node.parent = row.at(3);
      node.children = row.at(4).get<std::array<std::int32_t, 8>>();
      node.chunk = row.at(5);
    }
    if (isTree(sorted.nodes)) return sorted;
  } catch (const json::exception&) {
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace standpoint::octree
