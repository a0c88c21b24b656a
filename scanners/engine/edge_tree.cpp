// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_tree.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace standpoint {

namespace {

constexpr int kBins = 32;
constexpr std::size_t kSideBySide = 20'000;  // edges of which parts are built by several threads
constexpr std::size_t kSampled = 8192;  // of the edges of a part, for where it is cut
constexpr std::uint32_t kLevelsByCost = 8;  // below them parts are halved, which bounds how deep the tree is

// A packet meets a box about as often as it is large.
float surfaceOf(const Eigen::AlignedBox3f& box) {
  if (box.isEmpty()) return 0;
  const Eigen::Vector3f d = box.sizes();
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

// A range of edges, and what surrounds it.
struct Part {
  std::size_t from = 0, to = 0;
  Eigen::AlignedBox3f box, middles;  // of all of each; of the sums of its ends
  std::size_t count() const { return to - from; }
  // To look through it; nothing where it fits into a leaf.
  float cost() const { return count() <= kEight ? -1 : surfaceOf(box) * static_cast<float>(count()); }
};

Part partOf(const std::vector<EdgeTree::Edge>& edges, std::size_t from, std::size_t to) {
  Part part{from, to, {}, {}};
  for (std::size_t i = from; i < to; ++i) {
    part.box.extend(edges[i].from), part.box.extend(edges[i].to);
    part.middles.extend(edges[i].from + edges[i].to);
  }
  return part;
}

// A side, and how many come before the cut along it.
struct Cut {
  int side = 0;
  std::size_t count = 0;
};

// Halves, along the longest side.
Cut middleCut(const Part& part) {
  Cut cut{0, part.count() / 2};
  part.middles.sizes().maxCoeff(&cut.side);
  return cut;
}

// The one of the least surface times number, in whole leaves.
Cut bestCut(const std::vector<EdgeTree::Edge>& edges, const Part& part) {
  const auto leaves = [](std::size_t count) { return static_cast<float>((count + kEight - 1) / kEight); };
  const std::size_t step = 1 + part.count() / kSampled, sampled = (part.count() + step - 1) / step;
  Cut best = middleCut(part);
  float least = std::numeric_limits<float>::infinity();
  for (int side = 0; side < 3; ++side) {
    const float low = part.middles.min()[side], size = part.middles.sizes()[side];
    if (!(size > 0)) continue;
    Eigen::AlignedBox3f box[kBins];
    std::size_t count[kBins] = {};
    for (std::size_t i = part.from; i < part.to; i += step) {
      const float place = (edges[i].from[side] + edges[i].to[side] - low) / size;
      const int bin = std::clamp(static_cast<int>(place * kBins), 0, kBins - 1);
      box[bin].extend(edges[i].from), box[bin].extend(edges[i].to);
      ++count[bin];
    }
    float after[kBins];
    std::size_t left = 0;
    Eigen::AlignedBox3f around;
    for (int bin = kBins - 1; bin > 0; --bin) {
      around.extend(box[bin]), left += count[bin];
      after[bin] = surfaceOf(around) * leaves(left);
    }
    around.setEmpty();
    std::size_t before = 0;
    for (int bin = 0; bin + 1 < kBins; ++bin) {
      around.extend(box[bin]), before += count[bin];
      if (before == 0 || before == sampled) continue;
      const float cost = surfaceOf(around) * leaves(before) + after[bin + 1];
      if (cost < least) least = cost, best = {side, before * step};
    }
  }
  best.count = std::clamp<std::size_t>((best.count + kEight / 2) / kEight, 1, (part.count() - 1) / kEight) * kEight;
  return best;
}

// Where the second part begins, in an order that does not depend on the library's.
std::size_t cutAt(std::vector<EdgeTree::Edge>& edges, std::size_t from, std::size_t to, const Cut& cut) {
  const auto at = [&edges](std::size_t i) { return edges.begin() + static_cast<std::ptrdiff_t>(i); };
  const int side = cut.side;
  std::nth_element(at(from), at(from + cut.count), at(to), [side](const EdgeTree::Edge& a, const EdgeTree::Edge& b) {
    const float one = a.from[side] + a.to[side], other = b.from[side] + b.to[side];
    return one != other ? one < other : a.number < b.number;
  });
  return from + cut.count;
}

}  // namespace

EdgeTree::EdgeTree(std::vector<Edge> edges) {
  for (const Edge& edge : edges)
    farthest_coordinate_m_ = std::max(
        farthest_coordinate_m_, static_cast<double>(edge.from.cwiseAbs().cwiseMax(edge.to.cwiseAbs()).maxCoeff()));
  if (!edges.empty()) root_ = build(edges, 0, edges.size(), 0);
}

std::uint32_t EdgeTree::build(std::vector<Edge>& edges, std::size_t from, std::size_t to, std::uint32_t level) {
  if (to - from <= kEight) {
    Leaf& leaf = leaves_.emplace_back();
    for (std::size_t i = from; i < to; ++i) {
      for (int side = 0; side < 3; ++side) {
        leaf.edges.from[side][i - from] = edges[i].from[side];
        leaf.edges.to[side][i - from] = edges[i].to[side];
      }
      leaf.number[i - from] = edges[i].number;
    }
    return kLeaf | static_cast<std::uint32_t>(leaves_.size() - 1);
  }
  std::array<Part, kEight> parts{partOf(edges, from, to)};
  std::size_t count = 1;
  const bool by_cost = level < kLevelsByCost;
  while (count < kEight) {
    Part& dearest = *std::max_element(
        parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
        [by_cost](const Part& a, const Part& b) { return by_cost ? a.cost() < b.cost() : a.count() < b.count(); });
    if (dearest.count() <= kEight) break;
    const Cut cut = by_cost ? bestCut(edges, dearest) : middleCut(dearest);
    const Part whole = dearest;
    const std::size_t middle = cutAt(edges, whole.from, whole.to, cut);
    dearest = partOf(edges, whole.from, middle), parts[count++] = partOf(edges, middle, whole.to);
  }
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  for (std::uint32_t k = 0; k < count; ++k)
    for (int side = 0; side < 3; ++side) {
      nodes_[at].boxes.low[side][k] = parts[k].box.min()[side];
      nodes_[at].boxes.high[side][k] = parts[k].box.max()[side];
    }
  if (to - from > kSideBySide) {
    std::array<EdgeTree, kEight> trees;
    // Others may wait for this tree: no thread may take up their work meanwhile.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        trees[k].root_ = trees[k].build(edges, parts[k].from, parts[k].to, level + 1);
      });
    });
    for (std::uint32_t k = 0; k < count; ++k) nodes_[at].held[k] = append(trees[k]);
  } else {
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t held = build(edges, parts[k].from, parts[k].to, level + 1);
      nodes_[at].held[k] = held;
    }
  }
  return at;
}

std::uint32_t EdgeTree::append(const EdgeTree& tree) {
  const auto nodes = static_cast<std::uint32_t>(nodes_.size()), leaves = static_cast<std::uint32_t>(leaves_.size());
  const auto moved = [&](std::uint32_t held) { return held + ((held & kLeaf) != 0 ? leaves : nodes); };
  leaves_.insert(leaves_.end(), tree.leaves_.begin(), tree.leaves_.end());
  for (Node node : tree.nodes_) {
    for (std::uint32_t& held : node.held) held = moved(held);
    nodes_.push_back(node);
  }
  return moved(tree.root_);
}

}  // namespace standpoint
