// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/report.h"
#include "core/result.h"
#include "core/survey.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// How far a standing axis leans out of the plumb line and where to, counter-clockwise from the file's X.
struct Tilt {
  double angle_rad = 0, towards_rad = 0;
  bool operator==(const Tilt&) const = default;
};

// Turned about the plumb line first, then leant over. `yawOf` and `tiltOf` take such a rotation apart again.
Eigen::Quaterniond rotationOf(double yaw_rad, const Tilt& tilt);
double yawOf(const Eigen::Quaterniond& rotation);
Tilt tiltOf(const Eigen::Quaterniond& rotation);

// A levelling error: any tilt up to `most_rad` alike, by seed and the station's name.
Tilt drawnTilt(double max_rad, std::uint64_t seed, const std::string& station);

// What the device knows of its tilt.
struct Levelling {
  bool compensator = true;  // switched on
  bool exact = false;       // it measures without error
  std::uint64_t seed = 1;
};

// The pose that the device believes in: the true one where it stands level; else with the tilt that its compensator
// measures, with the compensator's error; upright where there is none or it is off, so that its points come tilted.
// Beyond the compensator's range it is refused.
Result<Pose> believedPose(const Station& station, const Instrument& instrument, const Levelling& levelling,
                          Report& report);

}  // namespace standpoint
