// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <memory>

#include "core/survey.h"

namespace standpoint {

// A pose as a function of time: of what carries a scanner, or of what moves in a scene. A function is immutable and
// keeps no state, so any thread may ask for any time in any order, and the same time has the same bits.
class PoseFunction {
 public:
  PoseFunction() = default;
  PoseFunction(const PoseFunction&) = default;
  PoseFunction(PoseFunction&&) = default;
  PoseFunction& operator=(const PoseFunction&) = default;
  PoseFunction& operator=(PoseFunction&&) = default;
  virtual ~PoseFunction() = default;

  // local_from_body: x forward, y left, z up. Seconds of the trajectory's own clock. Before first_s() it is the first
  // pose, after last_s() the last.
  virtual Pose pose(double time_s) const = 0;
  virtual double first_s() const = 0;
  virtual double last_s() const = 0;
};
using PoseFunctionPtr = std::shared_ptr<const PoseFunction>;

// Stands for ever.
class ConstantPose : public PoseFunction {
 public:
  explicit ConstantPose(const Pose& pose) : pose_(pose) {}
  Pose pose(double) const override { return pose_; }
  double first_s() const override { return -std::numeric_limits<double>::infinity(); }
  double last_s() const override { return std::numeric_limits<double>::infinity(); }

 private:
  Pose pose_;
};

// Both in the local frame: of the body's origin, and the vector about which the body turns.
struct Velocity {
  Eigen::Vector3d linear_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_radps = Eigen::Vector3d::Zero();
};

// By the poses 0.1 ms before and after, at an end by one side: right within 1e-8 of what a carrier does. At a time
// where nothing moves any more, after last_s() say, it is zero.
Velocity velocity(const PoseFunction& function, double time_s);

}  // namespace standpoint
