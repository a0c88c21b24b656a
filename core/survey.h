// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace standpoint {

// A rigid pose in double; world_from_scanner: x right-handed with Z up along the standing axis.
struct Pose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // w >= 0, |q| = 1
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();         // metres, local frame
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return rotation * p + translation; }
  Pose operator*(const Pose& first) const { return {rotation * first.rotation, *this * first.translation}; }
};
Pose inverse(const Pose& pose);

// A pose as a function of time: constant for a tripod (one sample), interpolated between samples for what moves.
struct Trajectory {
  std::vector<double> time_s;  // ascending
  std::vector<Pose> pose;      // same size, at least one
};
Pose at(const Trajectory& trajectory, double time_s);

enum class TargetKind { sphere, checkerboard };

struct Target {
  std::string name;
  TargetKind kind = TargetKind::sphere;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   // local frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // of a checkerboard
  double size_m = 0.145;                              // diameter or side
};

// How what a scan is registered by stood while it was made.
struct AsScanned {
  Pose station;  // its true pose
  std::vector<Target> targets;
};

// What a scan left behind; the points themselves stay in the file.
struct Scan {
  std::string instrument;  // id
  std::string file;        // as the user gave it
  std::string format;      // "e57", "ptx"
  std::vector<std::pair<std::string, std::string>> settings;
  std::uint64_t seed = 0;
  std::uint64_t pulses = 0;
  std::uint64_t points = 0;
  double instrument_seconds = 0;
  std::optional<std::uint64_t> along = {};  // wayFingerprint() of the trajectory that it was made along, as it was then
  std::optional<AsScanned> as_scanned = {};  // nothing in the projects of versions that did not keep it
};

// A place on a floor: "X,Y" or "X,Y,Z" in metres, the frame of the model's file.
struct FloorPlace {
  double x_m = 0, y_m = 0;
  std::optional<double> z_m;
};

struct Station {
  std::string name;
  double instrument_height_m = 0;   // tilting axis above the ground mark
  Pose true_pose;                   // of the instrument's centre: what the simulation knows
  std::optional<Pose> solved_pose;  // what the surveyor would know after registration
  std::vector<Scan> scans;
};

struct ControlPoint {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // local frame
  double sigma_m = 0;
};

// A place that somebody clicked for a path to pass.
struct Waypoint {
  Eigen::Vector3d floor_m = Eigen::Vector3d::Zero();  // on the walkable surface, local frame; stairs by their heights
  double stop_s = 0;                                  // how long whoever passes stands there
  std::optional<double> look_rad =
      {};  // heading from here to the next one, counter-clockwise from x; else it looks ahead
  bool operator==(const Waypoint&) const = default;
};

// A way along which a scanner is carried: through waypoints, or as a file has it.
struct CarriedTrajectory {
  std::string name;
  std::string carrier = "hand";  // id of core/motion/carriers.h
  std::vector<Waypoint> waypoints;
  double height_m = 0, speed_mps = 0;  // of the body above the floor, and at most; 0: the carrier's own
  std::uint64_t seed = 1;              // of gait and shaking
  std::string file, format;            // instead of waypoints: as the user gave it, and the format's id
  std::vector<Scan> scans;
};

inline constexpr double kWayStep_s = 0.2;
// Something that moves while it is scanned, by a clock that all movers share and that starts at 0 s.
enum class MoverKind { person, vehicle, door, turning, sliding };
struct Mover {
  std::string name;
  MoverKind kind = MoverKind::person;
  std::vector<std::string> products;  // of the model, by id: doors whose leaves open, or what turns or slides
  std::vector<Waypoint> waypoints;    // of a person or a vehicle
  // Of somebody who gives way, instead of waypoints: where they are each kWayStep_s, local frame.
  std::vector<Eigen::Vector3d> way_m;
  Eigen::Vector3d axis_at_m = Eigen::Vector3d::Zero();  // what turns does so about it, local frame …
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();      // … and what slides does so along it; unit
  double speed = 0;                                     // m/s, of what turns rad/s; at most. 0: its kind's own
  double extent = 0;     // of what slides m, of what turns and of leaves rad; 0: it goes on for ever
  bool repeats = false;  // back and forth
  double begins_s = 0;   // until then it stands
  std::uint64_t seed = 1;
  bool operator==(const Mover&) const = default;
};

// A surveying job: what the crew sets up and stores.
struct Job {
  std::string name;
  std::vector<Station> stations;
  std::vector<Target> targets;
  std::vector<ControlPoint> control_points;
  std::vector<CarriedTrajectory> trajectories;
  std::vector<Mover> movers;
};

}  // namespace standpoint
