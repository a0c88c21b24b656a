// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/placed_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "optimizer/deviation.h"

namespace standpoint {

using Eigen::Vector3d;

namespace {

bool keepsAngles(const Eigen::Affine3d& transform) {
  const Eigen::Matrix3d product = transform.linear().transpose() * transform.linear();
  return (product - Eigen::Matrix3d::Identity() * (product.trace() / 3)).norm() <= 1e-6 * product.trace() && product.trace() > 0;
}

std::vector<std::uint32_t> usedPositions(const Mesh& mesh) {
  std::vector<bool> is_used(mesh.positions.size(), false);
  for (const auto& t : mesh.triangles)
    for (const auto v : t) is_used[v] = true;
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) used.push_back(v);
  return used;
}

}  // namespace

PlacedSurfaces::PlacedSurfaces(const Environment& environment) : solids_(environment.meshes.size() + environment.instances.size()), instances_(environment.instances.size()) {
  std::vector<bool> placed(environment.meshes.size(), false);
  for (const auto& instance : environment.instances) placed[instance.mesh] = true;
  tbb::parallel_for(std::size_t{0}, environment.meshes.size(), [&](std::size_t i) {
    if (!placed[i]) return;
    for (const auto& p : environment.meshes[i]->positions) solids_[i].positions.push_back(p.cast<double>());
    solids_[i].triangles = &environment.meshes[i]->triangles;
    solids_[i].used = usedPositions(*environment.meshes[i]);
    solids_[i].tree = std::make_unique<TriangleTree>(solids_[i].positions, *solids_[i].triangles);
  });
  tbb::parallel_for(std::size_t{0}, instances_.size(), [&](std::size_t i) {
    const auto& instance = environment.instances[i];
    const Solid& mesh = solids_[instance.mesh];
    Placed& placed = instances_[i];
    placed.solid = &mesh;
    placed.world_from_solid = instance.world_from_mesh;
    if (!keepsAngles(instance.world_from_mesh)) {
      Solid& own = solids_[environment.meshes.size() + i];
      for (const auto& p : mesh.positions) own.positions.push_back(instance.world_from_mesh * p);
      own.triangles = mesh.triangles;
      own.used = mesh.used;
      own.tree = std::make_unique<TriangleTree>(own.positions, *own.triangles);
      placed.solid = &own;
      placed.world_from_solid = Eigen::Affine3d::Identity();
    }
    placed.solid_from_world = placed.world_from_solid.inverse();
    placed.scale = std::cbrt(std::abs(placed.world_from_solid.linear().determinant()));
    for (const auto& t : *placed.solid->triangles) {
      const auto& p = placed.solid->positions;
      placed.area += 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() * placed.scale * placed.scale;
    }
  });
  for (std::uint32_t i = 0; i < instances_.size(); ++i) {
    const auto box = bounds(*environment.meshes[environment.instances[i].mesh], environment.instances[i].world_from_mesh);
    if (box.empty()) corners_.insert(corners_.end(), 2, Vector3d::Constant(1e300));  // infinitely far
    else corners_.insert(corners_.end(), {box.min, box.max});
    boxes_.push_back({2 * i, 2 * i + 1, 2 * i});
  }
  tree_ = std::make_unique<TriangleTree>(corners_, boxes_);
}

double PlacedSurfaces::Placed::squaredDistance(const Vector3d& p, double bound, double enough) const {
  const double scale_squared = scale * scale;
  return solid->tree->nearestTriangle(solid_from_world * p, bound / scale_squared, enough / scale_squared).squared * scale_squared;
}

double PlacedSurfaces::squaredDistance(const Vector3d& p, double enough) const {
  const auto to_instance = [&](std::uint32_t i, double bound) { return instances_[i].squaredDistance(p, bound, enough); };
  return tree_->nearest(p, std::numeric_limits<double>::infinity(), to_instance, enough);
}

double PlacedSurfaces::squaredDistance(const Vector3d& p, std::size_t first, std::size_t last) const {
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = first; i < last; ++i) {
    const double to_box = (corners_[2 * i] - p).cwiseMax(p - corners_[2 * i + 1]).cwiseMax(0.0).squaredNorm();
    if (to_box < best) best = instances_[i].squaredDistance(p, best);
  }
  return best;
}

std::vector<Vector3d> PlacedSurfaces::points(std::size_t instance, std::uint32_t count) const {
  const auto& placed = instances_[instance];
  std::vector<Vector3d> result;
  for (const auto& point : pointsByArea(placed.solid->positions, *placed.solid->triangles, count, {instance, 2}))
    result.push_back(placed.world_from_solid * point.position);
  return result;
}

}  // namespace standpoint
