// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/walk_pace.h"

namespace standpoint {

namespace {

constexpr double kOver_s = 0.4, kPlaces_m = 0.25;

}  // namespace

void WalkPace::begin(const PaceLimits& limits) {
  *this = {};
  limits_ = limits;
}

// Along the way and about all turns: to and fro is fast, though nobody gets anywhere.
void WalkPace::follow(double now_s, const Eigen::Vector3d& feet, const Eigen::Quaterniond& looks) {
  const double before_s = moments_.empty() ? now_s : moments_.back().time_s;
  moments_.push_back({now_s, feet, looks});
  while (moments_.size() > 2 && moments_[1].time_s <= now_s - kOver_s) moments_.pop_front();
  double way_m = 0, turn_rad = 0;
  for (std::size_t i = 1; i < moments_.size(); ++i) {
    way_m += (moments_[i].feet - moments_[i - 1].feet).norm();
    turn_rad += moments_[i].looks.angularDistance(moments_[i - 1].looks);
  }
  const double seconds = now_s - moments_.front().time_s;
  speed_mps_ = seconds > 0 ? way_m / seconds : 0;
  turn_radps_ = seconds > 0 ? turn_rad / seconds : 0;
  const bool hurried = tooFast() || turnsTooFast();
  if (hurried) hurried_s_ += now_s - before_s;
  const bool apart = places_.size() < 2 || (places_.back().feet - places_[places_.size() - 2].feet).norm() >= kPlaces_m;
  if (apart)
    places_.push_back({feet, hurried});
  else
    places_.back() = {feet, hurried || places_.back().hurried};
}

}  // namespace standpoint
