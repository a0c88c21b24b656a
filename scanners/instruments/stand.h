// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/result.h"

namespace standpoint {

// What a station stands on, from scanners/stands/<id>.json: data with its sources, as an instrument's.
struct TripodStand {
  double clearance_m = 0;                          // from the instrument's centre to any surface
  double headroom_m = 0;                           // above the tilting axis
  double lowest_plate_m = 0, highest_plate_m = 0;  // above the ground
  double foot_radius_m = 0;                        // of the circle on which the three feet stand
  double foot_play_m = 0;                          // a foot may stand so much higher or lower than the middle
  double steepest_rad = 0;                         // of the ground
  double wall_rad = 0;                             // what is steeper is a wall

  double lowest_m(double trunnion_m) const { return lowest_plate_m + trunnion_m; }  // of the tilting axis
  double highest_m(double trunnion_m) const { return highest_plate_m + trunnion_m; }
};

Result<TripodStand> readTripodStand(const std::filesystem::path& file);

}  // namespace standpoint
