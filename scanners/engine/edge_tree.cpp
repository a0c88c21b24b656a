// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/edge_tree.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace standpoint {

// A range of edges, and what surrounds it.
struct EdgeTree::Part {
  std::size_t from = 0, to = 0;
  Eigen::AlignedBox3f box, middles;  // of all of each; of the sums of its ends
  std::size_t count() const { return to - from; }
  float cost() const;  // to look through it; nothing where it fits into a leaf
};

namespace {

constexpr int kBins = 32;
constexpr std::size_t kSideBySide = 20'000;  // edges of which parts are built by several threads
constexpr std::size_t kSampled = 8192;       // of the edges of a part, for where it is cut
constexpr std::uint32_t kLevelsByCost = 8;   // below them parts are halved, which bounds how deep the tree is

// A packet meets a box about as often as it is large.
float surfaceOf(const Eigen::AlignedBox3f& box) {
  if (box.isEmpty()) return 0;
  const Eigen::Vector3f d = box.sizes();
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

EdgeTree::Part partOf(const std::vector<EdgeTree::Edge>& edges, std::size_t from, std::size_t to) {
  EdgeTree::Part part{from, to, {}, {}};
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

// About as many, that the second part begins with a leaf of its own.
std::size_t wholeLeaves(const EdgeTree::Part& part, std::size_t count) {
  return std::clamp<std::size_t>((count + kEight / 2) / kEight, 1, (part.count() - 1) / kEight) * kEight;
}

// Halves, along the longest side.
Cut middleCut(const EdgeTree::Part& part) {
  Cut cut{0, wholeLeaves(part, part.count() / 2)};
  part.middles.sizes().maxCoeff(&cut.side);
  return cut;
}

// The one of the least surface times number, in whole leaves.
Cut bestCut(const std::vector<EdgeTree::Edge>& edges, const EdgeTree::Part& part) {
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
  best.count = wholeLeaves(part, best.count);
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

float EdgeTree::Part::cost() const { return count() <= kEight ? -1 : surfaceOf(box) * static_cast<float>(count()); }

EdgeTree::EdgeTree(std::vector<Edge> edges) : leaves_((edges.size() + kEight - 1) / kEight) {
  for (const Edge& edge : edges)
    farthest_coordinate_m_ = std::max(
        farthest_coordinate_m_, static_cast<double>(edge.from.cwiseAbs().cwiseMax(edge.to.cwiseAbs()).maxCoeff()));
  if (!edges.empty()) root_ = build(edges, partOf(edges, 0, edges.size()), 0, nodes_);
}

// Parts begin at whole leaves, so each leaf's place is known before.
std::uint32_t EdgeTree::fill(const std::vector<Edge>& edges, std::size_t from, std::size_t to) {
  Leaf& leaf = leaves_[from / kEight];
  for (std::size_t i = from; i < to; ++i) {
    for (int side = 0; side < 3; ++side) {
      leaf.edges.from[side][i - from] = edges[i].from[side];
      leaf.edges.to[side][i - from] = edges[i].to[side];
    }
    leaf.number[i - from] = edges[i].number;
  }
  return kLeaf | static_cast<std::uint32_t>(from / kEight);
}

std::uint32_t EdgeTree::build(std::vector<Edge>& edges, const Part& whole, std::uint32_t level,
                              std::vector<Node>& nodes) {
  if (whole.count() <= kEight) return fill(edges, whole.from, whole.to);
  std::array<Part, kEight> parts{whole};
  std::size_t count = 1;
  const bool by_cost = level < kLevelsByCost;
  while (count < kEight) {
    Part& dearest = *std::max_element(
        parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count),
        [by_cost](const Part& a, const Part& b) { return by_cost ? a.cost() < b.cost() : a.count() < b.count(); });
    if (dearest.count() <= kEight) break;
    const Part cut = dearest;
    const std::size_t middle = cutAt(edges, cut.from, cut.to, by_cost ? bestCut(edges, cut) : middleCut(cut));
    dearest = partOf(edges, cut.from, middle), parts[count++] = partOf(edges, middle, cut.to);
  }
  const std::size_t at = nodes.size();
  nodes.emplace_back();
  std::array<std::uint32_t, kEight> held{};
  if (whole.count() > kSideBySide) {
    std::array<std::vector<Node>, kEight> below;
    // Others may wait for this tree: no thread may take up their work meanwhile.
    tbb::this_task_arena::isolate([&] {
      tbb::parallel_for(std::size_t{0}, count,
                        [&](std::size_t k) { held[k] = build(edges, parts[k], level + 1, below[k]); });
    });
    for (std::size_t k = 0; k < count; ++k) held[k] = append(below[k], held[k], nodes);
  } else {
    for (std::size_t k = 0; k < count; ++k) held[k] = build(edges, parts[k], level + 1, nodes);
  }
  Node& node = nodes[at];
  for (std::size_t k = 0; k < count; ++k) {
    for (int side = 0; side < 3; ++side) {
      node.boxes.low[side][k] = parts[k].box.min()[side];
      node.boxes.high[side][k] = parts[k].box.max()[side];
    }
    node.held[k] = held[k];
  }
  return static_cast<std::uint32_t>(at);
}

std::uint32_t EdgeTree::append(const std::vector<Node>& below, std::uint32_t root, std::vector<Node>& nodes) {
  const auto before = static_cast<std::uint32_t>(nodes.size());
  const auto moved = [before](std::uint32_t held) { return (held & kLeaf) != 0 ? held : held + before; };
  nodes.insert(nodes.end(), below.begin(), below.end());
  for (std::size_t i = before; i < nodes.size(); ++i)
    for (std::uint32_t& held : nodes[i].held) held = moved(held);
  return moved(root);
}

}  // namespace standpoint
