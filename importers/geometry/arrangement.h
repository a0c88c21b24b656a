// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A planar arrangement of directed segments: every crossing and touching is resolved with a snapping distance, and for
// every edge it is known how often each layer winds around the places left and right of it. All polygon Booleans, the
// slabs of prismatic solids and the caps of clips are a choice of edges from such an arrangement.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace standpoint::geometry {

struct Segment {
  std::uint32_t a, b;                     // indices into the points
  std::uint32_t first_layer, last_layer;  // counts in the layers [first, last)
  int weight = 1;                         // -1: as if it ran the other way
  std::uint32_t tag = 0;                  // of an edge that several segments share, the first one's tag is kept
};

struct Arrangement {
  struct Edge {
    std::uint32_t a, b, tag;
  };
  std::size_t layers = 0;
  std::vector<Eigen::Vector2d> points;        // the input's first, then crossings
  std::vector<std::uint32_t> point_of_input;  // input point → the point that stands for it
  std::vector<Edge> edges;
  std::vector<int> left, right;  // windings[edge * layers + layer]

  std::span<const int> leftOf(std::size_t edge) const { return {left.data() + edge * layers, layers}; }
  std::span<const int> rightOf(std::size_t edge) const { return {right.data() + edge * layers, layers}; }
};

// Nothing when the snapping does not settle or the input is too large to be worth it. Points are not moved; of points
// closer than snap_m the first stands for all.
std::optional<Arrangement> arrange(std::span<const Eigen::Vector2d> points, std::span<const Segment> segments,
                                   std::size_t layers, double snap_m);

struct BoundaryLoop {
  std::vector<std::uint32_t> points;
  std::uint32_t tag = 0;  // of its first edge
  std::vector<std::uint32_t> edges;
};
// The boundary of the places where inside() holds, as loops with the inside on their left; a loop meets no point twice.
// Nothing when the edges do not close (the segments were not closed loops).
std::optional<std::vector<BoundaryLoop>> boundary(const Arrangement& arrangement,
                                                  const std::function<bool(std::span<const int>)>& inside);

}  // namespace standpoint::geometry
