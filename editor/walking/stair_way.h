// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "editor/walking/walk_ground.h"

namespace standpoint {

// A tread over which nobody has room, not even crouched.
struct LowPlace {
  Eigen::Vector3d tread = Eigen::Vector3d::Zero();  // local frame
  double headroom_m = 0;
};

struct StairWay {
  std::vector<Eigen::Vector3d> corners;  // from the feet on, on the walkable surface; empty: there is none
  std::optional<LowPlace> low;           // then, the first one that is met; nothing: something else is in the way
};

// By the stair within `box` to the floor beside it at about `elevation_m`, both in the local frame; upright where that
// is possible, else crouched.
StairWay stairWay(const WalkedGround& ground, const Eigen::Vector3d& feet, const Bounds& box, double elevation_m);

}  // namespace standpoint
