// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/motion/trajectory_error.h"

namespace standpoint {

struct LoopClosure {
  double time_s = 0, earlier_s = 0;
  double distance_m = 0;  // between the two places
  double way_m = 0;       // from the one to the other
  // How much it tells: the longer the way round and the nearer the places.
  double worth_m() const { return way_m - 5 * distance_m; }
};

struct ClosureRules {
  double radius_m = 2;      // within which a place is known again
  double least_way_m = 10;  // since it was left
  double apart_m = 10;      // of way between closures
};

// Where a path comes back, those that tell most first, no two of them within `apart_m` of way: each to where it first
// was there. `share`, where given, decides whether the two places see enough of the same surfaces (engineering: more
// than 30 %); one that is refused is a missed closure. In the order of time; O(knots log knots) where a place is passed
// a few times.
std::vector<LoopClosure> findClosures(std::span<const ErrorKnot> knots, const ClosureRules& rules = {},
                                      const std::function<bool(const LoopClosure&)>& share = {});

}  // namespace standpoint
