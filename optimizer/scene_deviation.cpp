// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/scene_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <tbb/parallel_for.h>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostCorners = 3'000'000;  // that are looked at for the maximum, each way

// Trees over the meshes, and one over the instances' boxes, so that a mesh with a thousand copies is held once.
class Scene {
 public:
  explicit Scene(const Environment& environment);

  double squaredDistance(const Vector3d& p) const;
  std::size_t instances() const { return instances_.size(); }
  double area(std::size_t instance) const { return instances_[instance].area; }
  std::vector<Vector3d> points(std::size_t instance, std::uint32_t count) const;
  // Corners of triangles, one after the other: a position that no triangle uses is no part of the surface.
  std::size_t corners(std::size_t instance) const { return 3 * instances_[instance].solid->triangles->size(); }
  Vector3d corner(std::size_t instance, std::size_t i) const {
    const Solid& solid = *instances_[instance].solid;
    return instances_[instance].world_from_solid * solid.positions[(*solid.triangles)[i / 3][i % 3]];
  }

 private:
  struct Solid {  // a mesh, or a copy of one that is distorted
    std::vector<Vector3d> positions;
    const std::vector<Triangle>* triangles = nullptr;
    std::unique_ptr<TriangleTree> tree;
  };
  struct Placed {
    const Solid* solid = nullptr;
    Eigen::Affine3d solid_from_world, world_from_solid;
    double scale = 1, area = 0;
  };

  std::vector<Solid> solids_;
  std::vector<Placed> instances_;
  std::vector<Vector3d> corners_;       // two per instance: its box
  std::vector<Triangle> boxes_;         // (low, high, low) has the instance's box
  std::unique_ptr<TriangleTree> tree_;
};

bool keepsAngles(const Eigen::Affine3d& transform) {
  const Eigen::Matrix3d product = transform.linear().transpose() * transform.linear();
  return (product - Eigen::Matrix3d::Identity() * (product.trace() / 3)).norm() <= 1e-6 * product.trace() && product.trace() > 0;
}

Scene::Scene(const Environment& environment) : solids_(environment.meshes.size() + environment.instances.size()), instances_(environment.instances.size()) {
  tbb::parallel_for(std::size_t{0}, environment.meshes.size(), [&](std::size_t i) {
    for (const auto& p : environment.meshes[i]->positions) solids_[i].positions.push_back(p.cast<double>());
    solids_[i].triangles = &environment.meshes[i]->triangles;
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

double Scene::squaredDistance(const Vector3d& p) const {
  return tree_->nearest(p, std::numeric_limits<double>::infinity(), [&](std::uint32_t i, double bound) {
    const auto& placed = instances_[i];
    const double scale_squared = placed.scale * placed.scale;
    return placed.solid->tree->squaredDistance(placed.solid_from_world * p, bound / scale_squared) * scale_squared;
  });
}

std::vector<Vector3d> Scene::points(std::size_t instance, std::uint32_t count) const {
  const auto& placed = instances_[instance];
  std::vector<Vector3d> result;
  for (const auto& point : pointsByArea(placed.solid->positions, *placed.solid->triangles, count, {instance, 2}))
    result.push_back(placed.world_from_solid * point.position);
  return result;
}

struct OneWay {
  double max_squared = 0, sum = 0;
  std::size_t count = 0;
};

OneWay oneWay(const Scene& from, const Scene& to, const std::vector<bool>& unchanged, std::uint32_t samples, const Progress& progress) {
  double all = 0;
  for (std::size_t i = 0; i < from.instances(); ++i) all += from.area(i);
  std::vector<std::uint32_t> counts(from.instances(), 0);
  double walked = 0;
  std::uint32_t given = 0;
  for (std::size_t i = 0; i < counts.size() && all > 0; ++i) {
    walked += from.area(i);
    const auto until = static_cast<std::uint32_t>(samples * std::min(1.0, walked / all) + 0.5);
    counts[i] = until - given;
    given = until;
  }
  std::size_t corners = 0;
  for (std::size_t i = 0; i < from.instances(); ++i) corners += unchanged[i] ? 0 : from.corners(i);
  const std::size_t stride = 1 + corners / kMostCorners;
  std::vector<OneWay> parts(from.instances());
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {  // each into its own slot, summed in order below
    if (progress.cancelled()) return;
    if (unchanged[i]) {
      parts[i].count = counts[i];
      return;
    }
    for (const auto& p : from.points(i, counts[i])) {
      const double squared = to.squaredDistance(p);
      if (!std::isfinite(squared)) continue;  // nothing is left at all
      parts[i].max_squared = std::max(parts[i].max_squared, squared);
      parts[i].sum += std::sqrt(squared);
      ++parts[i].count;
    }
    for (std::size_t k = 0; k < from.corners(i); k += stride)
      if (const double squared = to.squaredDistance(from.corner(i, k)); std::isfinite(squared)) parts[i].max_squared = std::max(parts[i].max_squared, squared);
  });
  OneWay result;
  for (const auto& part : parts) {
    result.max_squared = std::max(result.max_squared, part.max_squared);
    result.sum += part.sum;
    result.count += part.count;
  }
  return result;
}

}  // namespace

Deviation sceneDeviation(const Environment& before, const Environment& after, std::uint32_t samples, const Progress& progress) {
  const Scene a(before), b(after);
  const auto unchanged = [&](const Environment& environment) {
    std::vector<bool> result;
    for (const auto& instance : environment.instances) result.push_back(before.meshes[instance.mesh] == after.meshes[instance.mesh]);
    return result;
  };
  const OneWay there = oneWay(a, b, unchanged(before), samples, progress), back = oneWay(b, a, unchanged(after), samples, progress);
  Deviation result;
  result.max_m = std::sqrt(std::max(there.max_squared, back.max_squared));
  const auto mean = [](const OneWay& way) { return way.count > 0 ? way.sum / static_cast<double>(way.count) : 0; };
  result.mean_m = 0.5 * (mean(there) + mean(back));
  for (std::size_t i = 0; i < a.instances(); ++i) result.area_m2 += a.area(i);
  return result;
}

}  // namespace standpoint
