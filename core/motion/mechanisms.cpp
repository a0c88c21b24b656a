// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/mechanisms.h"

#include <algorithm>
#include <cmath>

#include "core/motion/pose_spline.h"
#include "core/motion/rotation_vector.h"
#include "core/units.h"

namespace standpoint {

namespace {

constexpr double kTurnBack_s = 1.5;

double eased(double u) { return u * u * (3 - 2 * u); }

}  // namespace

double Drive::at(double time_s) const {
  const double since = std::max(0.0, time_s - begins_s);
  if (extent == 0) return rate * since;
  // u² (3 - 2u) is 1.5 times as fast in its middle as in the mean.
  const double seconds = 1.5 * std::abs(extent / rate);
  double u = since / seconds;
  if (repeats) {
    u -= 2 * std::floor(u / 2);
    if (u > 1) u = 2 - u;
  }
  u = std::min(u, 1.0);
  return extent * eased(u);
}

Pose DrivenPose::pose(double time_s) const {
  double by = drive_.at(time_s);
  if (way_ == Way::sliding) return {Eigen::Quaterniond::Identity(), by * axis_};
  by -= kRadPerTurn * std::floor(by / kRadPerTurn);  // a long time turns as exactly as a short one
  const Eigen::Quaterniond turn = unitRotation(rotationBy(by * axis_));
  return {turn, place_ - turn * place_};
}

Pose TimedPose::pose(double time_s) const {
  const double first = function_->first_s(), seconds = function_->last_s() - first;
  double since = std::max(0.0, time_s - begins_s_);
  if (!repeats_) return function_->pose(first + std::min(since, seconds));
  const double round_s = seconds + kTurnBack_s;
  since -= round_s * std::floor(since / round_s);
  if (since <= seconds) return function_->pose(first + since);
  return poseBetween(function_->pose(first + seconds), function_->pose(first),
                     eased(std::min(1.0, (since - seconds) / kTurnBack_s)));
}

double TimedPose::last_s() const {
  return repeats_ ? std::numeric_limits<double>::infinity() : begins_s_ + function_->last_s() - function_->first_s();
}

}  // namespace standpoint
