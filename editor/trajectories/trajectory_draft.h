// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/survey.h"

namespace standpoint {

// A trajectory that is being laid.
struct TrajectoryDraft {
  std::vector<Waypoint> waypoints;
  std::string carrier = "hand";
  double height_m = 0, speed_mps = 0;  // 0: the carrier's own
};

}  // namespace standpoint
