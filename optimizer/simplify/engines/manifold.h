// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/result.h"
#include "optimizer/simplify/collapse.h"
#include "optimizer/simplify/quadric.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

// How far a vertex is held: on a line it may join its neighbours on that line; fixed it stays.
enum class Hold : std::uint8_t { free, line, fixed };

// A shape as libraries of half-edges need it: each edge has one or two triangles that agree on its direction, and the
// triangles around a vertex are one fan. Where the shape is otherwise, vertices are repeated; all their copies are
// fixed, so that they stay together. Lines are borders between surfaces and seams of textures.
struct ManifoldShape {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;   // in the shape's order
  std::vector<std::uint32_t> names;  // of each vertex: the shape's
  std::vector<Hold> holds;
  std::vector<Quadric> lines;         // of each vertex: upright planes along its lines, weighted by squared length
  std::vector<Quadric> borders;       // the same along edges of one triangle
  std::vector<std::uint32_t> charts;  // of each triangle: a line runs where two triangles' charts differ
};

// `stays`, where there is one, says of each of the shape's vertices whether it is fixed.
ManifoldShape manifoldOf(const Shape& shape, const std::vector<bool>* stays = nullptr);

// Error where so many triangles have a fixed corner that no engine can get down to the target.
Result<void> checkReachable(const ManifoldShape& manifold, std::size_t triangles);

// What an engine's collapses become on the shape: the fixed one of two vertices is kept, whatever the engine keeps.
class CollapseRecorder {
 public:
  explicit CollapseRecorder(ManifoldShape& manifold) : manifold_(&manifold), triangles_(manifold.triangles.size()) {}
  // The engine's vertex `kept` stands for both afterwards.
  void record(std::uint32_t kept, std::uint32_t removed, std::uint32_t triangles, const Eigen::Vector3d& position);
  std::size_t triangles() const { return triangles_; }
  std::vector<Collapse> take() { return std::move(log_); }

 private:
  ManifoldShape* manifold_;
  std::size_t triangles_;
  std::vector<Collapse> log_;
};

}  // namespace standpoint
