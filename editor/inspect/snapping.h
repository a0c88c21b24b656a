// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "editor/camera/camera.h"

namespace standpoint {

// What of the model a place is held by. A face counts where it is seen edge-on, as walls are in a plan.
enum class Snap { none, face, edge, corner };

struct SnapPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // local frame
  Snap snap = Snap::none;
  std::vector<Eigen::Vector3d> normals;  // unit, outwards: of the faces that meet there
};

// From where one points, in pixels of a picture of `size_px`.
struct SnapView {
  const Camera& camera;
  Eigen::Vector2d size_px, pointer_px;
  double reach_px = 0;
  // Whether a place on this product is seen.
  std::function<bool(std::uint32_t product, const Eigen::Vector3d& place)> sees;
};

// Finds corners, edges and faces seen edge-on near the pointer. Boxes of the instances are worked out once for each
// environment.
class Snapping {
 public:
  void follow(std::shared_ptr<const Environment> environment);
  // `met`: what rays through the pointer and around it have met, local frame. What is nearest in pixels, where a corner
  // may be a little farther than a face seen edge-on, and that than an edge; nothing where none is in reach.
  std::optional<SnapPlace> nearest(std::span<const Eigen::Vector3d> met, const SnapView& view) const;

 private:
  std::shared_ptr<const Environment> environment_;
  std::vector<Bounds> boxes_;  // of the instances that are in the scene, else empty ones
};

}  // namespace standpoint
