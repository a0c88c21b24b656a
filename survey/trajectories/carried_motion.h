// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/georeference.h"
#include "core/motion/closures.h"
#include "core/motion/pose_spline.h"
#include "core/motion/trajectory_error.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "core/survey.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// A trajectory as functions of time, local frame, from 0 s or the first sample's time on.
struct CarriedMotion {
  PoseFunctionPtr path;   // without gait and shaking; of a file it is what the file has
  PoseFunctionPtr truth;  // as the body goes it
  double length_m = 0;    // that the carrier goes: of a file that somebody walked without their steps and swaying, too
  double seconds() const { return truth->last_s() - truth->first_s(); }
};

// Waypoints as a carrier walks them, or the file. What a file has lost is in the report; an error names the waypoint,
// or file and line.
Result<CarriedMotion> carriedMotion(const CarriedTrajectory& trajectory, const Georeference& georeference,
                                    Report& report, Progress& progress);

// Poses at even steps from the first to the last time.
Trajectory evenSamples(const PoseFunction& function, double rate_hz);

// A moment on the way, without gait and shaking.
struct PathSample {
  double after_s = 0;                                    // since it begins
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  // of the body, local frame
  double speed_mps = 0, turn_radps = 0;                  // turn: of the body about any axis
};
// At even steps of 0.1 s, or longer ones so that they are no more than `most`; the first and the last moment are there.
std::vector<PathSample> pathSamples(const CarriedMotion& carried, std::size_t most);

// Where the body's centre goes from one side of a surface to the other, within 0.1 s. A door with a leaf is there once:
// whoever walks there opens it, but a scan finds it closed.
struct PathObstacle {
  std::uint32_t product = 0;
  Eigen::Vector3d place_m = Eigen::Vector3d::Zero();  // local frame
  double after_s = 0;                                 // since it begins
  bool closed_door = false;
};
// `opened`: ids of doors that something opens for the scan; they are no obstacles.
std::vector<PathObstacle> obstaclesOf(const CarriedMotion& carried, const RayScene& scene,
                                      std::span<const std::string> opened = {});
std::vector<std::string> openedDoors(std::span<const Mover> movers);
// The same as warnings of the report, at most ten and how many more, and closed doors as notes.
void findObstacles(const CarriedMotion& carried, const RayScene& scene, const Georeference& georeference,
                   const std::string& name, std::span<const std::string> opened, Report& report);

// How a trajectory is found by what is seen from it.
struct MotionSolving {
  const ErrorProfile* profile = nullptr;  // null: it is known exactly
  bool closures = true;                   // places that it comes back to are recognised
  bool anchors = false;                   // scanned stations of the job hold it …
  double anchor_reach_m = 3;              // … that it passes within this
  std::vector<ControlPoint> control;      // local frame: those that it stops at hold it
  std::uint64_t seed = 1;
  double max_range_m = 0;  // that the scanner sees
};
struct SolvedMotion {
  PoseFunctionPtr pose;  // null where it is known exactly
  std::size_t closures = 0, anchors = 0;
  std::vector<std::string> control, missed;  // control points that hold it, and those that it does not stop at
  double rms_m = 0, largest_m = 0;           // of the position's error, at the knots
};
// What holds it and how it errs: a note, and a warning of control points that do not hold it.
void reportSolved(const SolvedMotion& solved, const std::string& name, Report& report);
// Where it comes back to what it has seen before: no wall stands between the two places.
Result<std::vector<LoopClosure>> closuresOf(const CarriedMotion& carried, const RayScene& scene, double max_range_m);
// The error of a carried scanner's trajectory (core/motion/trajectory_error.h), with the degeneracy that the scene
// gives along it: rays from each knot find what surfaces face it. A control point is measured where the scanner stands
// still for a quarter of a second within 0.5 m of it in plan and up to 3 m above it; it holds the position there with
// its own sigma and 3 mm of whoever centres on it.
Result<SolvedMotion> solveMotion(const CarriedMotion& carried, const RayScene& scene, std::span<const Station> stations,
                                 const std::string& name, const MotionSolving& solving, Progress& progress);

// How large the error of that trajectory is over all seeds (core/motion/trajectory_error.h), before anything is walked;
// nothing where it is known exactly.
Result<std::vector<ExpectedError>> expectedMotion(const CarriedMotion& carried, const RayScene& scene,
                                                  std::span<const Station> stations, const MotionSolving& solving,
                                                  Progress& progress);
// The root of the summed variances of the expected position at these times, which ascend.
std::vector<double> expectedAt(std::span<const ExpectedError> expected, std::span<const double> times_s);

}  // namespace standpoint
