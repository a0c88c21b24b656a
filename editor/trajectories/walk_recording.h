// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editor/trajectories/live_scan.h"
#include "editor/trajectories/walk_pace.h"
#include "editor/trajectories/walk_record.h"
#include "editor/trajectories/walked_poses.h"
#include "project/survey/survey_verbs.h"
#include "project/task.h"

namespace standpoint {

// A walk that was recorded and waits until the document is free to take it in.
struct RecordedWalk {
  TrajectoryOptions options;         // without a file: its waypoints
  std::vector<WalkMoment> moments;   // of one that was scanned: a file gets them, with every turn and tilt
  const Carrier* carrier = nullptr;  // likewise
};

// What is recorded while somebody walks: the way, how fast they were, and with a scanner in their hands its pulses.
struct WalkRecording {
  WalkRecord record;
  WalkPace pace;
  double began_s = 0;        // by the walk's clock
  bool scan_wanted = false;  // as soon as what it needs is ready
  std::string instrument;    // that scans, or scanned last
  LiveScan live;
  std::vector<WalkMoment> moments;  // while it scans
  std::optional<RecordedWalk> kept;
  std::unique_ptr<Task<std::filesystem::path>> writes;  // the file of `kept`
  std::string scanned;  // the trajectory that was scanned while it was walked last: a real scan of it is offered
};

}  // namespace standpoint
