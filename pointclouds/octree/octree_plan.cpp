// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_plan.h"

#include <algorithm>
#include <numeric>
#include <string>

namespace standpoint::octree {

namespace {

constexpr int kDeepestChunk = 38;                        // what lies closer is one place
constexpr std::uint64_t kMostInOnePlace = 16 * 1000000;  // that are held in memory

}  // namespace

Plan::Plan(const Cube& cube, std::span<const std::uint64_t> counts, std::size_t most_points, PointSpool& spool)
    : most_points_(most_points), spool_(spool), chunk_of_cell_(counts.size(), -1) {
  nodes_.push_back({cube});
  divide(0, counts, 0);
}

void Plan::divide(std::int32_t node, std::span<const std::uint64_t> counts, std::size_t first_cell) {
  const auto points = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (points <= most_points_ || counts.size() == 1) {
    const auto chunk = static_cast<std::int64_t>(spool_.addChunk());
    nodes_[static_cast<std::size_t>(node)].chunk = chunk;
    std::fill_n(chunk_of_cell_.begin() + static_cast<std::ptrdiff_t>(first_cell), counts.size(), chunk);
    return;
  }
  nodes_[static_cast<std::size_t>(node)].chunk = -1;
  const std::size_t eighth = counts.size() / 8;
  for (unsigned octant = 0; octant < 8; ++octant) {
    const auto part = counts.subspan(octant * eighth, eighth);
    if (std::all_of(part.begin(), part.end(), [](std::uint64_t n) { return n == 0; })) continue;
    const auto child = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({nodes_[static_cast<std::size_t>(node)].cube.child(octant), node});
    nodes_[static_cast<std::size_t>(node)].children[octant] = child;
    divide(child, part, first_cell + octant * eighth);
  }
}

Result<void> Plan::split(std::int32_t node) {
  const Cube cube = nodes_[static_cast<std::size_t>(node)].cube;
  const auto full = static_cast<std::size_t>(nodes_[static_cast<std::size_t>(node)].chunk);
  std::vector<std::uint64_t> counts(chunk_of_cell_.size(), 0);
  TRY(spool_.each(full, [&](std::span<const CloudPoint> points) -> Result<void> {
    for (const auto& p : points) ++counts[cellOf(cube, p.position_m, 7)];
    return {};
  }));
  divide(node, counts, 0);
  const auto distribute = [&](std::span<const CloudPoint> points) -> Result<void> {
    for (const auto& p : points)
      TRY(spool_.add(static_cast<std::size_t>(chunk_of_cell_[cellOf(cube, p.position_m, 7)]), p));
    return {};
  };
  TRY(spool_.each(full, distribute));
  spool_.forget(full);
  return {};
}

Result<void> Plan::refine(Progress& progress) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {  // what is divided comes at the end, and is looked at again
    if (nodes_[i].chunk < 0) continue;
    const std::uint64_t points = spool_.points(static_cast<std::size_t>(nodes_[i].chunk));
    if (points <= most_points_) continue;
    TRY(progress.check());
    if (nodes_[i].cube.level <= kDeepestChunk)
      TRY(split(static_cast<std::int32_t>(i)));
    else if (points > kMostInOnePlace)
      return failure(ErrorKind::unusable,
                     std::to_string(points) + " points lie in one place: thin the cloud out first");
  }
  return {};
}

std::vector<std::int32_t> Plan::chunkNodes() const {
  std::vector<std::int32_t> found, open = {0};
  while (!open.empty()) {
    const auto node = open.back();
    open.pop_back();
    const auto& n = nodes_[static_cast<std::size_t>(node)];
    if (n.chunk >= 0) found.push_back(node);
    for (std::size_t octant = 8; octant-- > 0;)
      if (n.children[octant] >= 0) open.push_back(n.children[octant]);
  }
  return found;
}

}  // namespace standpoint::octree
