// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/environment.h"
#include "core/surface_fit.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

// All triangles that stand in the scene, to be asked for the one that is nearest to a point; local frame.
class ModelSurface {
 public:
  explicit ModelSurface(const Environment& environment);
  bool empty() const { return triangles_.empty(); }
  // With `seen_from`, only triangles that face that place count: a wall has two sides, and a scan saw one of them.
  SurfaceTouch nearest(const Eigen::Vector3d& p, double reach_m, const Eigen::Vector3d* seen_from = nullptr) const;

 private:
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Eigen::Vector3d> normals_;  // unit
  std::unique_ptr<TriangleTree> tree_;
};

}  // namespace standpoint
