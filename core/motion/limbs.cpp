// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/limbs.h"

#include <algorithm>
#include <cmath>

#include "core/motion/rotation_vector.h"
#include "core/units.h"

namespace standpoint {

namespace {

constexpr double kArmSwing = 0.7, kKneeBend_rad = 50 * kRadPerDeg;

// Turned by `forward_rad` about the body's y through `joint`, such that what hangs from it goes forward.
Pose swung(double forward_rad, const Eigen::Vector3d& joint) {
  const Eigen::Quaterniond turn = rotationBy({0, -forward_rad, 0});
  return {turn, joint - turn * joint};
}

}  // namespace

Pose LimbPose::pose(double time_s) const {
  const double time = std::clamp(time_s, first_s(), last_s());
  const Stride::At stride = stride_->at(time);
  double sine = 0, cosine = 0;
  portable::sinCos(kRadPerTurn * (stride.turns - std::floor(stride.turns)), sine, cosine);
  const double reach = std::min(0.7, Stride::stepLength_m(stride.speed_mps) / (2 * kHip_m));
  const double widest = kRadPerTurn * portable::turnOf(reach, std::sqrt(1 - reach * reach));
  const double thigh = stride.whole * widest * sine;
  double sine_thigh = 0, cosine_thigh = 1;
  portable::sinCos(std::abs(thigh), sine_thigh, cosine_thigh);
  const Pose body = path_->pose(time) * Pose{Eigen::Quaterniond::Identity(), {0, 0, -kHip_m * (1 - cosine_thigh)}};
  const bool left = limb_ == Limb::left_thigh || limb_ == Limb::left_shank || limb_ == Limb::left_arm;
  const double side = left ? 1 : -1;
  const double forward = std::max(0.0, side * cosine);  // the leg, of how fast it swings most
  Pose placed = body;
  if (limb_ == Limb::left_arm || limb_ == Limb::right_arm)
    placed = body * swung(-side * kArmSwing * thigh, {0, side * kShoulderAside_m, kShoulder_m});
  if (limb_ == Limb::left_thigh || limb_ == Limb::right_thigh || limb_ == Limb::left_shank ||
      limb_ == Limb::right_shank)
    placed = body * swung(side * thigh, {0, side * kHipAside_m, kHip_m});
  if (limb_ == Limb::left_shank || limb_ == Limb::right_shank)
    placed = placed * swung(-stride.whole * kKneeBend_rad * forward * forward, {0, side * kHipAside_m, kKnee_m});
  placed.rotation = unitRotation(placed.rotation);
  return placed;
}

}  // namespace standpoint
