// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/octree_subtree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "pointclouds/octree/octree_layout.h"

namespace standpoint::octree {

namespace {

bool earlier(const Ranked& a, const Ranked& b) {
  if (a.rank != b.rank) return a.rank < b.rank;
  using Bytes = std::array<std::uint8_t, sizeof(CloudPoint)>;
  return std::bit_cast<Bytes>(a.point) < std::bit_cast<Bytes>(b.point);  // of equal ones one is as good as the other
}

std::uint64_t mixed(std::uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9;
  x ^= x >> 27;
  x *= 0x94d049bb133111eb;
  return x ^ x >> 31;
}

struct Placed {
  std::uint64_t cell;   // of 2^21 each way
  std::uint32_t point;  // index
};

class Divider {
 public:
  Divider(std::vector<Ranked> points, std::vector<Placed> placed)
      : points_(std::move(points)), placed_(std::move(placed)), scratch_(placed_.size()) {}

  std::int32_t divide(const Cube& cube, std::size_t first, std::size_t last, int depth) {
    const auto index = static_cast<std::int32_t>(nodes.size());
    nodes.push_back({cube, {}, {-1, -1, -1, -1, -1, -1, -1, -1}});
    // A grid of its own cells must be left below; what lies closer than that is one place.
    if (last - first <= kLeafPoints || depth + kCellBits >= kPlaceBits) {
      auto& own = nodes.back().points;
      own.reserve(last - first);
      for (std::size_t i = first; i < last; ++i) own.push_back(points_[placed_[i].point]);
      return index;
    }
    const int shift = 3 * (kPlaceBits - 1 - depth);
    std::array<std::size_t, 9> begins = {};
    for (std::size_t i = first; i < last; ++i) ++begins[(placed_[i].cell >> shift & 7U) + 1];
    begins[0] = first;
    for (std::size_t k = 1; k < 9; ++k) begins[k] += begins[k - 1];
    auto to = begins;
    for (std::size_t i = first; i < last; ++i) scratch_[to[placed_[i].cell >> shift & 7U]++] = placed_[i];
    std::copy(scratch_.begin() + static_cast<std::ptrdiff_t>(first),
              scratch_.begin() + static_cast<std::ptrdiff_t>(last),
              placed_.begin() + static_cast<std::ptrdiff_t>(first));
    std::vector<std::int32_t> children;
    for (unsigned octant = 0; octant < 8; ++octant) {
      if (begins[octant] == begins[octant + 1]) continue;
      const std::int32_t child = divide(cube.child(octant), begins[octant], begins[octant + 1], depth + 1);
      nodes[static_cast<std::size_t>(index)].children[octant] = child;
      children.push_back(child);
    }
    std::vector<FullNode*> full;
    for (const auto c : children) full.push_back(&nodes[static_cast<std::size_t>(c)]);
    takeFromChildren(nodes[static_cast<std::size_t>(index)], full);
    return index;
  }

  std::vector<FullNode> nodes;
  static constexpr int kPlaceBits = 21;

 private:
  std::vector<Ranked> points_;
  std::vector<Placed> placed_, scratch_;
};

}  // namespace

std::uint64_t rankOf(const CloudPoint& point) {
  std::array<std::uint64_t, 4> words;
  std::memcpy(words.data(), &point, sizeof(point));
  std::uint64_t rank = 0x9e3779b97f4a7c15;
  for (const auto w : words) rank = mixed(rank ^ w) + 0x9e3779b97f4a7c15;
  return rank;
}

std::vector<FullNode> subtreeOf(const Cube& cube, std::vector<CloudPoint> points) {
  std::vector<Ranked> ranked;
  std::vector<Placed> placed;
  ranked.reserve(points.size());
  placed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ranked.push_back({rankOf(points[i]), points[i]});
    placed.push_back({cellOf(cube, points[i].position_m, Divider::kPlaceBits), static_cast<std::uint32_t>(i)});
  }
  const std::size_t count = points.size();
  std::vector<CloudPoint>().swap(points);
  Divider divider(std::move(ranked), std::move(placed));
  divider.divide(cube, 0, count, 0);
  return std::move(divider.nodes);
}

void settle(FullNode& node) { std::sort(node.points.begin(), node.points.end(), earlier); }

void takeFromChildren(FullNode& node, std::span<FullNode* const> children) {
  struct Candidate {
    std::uint32_t cell, child, index;
  };
  std::vector<Candidate> candidates;
  for (std::uint32_t c = 0; c < children.size(); ++c)
    for (std::uint32_t i = 0; i < children[c]->points.size(); ++i)
      candidates.push_back(
          {static_cast<std::uint32_t>(cellOf(node.cube, children[c]->points[i].point.position_m, kCellBits)), c, i});
  // The first of each cell, by its number in the list of candidates.
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  static thread_local std::vector<std::uint32_t> first;
  first.assign(std::size_t{kGrid} * kGrid * kGrid, kNone);
  const auto at = [&](const Candidate& c) -> Ranked& { return children[c.child]->points[c.index]; };
  for (std::uint32_t k = 0; k < candidates.size(); ++k) {
    auto& best = first[candidates[k].cell];
    if (best == kNone || earlier(at(candidates[k]), at(candidates[best]))) best = k;
  }
  std::vector<std::vector<Ranked>> kept(children.size());
  for (std::uint32_t k = 0; k < candidates.size(); ++k)
    (first[candidates[k].cell] == k ? node.points : kept[candidates[k].child]).push_back(at(candidates[k]));
  for (std::size_t c = 0; c < children.size(); ++c) {
    children[c]->points = std::move(kept[c]);
    settle(*children[c]);
  }
}

}  // namespace standpoint::octree
