// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "optimizer/optimizer.h"

namespace standpoint {

// What moves among obstacles: an upright capsule that stands on its lowest point, its feet; a sphere where it is as
// high as it is wide.
struct Body {
  double radius_m = 0.3;
  double height_m = 1.8;
  bool operator==(const Body&) const = default;
};

struct Contact {
  double fraction = 0;  // of the way that is free; 0 also where the body starts in something
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // away from the obstacle
  std::uint32_t shape = 0;                            // index into the shapes
  std::uint32_t product = 0;
};

// Collision shapes made ready for questions; local frame, metres. It keeps a copy of what it needs. Questions may be
// asked from many threads at once. Convex shapes are solid, meshes are skins of triangles.
class Obstacles {
 public:
  explicit Obstacles(std::span<const CollisionShape> shapes);
  ~Obstacles();
  Obstacles(Obstacles&&) noexcept;
  Obstacles& operator=(Obstacles&&) noexcept;

  // The first thing that the body meets on the straight way of its feet. What it merely slides along does not stop it.
  std::optional<Contact> sweep(const Body& body, const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  // The obstacle that reaches deepest into the body, when any does by more than `depth_m`.
  std::optional<Contact> overlap(const Body& body, const Eigen::Vector3d& feet, double depth_m = 0) const;
  // Where a ray first meets a surface.
  std::optional<Contact> ray(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  // Everything nearer to the standing body than `within_m`.
  void near(const Body& body, const Eigen::Vector3d& feet, double within_m,
            const std::function<void(const Contact&, double gap_m)>& visit) const;

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace standpoint
