// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "optimizer/walk/obstacles.h"
#include "optimizer/walk/walkable_map.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// Whether a beam from `eye` meets any of somebody who stands there, glass or not in between. A door that the model has
// closed hides.
bool isInBeam(const RayScene& scene, const Eigen::Vector3d& eye, const Eigen::Vector3d& feet, const Body& body);

// Somewhere to walk to.
struct WalkAim {
  Eigen::Vector3d feet = Eigen::Vector3d::Zero();
  double way_m = 0;  // on the walkable surface
};
// The nearest place, by the way to it, where no beam from `eye` meets one; nothing: there is none that can be walked
// to.
std::optional<WalkAim> nearestHiding(const WalkableMap& map, const RayScene& scene, const Eigen::Vector3d& eye,
                                     const Eigen::Vector3d& feet, const Body& body);
// The nearest place within an arm's reach of a tripod that stands at `foot`, and not in its legs.
std::optional<WalkAim> nearestBeside(const WalkableMap& map, const Eigen::Vector3d& foot, const Eigen::Vector3d& feet);

// Of somebody who is in no hurry.
double walkingTime_s(double way_m);

}  // namespace standpoint
