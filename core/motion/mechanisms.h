// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#include "core/motion/pose_function.h"

namespace standpoint {

// When something that a machine moves is how far along, from 0 at `begins_s` on: evenly for ever, or smoothly to an
// extent, where it stays or from where it goes back and forth. The rate is the mean one for ever and the largest one
// else.
struct Drive {
  double rate = 0;    // a second
  double extent = 0;  // 0: none
  bool repeats = false;
  double begins_s = 0;
  double at(double time_s) const;
};

// Turns about an axis through a place by radians of its drive, counter-clockwise seen from the axis' tip, or slides
// along it by metres. local_from_rest, for ever.
class DrivenPose final : public PoseFunction {
 public:
  enum class Way { turning, sliding };
  DrivenPose(Way way, const Eigen::Vector3d& place, const Eigen::Vector3d& axis_unit, const Drive& drive)
      : way_(way), place_(place), axis_(axis_unit), drive_(drive) {}
  Pose pose(double time_s) const override;
  double first_s() const override { return -std::numeric_limits<double>::infinity(); }
  double last_s() const override { return std::numeric_limits<double>::infinity(); }

 private:
  Way way_;
  Eigen::Vector3d place_, axis_;
  Drive drive_;
};

// Another function by a clock of its own: from `begins_s` on, and again and again where it repeats, with 1.5 s to turn
// back from its last pose to its first. Until then it is at its beginning.
class TimedPose final : public PoseFunction {
 public:
  TimedPose(PoseFunctionPtr function, double begins_s, bool repeats)
      : function_(std::move(function)), begins_s_(begins_s), repeats_(repeats) {}
  Pose pose(double time_s) const override;
  double first_s() const override { return begins_s_; }
  double last_s() const override;

 private:
  PoseFunctionPtr function_;
  double begins_s_;
  bool repeats_;
};

}  // namespace standpoint
