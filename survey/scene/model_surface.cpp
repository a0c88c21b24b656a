// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scene/model_surface.h"

#include <limits>

#include <Eigen/Geometry>

namespace standpoint {

ModelSurface::ModelSurface(const Environment& environment) {
  for (const auto& instance : environment.instances) {
    if (!environment.products[instance.product].inScene()) continue;
    const Mesh& mesh = *environment.meshes[instance.mesh];
    const auto first = static_cast<std::uint32_t>(positions_.size());
    for (const auto& p : mesh.positions) positions_.push_back(instance.world_from_mesh * p.cast<double>());
    const bool mirrors = instance.world_from_mesh.linear().determinant() < 0;
    for (const auto& t : mesh.triangles) {
      const Triangle placed = {first + t[0], first + t[mirrors ? 2 : 1], first + t[mirrors ? 1 : 2]};
      const Eigen::Vector3d& a = positions_[placed[0]];
      const Eigen::Vector3d across = (positions_[placed[1]] - a).cross(positions_[placed[2]] - a);
      if (!(across.norm() > 0)) continue;  // no area, no normal
      triangles_.push_back(placed);
      normals_.push_back(across.normalized());
    }
  }
  tree_ = std::make_unique<TriangleTree>(positions_, triangles_);
}

SurfaceTouch ModelSurface::nearest(const Eigen::Vector3d& p, double reach_m, const Eigen::Vector3d* seen_from) const {
  SurfaceTouch touch;
  tree_->nearest(p, reach_m * reach_m, [&](std::uint32_t t, double bound) {
    if (seen_from != nullptr && normals_[t].dot(*seen_from - p) <= 0) return std::numeric_limits<double>::infinity();
    const auto& corners = triangles_[t];
    const Eigen::Vector3d q = closestPoint(p, positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]);
    const double squared = (q - p).squaredNorm();
    if (squared < bound) touch = {q, normals_[t]};
    return squared;
  });
  return touch;
}

}  // namespace standpoint
