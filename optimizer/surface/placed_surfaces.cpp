// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/placed_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "optimizer/surface/deviation.h"

namespace standpoint {

using Eigen::Vector3d;

namespace {

bool keepsAngles(const Eigen::Affine3d& transform) {
  const Eigen::Matrix3d product = transform.linear().transpose() * transform.linear();
  return (product - Eigen::Matrix3d::Identity() * (product.trace() / 3)).norm() <= 1e-6 * product.trace() &&
         product.trace() > 0;
}

std::vector<std::uint32_t> usedPositions(std::size_t count, const std::vector<Triangle>& triangles) {
  std::vector<bool> is_used(count, false);
  for (const auto& t : triangles)
    for (const auto v : t) is_used[v] = true;
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < is_used.size(); ++v)
    if (is_used[v]) used.push_back(v);
  return used;
}

}  // namespace

PlacedSurfaces::PlacedSurfaces(const Environment& environment, const std::vector<Known>& known)
    : solids_(environment.meshes.size() + environment.instances.size()), instances_(environment.instances.size()) {
  std::vector<bool> placed_somewhere(environment.meshes.size(), false);
  for (const auto& instance : environment.instances) placed_somewhere[instance.mesh] = true;
  const auto grow = [](Solid& solid) {
    solid.used = usedPositions(solid.positions->size(), *solid.triangles);
    if (solid.tree) return;
    solid.own_tree = std::make_unique<TriangleTree>(*solid.positions, *solid.triangles);
    solid.tree = solid.own_tree.get();
  };
  tbb::parallel_for(std::size_t{0}, environment.meshes.size(), [&](std::size_t i) {
    if (!placed_somewhere[i]) return;
    Solid& solid = solids_[i];
    if (i < known.size() && known[i].tree) {
      solid.positions = &known[i].shape->positions;
      solid.triangles = &known[i].shape->triangles;
      solid.tree = known[i].tree;
      solid.centre = known[i].shape->centre;
    } else {
      for (const auto& p : environment.meshes[i]->positions) solid.own_positions.push_back(p.cast<double>());
      solid.triangles = &environment.meshes[i]->triangles;
    }
    grow(solid);
  });
  tbb::parallel_for(std::size_t{0}, instances_.size(), [&](std::size_t i) {
    const auto& instance = environment.instances[i];
    const Solid& mesh = solids_[instance.mesh];
    Placed& placed = instances_[i];
    placed.solid = &mesh;
    placed.world_from_solid = instance.world_from_mesh * Eigen::Translation3d(mesh.centre);
    if (!keepsAngles(instance.world_from_mesh)) {
      Solid& own = solids_[environment.meshes.size() + i];
      for (const auto& p : *mesh.positions) own.own_positions.push_back(placed.world_from_solid * p);
      own.triangles = mesh.triangles;
      grow(own);
      placed.solid = &own;
      placed.world_from_solid = Eigen::Affine3d::Identity();
    }
    placed.solid_from_world = placed.world_from_solid.inverse();
    placed.scale = std::cbrt(std::abs(placed.world_from_solid.linear().determinant()));
    for (const auto& t : *placed.solid->triangles) {
      const auto& p = *placed.solid->positions;
      placed.area += 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() * placed.scale * placed.scale;
    }
  });
  for (std::uint32_t i = 0; i < instances_.size(); ++i) {
    const auto box =
        bounds(*environment.meshes[environment.instances[i].mesh], environment.instances[i].world_from_mesh);
    if (box.empty())
      corners_.insert(corners_.end(), 2, Vector3d::Constant(1e300));  // infinitely far
    else
      corners_.insert(corners_.end(), {box.min, box.max});
    boxes_.push_back({2 * i, 2 * i + 1, 2 * i});
  }
  tree_ = std::make_unique<TriangleTree>(corners_, boxes_);
}

double PlacedSurfaces::Placed::squaredDistance(const Vector3d& p, double bound, double enough) const {
  const double scale_squared = scale * scale;
  return solid->tree->nearestTriangle(solid_from_world * p, bound / scale_squared, enough / scale_squared).squared *
         scale_squared;
}

double PlacedSurfaces::squaredDistance(const Vector3d& p, double enough) const {
  const auto to_instance = [&](std::uint32_t i, double bound) {
    return instances_[i].squaredDistance(p, bound, enough);
  };
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

PlacedSurfaces::Hit PlacedSurfaces::firstHit(const Vector3d& origin, const Vector3d& unit_direction,
                                             double reach) const {
  Hit result;
  result.distance = tree_->alongRay(origin, unit_direction, reach, [&](std::uint32_t i, double far) {
    const auto& placed = instances_[i];  // the same t on both sides, as the direction is not made a unit again
    const double t = placed.solid->tree->firstHit(placed.solid_from_world * origin,
                                                  placed.solid_from_world.linear() * unit_direction, far);
    if (t < far) result.instance = i;
    return t;
  });
  return result;
}

std::vector<Vector3d> PlacedSurfaces::points(std::size_t instance, std::uint32_t count) const {
  const auto& placed = instances_[instance];
  std::vector<Vector3d> result;
  for (const auto& point : pointsByArea(*placed.solid->positions, *placed.solid->triangles, count, {instance, 2}))
    result.push_back(placed.world_from_solid * point.position);
  return result;
}

}  // namespace standpoint
