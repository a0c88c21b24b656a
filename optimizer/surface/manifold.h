// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "optimizer/surface/shape.h"

namespace standpoint {

// How far a vertex is held: on a line it may join its neighbours on that line; fixed it stays.
enum class Hold : std::uint8_t { free, line, fixed };

// A shape as libraries of half-edges need it: each edge has one or two triangles that agree on its direction, and the
// triangles around a vertex are one fan. Where the shape is otherwise, vertices are repeated; all their copies are
// fixed, so that they stay together. Lines are borders between surfaces and seams of textures. A corner is
// 3 * triangle + k and stands for the edge from there to the triangle's next corner.
struct ManifoldShape {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;   // in the shape's order
  std::vector<std::uint32_t> names;  // of each vertex: the shape's
  std::vector<Hold> holds;
  std::vector<std::uint32_t> charts;                                // of each triangle: across a line there is another
  std::vector<std::pair<std::uint32_t, std::uint32_t>> line_edges;  // the corners on both sides
  std::vector<std::uint32_t> border_edges;                          // corners of edges of one triangle
  std::vector<std::pair<std::uint32_t, std::uint32_t>> odd_edges;   // the shape's vertices: of three triangles or more,
                                                                    // or of two that disagree on the direction
};

// `stays`, where there is one, says of each of the shape's vertices whether it is fixed.
ManifoldShape manifoldOf(const Shape& shape, const std::vector<bool>* stays = nullptr);

inline std::uint32_t nextCorner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

}  // namespace standpoint
