// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/motion/pose_spline.h"
#include "core/result.h"

namespace standpoint {

// How fast what carries a scanner may move. The defaults are those of somebody who surveys on foot and are not sourced.
struct PathLimits {
  double height_m = 1.3;  // of the body's origin above the floor
  double speed_mps = 0.9;
  double turn_radps = std::numbers::pi / 3;  // of the heading
  double lateral_mps2 = 1.0;                 // acceleration towards the inside of a bend
  double acceleration_mps2 = 0.7;
  double jerk_mps3 = 3.5;
  double blend_m = 0.5;  // stretch of path over which the heading follows a bend
};

struct WalkedPath {
  PoseSpline poses;     // upright, x ahead; from 0 s on, which is where the carrier begins to stand or to walk
  double length_m = 0;  // of the body's way, in space
  std::vector<double> reached_s;  // when each waypoint is reached
};

// The way through waypoints at a person's pace (mobile.md §3.3). The curve is a cubic spline by length, which passes
// each waypoint; legs of more than a metre are straight but for half a metre at their ends, so that the curve keeps
// within 0.1 m of what was clicked. The speed is the largest that the limits allow, from standing to standing; its
// acceleration changes by no more than the jerk. A stop is within 25 mm of its waypoint. An error names the waypoint,
// from 1.
Result<WalkedPath> walkPath(std::span<const Waypoint> waypoints, const PathLimits& limits = {});

}  // namespace standpoint
