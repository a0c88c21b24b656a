// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// A station set-up in the field: where the instrument stands and which way it looks, from targets it has measured.

// A place that was known before: a target's centre, or the ground mark of a station. Project frame.
struct ControlPlace {
  std::string name;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();
};
// What was copied to the instrument before the job.
struct ControlList {
  std::vector<ControlPlace> targets, stations;
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();  // file frame less project frame, for show
};

// A target that was picked and scanned from here.
struct SightedTarget {
  std::string id;                                     // as it was typed
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  // in the scanner's frame, levelled by what the compensator told
  double height_m = 0;                                // of the centre above the known place, as it was typed
  double residual_m = 0;                              // of the fit
  int points = 0;
  bool used = true;
};

struct OrientedTarget {
  std::string id;
  double residual_m = 0;  // distance of the target as measured to where it is known to be
};
// How far a believed place is from the true one: what only the simulation knows.
struct PlaceError {
  double plan_m = 0, height_m = 0, turn_rad = 0;  // none negative
};
PlaceError errorOf(const Pose& believed, const Pose& truth);

struct StationOrientation {
  std::string method, station;
  Pose pose;  // project frame from the levelled scanner frame
  std::vector<OrientedTarget> targets;
  double rms_m = 0;
  bool compensator = true;  // it was on
  bool local = false;       // no coordinates: the station is the origin
  bool accepted = false;
  bool carried_away = false;        // the tripod has left that place since it was accepted
  std::optional<PlaceError> error;  // as it was when it was accepted
};

struct OrientationTask {
  std::string method;  // quick, azimuth, backsight, resection_4, resection_6, auto, traverse, standard
  std::string station;
  std::vector<SightedTarget> sighted;
  std::vector<ControlPlace> known;        // of the traverse: what was carried from the station before
  std::optional<Eigen::Vector3d> axis_m;  // of the instrument over a known mark, with the typed height
  double azimuth_deg = 0;                 // typed, clockwise from grid north
  bool compensator = true;
};

// Targets that the method needs at least, with the compensator as it is switched.
int targetsNeeded(const std::string& method, bool compensator);
// Of those in use, the ones that the method can use: all for `auto`, else those whose ID is known.
int targetsUsable(const OrientationTask& task);
// Errors: too few targets, all in one place or on one line, no known mark, an arrangement that fits in two ways. The
// message is the key of a word.
Result<StationOrientation> solveOrientation(const OrientationTask& task);

}  // namespace standpoint
