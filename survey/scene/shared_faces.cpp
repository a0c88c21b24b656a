// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scene/shared_faces.h"

#include <cmath>

#include <Eigen/Geometry>

#include "core/face_patches.h"

namespace standpoint {

namespace {

// What modellers mean as one plane; the thinnest layer that is drawn for itself is thicker.
constexpr double kOnePlane_m = 0.001;
constexpr double kParallel = 0.999;

}  // namespace

SharedFaces::SharedFaces(const Environment& environment, const MaterialAssignment& assignment) {
  const AssignedTriangles materials(environment, assignment);
  for (std::uint32_t i = 0; i < environment.instances.size(); ++i) {
    const Instance& instance = environment.instances[i];
    if (!environment.products[instance.product].inScene()) continue;
    const Mesh& mesh = *environment.meshes[instance.mesh];
    const auto first = static_cast<std::uint32_t>(positions_.size());
    for (const auto& p : mesh.positions) positions_.push_back(instance.world_from_mesh * p.cast<double>());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& corners = mesh.triangles[t];
      const Triangle placed = {first + corners[0], first + corners[1], first + corners[2]};
      const Eigen::Vector3d& a = positions_[placed[0]];
      const Eigen::Vector3d across = (positions_[placed[1]] - a).cross(positions_[placed[2]] - a);
      if (!(across.norm() > 0)) continue;  // no area
      triangles_.push_back(placed);
      faces_.push_back({across.normalized(), materials.materialOf(i, t)});
    }
  }
  tree_ = std::make_unique<TriangleTree>(positions_, triangles_);
}

bool SharedFaces::at(const Eigen::Vector3d& place, const Eigen::Vector3d& normal, std::int32_t material) const {
  bool shared = false;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kOnePlane_m);
  tree_->inBox(place - reach, place + reach, [&](std::uint32_t t) {
    const Face& face = faces_[t];
    if (std::abs(face.normal.dot(normal)) < kParallel || face.material == material) return true;
    const auto& corners = triangles_[t];
    const Eigen::Vector3d nearest =
        closestPoint(place, positions_[corners[0]], positions_[corners[1]], positions_[corners[2]]);
    shared = (nearest - place).norm() <= kOnePlane_m;
    return !shared;
  });
  return shared;
}

}  // namespace standpoint
