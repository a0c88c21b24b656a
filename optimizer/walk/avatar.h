// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "optimizer/walk/obstacles.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

// Somebody who walks: an upright capsule whose feet are on the floor under its axis, who climbs what is no higher than
// a step and lets nothing else through. It does not fall: where the floor ends, or goes down by more than a step, it
// stops. No window, no clock: whoever steers it says how far it wants to go. Keeps a reference to the obstacles.
class Avatar {
 public:
  explicit Avatar(const Obstacles& obstacles, const Body& body = {}) : obstacles_(&obstacles), body_(body) {}

  // Puts it on the highest floor at most `reach_m` under p on which it has room; false, and it stays where it is, where
  // there is none.
  bool stand(const Eigen::Vector3d& p, double reach_m = 3);

  // Goes by this much, in strides so short that no step is left out, and slides along what is in the way.
  void walk(const Eigen::Vector2d& way_m);

  const Eigen::Vector3d& feet() const { return feet_; }

 private:
  Body upper() const { return {body_.radius_m, body_.height_m - kStepHeight}; }
  std::optional<double> floorUnder(const Eigen::Vector3d& p, double below_m) const;
  bool moveTo(const Eigen::Vector3d& place);
  void stride(Eigen::Vector2d way_m);

  const Obstacles* obstacles_;
  Body body_;
  Eigen::Vector3d feet_ = Eigen::Vector3d::Zero();
};

}  // namespace standpoint
