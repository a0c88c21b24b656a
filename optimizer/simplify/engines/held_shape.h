// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/result.h"
#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/simplify/collapses/quadric.h"
#include "optimizer/surface/manifold.h"

namespace standpoint {

// With what holds its vertices: upright planes along edges, weighted by their squared length.
struct HeldShape : ManifoldShape {
  std::vector<Quadric> lines, borders;  // of each vertex
};

HeldShape heldShapeOf(const Shape& shape, const std::vector<bool>* stays = nullptr);

// Error where so many triangles have only fixed corners that no engine can get down to the target.
Result<void> checkReachable(const ManifoldShape& manifold, std::size_t triangles);

// What an engine's collapses become on the shape: the fixed one of two vertices is kept, whatever the engine keeps.
class CollapseRecorder {
 public:
  explicit CollapseRecorder(HeldShape& held) : held_(&held), triangles_(held.triangles.size()) {}
  // The engine's vertex `kept` stands for both afterwards.
  void record(std::uint32_t kept, std::uint32_t removed, std::uint32_t triangles, const Eigen::Vector3d& position);
  std::size_t triangles() const { return triangles_; }
  std::vector<Collapse> take() { return std::move(log_); }

 private:
  HeldShape* held_;
  std::size_t triangles_;
  std::vector<Collapse> log_;
};

}  // namespace standpoint
