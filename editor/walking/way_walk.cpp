// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/walking/way_walk.h"

#include <cmath>

namespace standpoint {

namespace {

constexpr double kArrived_m = 0.16, kOtherFloor_m = 0.4;
constexpr double kNearer_m = 0.01;  // that counts
constexpr double kPatience_s = 0.33, kSidestep_s = 0.4;
constexpr double kAheadInSidestep = 0.3;
constexpr int kMostSidesteps = 12;

}  // namespace

std::optional<Eigen::Vector2d> WayWalk::velocity(const Eigen::Vector3d& feet, double seconds) {
  const auto before = next_;
  while (next_ < corners_.size() && (corners_[next_] - feet).head<2>().norm() < kArrived_m &&
         std::abs(corners_[next_].z() - feet.z()) < kOtherFloor_m)
    ++next_;
  if (arrived() || sidesteps_ > kMostSidesteps) return std::nullopt;
  const Eigen::Vector3d off = corners_[next_] - feet;
  if (next_ != before || off.norm() < nearest_m_ - kNearer_m) {
    nearest_m_ = off.norm();
    waited_s_ = 0;
    sidesteps_ = 0;
  } else if ((waited_s_ += seconds) > kPatience_s + kSidestep_s) {
    waited_s_ = 0;
    side_ = -side_;
    ++sidesteps_;
  }
  const Eigen::Vector2d ahead = off.head<2>().normalized();
  if (waited_s_ <= kPatience_s) return ahead * speed_;
  return Eigen::Vector2d(ahead * kAheadInSidestep + side_ * Eigen::Vector2d(ahead.y(), -ahead.x())).normalized() *
         speed_;
}

std::optional<Eigen::Vector3d> WayWalk::heldUpBefore() const {
  if (arrived() || waited_s_ <= kPatience_s) return std::nullopt;
  return corners_[next_];
}

}  // namespace standpoint
