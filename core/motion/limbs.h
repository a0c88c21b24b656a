// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <memory>

#include "core/motion/pose_function.h"
#include "core/motion/stride.h"

namespace standpoint {

// The rigid parts of somebody who walks. At rest a body stands upright at the origin, feet at z = 0, and looks along x.
enum class Limb { trunk, left_thigh, right_thigh, left_shank, right_shank, left_arm, right_arm };
constexpr std::array<Limb, 7> kLimbs = {Limb::trunk,       Limb::left_thigh, Limb::right_thigh, Limb::left_shank,
                                        Limb::right_shank, Limb::left_arm,   Limb::right_arm};

// Where the joints of a body of 1.75 m are, above the floor and aside.
constexpr double kHip_m = 0.92, kKnee_m = 0.48, kShoulder_m = 1.42, kHipAside_m = 0.09, kShoulderAside_m = 0.25;

// A limb of a walker along a path of upright poses on the floor, whose stride it is: local_from_rest. Thighs swing so
// far that the feet are a step apart, arms the other way by 0.7 of it; a knee bends by up to 50° while its leg swings
// forward, and the trunk sinks as the legs part. Angles of knees and arms are not sourced.
class LimbPose final : public PoseFunction {
 public:
  LimbPose(PoseFunctionPtr path, std::shared_ptr<const Stride> stride, Limb limb)
      : path_(std::move(path)), stride_(std::move(stride)), limb_(limb) {}
  Pose pose(double time_s) const override;
  double first_s() const override { return path_->first_s(); }
  double last_s() const override { return path_->last_s(); }

 private:
  PoseFunctionPtr path_;
  std::shared_ptr<const Stride> stride_;
  Limb limb_;
};

}  // namespace standpoint
