// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <vector>

#include <Eigen/Geometry>

#include "scanners/instruments/pace_limits.h"

namespace standpoint {

// How fast somebody walks, turns and tilts what they carry: over the last 0.4 s, so that no step and no frame counts
// alone. Keeps the way for a ribbon.
class WalkPace {
 public:
  struct Place {
    Eigen::Vector3d feet;  // local frame
    bool hurried = false;  // faster than the limits there
  };

  void begin(const PaceLimits& limits);
  // Once a frame; `now_s` rises.
  void follow(double now_s, const Eigen::Vector3d& feet, const Eigen::Quaterniond& looks);

  const PaceLimits& limits() const { return limits_; }
  double speed_mps() const { return speed_mps_; }
  double turn_radps() const { return turn_radps_; }
  bool tooFast() const { return limits_.tooFast(speed_mps_); }
  bool turnsTooFast() const { return limits_.turnsTooFast(turn_radps_); }
  double hurried_s() const { return hurried_s_; }               // in all
  const std::vector<Place>& places() const { return places_; }  // a quarter of a metre or more apart, but for the last

 private:
  struct Moment {
    double time_s;
    Eigen::Vector3d feet;
    Eigen::Quaterniond looks;
  };
  PaceLimits limits_;
  std::deque<Moment> moments_;
  double speed_mps_ = 0, turn_radps_ = 0, hurried_s_ = 0;
  std::vector<Place> places_;
};

}  // namespace standpoint
