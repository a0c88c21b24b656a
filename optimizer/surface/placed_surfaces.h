// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/environment.h"
#include "optimizer/surface/shape.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

// All surfaces of an environment, to be asked for distances: trees over the meshes, and one over the instances' boxes,
// so that a mesh with a thousand copies is held once. Keeps references: the environment's meshes must outlive it.
class PlacedSurfaces {
 public:
  // For a mesh: its welded shape and that one's tree, if someone has them already.
  struct Known {
    const Shape* shape = nullptr;
    const TriangleTree* tree = nullptr;
  };
  explicit PlacedSurfaces(const Environment& environment, const std::vector<Known>& known = {});

  // From a place in the local frame to the nearest of all surfaces; infinite where there are none.
  // May end with the first that is no further than the root of `enough`.
  double squaredDistance(const Eigen::Vector3d& p, double enough = 0) const;
  // The same to the instances [first, last) only.
  double squaredDistance(const Eigen::Vector3d& p, std::size_t first, std::size_t last) const;
  // What a ray from `origin` meets first; `instance` is the largest number where it meets nothing within `reach`.
  struct Hit {
    double distance = 0;
    std::size_t instance = static_cast<std::size_t>(-1);
  };
  Hit firstHit(const Eigen::Vector3d& origin, const Eigen::Vector3d& unit_direction, double reach) const;

  std::size_t instances() const { return instances_.size(); }
  double area(std::size_t instance) const { return instances_[instance].area; }
  std::vector<Eigen::Vector3d> points(std::size_t instance, std::uint32_t count) const;
  // Vertices, without positions that no triangle uses: those are no part of the surface.
  std::size_t vertices(std::size_t instance) const { return instances_[instance].solid->used.size(); }
  Eigen::Vector3d vertex(std::size_t instance, std::size_t i) const {
    const Solid& solid = *instances_[instance].solid;
    return instances_[instance].world_from_solid * (*solid.positions)[solid.used[i]];
  }
  std::size_t triangles(std::size_t instance) const { return instances_[instance].solid->triangles->size(); }
  std::array<Eigen::Vector3d, 3> triangle(std::size_t instance, std::size_t i) const {
    const auto& placed = instances_[instance];
    const auto& t = (*placed.solid->triangles)[i];
    const auto& p = *placed.solid->positions;
    return {placed.world_from_solid * p[t[0]], placed.world_from_solid * p[t[1]], placed.world_from_solid * p[t[2]]};
  }

 private:
  struct Solid {  // a mesh, or a copy of one that is distorted
    std::vector<Eigen::Vector3d> own_positions;
    std::unique_ptr<TriangleTree> own_tree;
    const std::vector<Eigen::Vector3d>* positions = &own_positions;
    const std::vector<Triangle>* triangles = nullptr;
    const TriangleTree* tree = nullptr;
    std::vector<std::uint32_t> used;                   // positions
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // what was taken from the positions
  };
  struct Placed {
    double squaredDistance(const Eigen::Vector3d& p, double bound, double enough = 0) const;

    const Solid* solid = nullptr;
    Eigen::Affine3d solid_from_world, world_from_solid;
    double scale = 1, area = 0;
  };

  std::vector<Solid> solids_;
  std::vector<Placed> instances_;
  std::vector<Eigen::Vector3d> corners_;  // two per instance: its box
  std::vector<Triangle> boxes_;           // (low, high, low) has the instance's box
  std::unique_ptr<TriangleTree> tree_;
};

}  // namespace standpoint
