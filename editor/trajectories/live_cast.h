// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "editor/trajectories/live_points.h"
#include "editor/trajectories/walked_poses.h"
#include "project/survey/scan_preparation.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// What is scanned while somebody walks, and with what.
struct LiveScanSetup {
  std::shared_ptr<const ScanPreparation> world;
  Instrument instrument;  // that is carried
  ScanSettings settings;  // of resolveMovingSettings()
};

// How many of the instrument's pulses one is sent for, so that no more than 450 000 points a second come: of most all.
unsigned usualThinning(const LiveScanSetup& setup);

struct CastPoints {
  std::vector<LivePoint> points;  // in the order of blocks of pulses; places from `origin_m`
  double until_s = 0;             // to where the pulses have been sent: whole blocks of the pattern
};
// The ideal points of one of `one_pulse_in` of the instrument's pulses from one time of the walk to another, each from
// where the scanner is at the pulse's own time: no noise, no width of the beam, no error of the trajectory. The same
// for the same walk, in whatever stretches it is cast. On this thread alone.
Result<CastPoints> castAlong(const LiveScanSetup& setup, const WalkedPoses& poses, double from_s, double to_s,
                             unsigned one_pulse_in, const Eigen::Vector3d& origin_m, Progress& progress);

}  // namespace standpoint
