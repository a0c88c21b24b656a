// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "scanners/engine/beam_packet.h"

namespace standpoint {

// Edges in a tree of boxes, eight to a node, for beams that start anywhere in their frame: 40 to 80 bytes for each.
class EdgeTree {
 public:
  struct Edge {
    Eigen::Vector3f from, to;
    std::uint64_t number = 0;
  };
  struct Part;
  EdgeTree() = default;
  // In any order; numbers differ.
  explicit EdgeTree(std::vector<Edge> edges);
  bool empty() const { return leaves_.empty(); }
  double farthestCoordinate_m() const { return farthest_coordinate_m_; }

  // `near(number, lanes)` of each edge that may be in one of the packet's beams; some are not.
  template <class Near>
  void find(const BeamPacket& packet, const Near& near) const {
    if (empty()) return;
    std::array<std::uint32_t, kMostOpen> open{root_};
    std::size_t count = 1;
    while (count > 0) {
      const std::uint32_t at = open[--count];
      if ((at & kLeaf) == 0) {
        const Node& node = nodes_[at];
        for (std::uint32_t met = packet.meets(node.boxes); met != 0; met &= met - 1)
          open[count++] = node.held[std::countr_zero(met)];
        continue;
      }
      const Leaf& leaf = leaves_[at & ~kLeaf];
      for (std::uint32_t met = packet.meets(leaf.edges); met != 0; met &= met - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(met));
        if (const std::uint32_t lanes = packet.near(leaf.edges, k); lanes != 0) near(leaf.number[k], lanes);
      }
    }
  }

 private:
  static constexpr std::uint32_t kLeaf = 1U << 31U;
  static constexpr std::size_t kMostOpen = 128;  // seven for each level
  struct Node {
    EightBoxes boxes;
    std::uint32_t held[kEight] = {};  // a node, or with kLeaf a leaf
  };
  struct Leaf {
    EightEdges edges;
    std::uint64_t number[kEight] = {};
  };
  // Each yields what its part is held by.
  std::uint32_t build(std::vector<Edge>& edges, const Part& whole, std::uint32_t level, std::vector<Node>& nodes);
  std::uint32_t fill(const std::vector<Edge>& edges, std::size_t from, std::size_t to);
  static std::uint32_t append(const std::vector<Node>& below, std::uint32_t root, std::vector<Node>& nodes);

  double farthest_coordinate_m_ = 0;
  std::uint32_t root_ = kLeaf;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

}  // namespace standpoint
