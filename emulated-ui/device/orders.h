// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/survey.h"
#include "emulated-ui/device/orientation.h"
#include "emulated-ui/device/walk.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// What a device asks of whoever hosts it, and what comes back. A device has at most one order running.

// Where who scans stands, if in view.
struct OperatorPlace {
  double away_m = 0.9;                // from the instrument's axis
  std::optional<double> azimuth_deg;  // clockwise from the zero of the circle; nothing: the middle of what is scanned
};

// A walk that is processed in the office.
struct WalkOrder {
  WalkedWay way;
  std::vector<std::array<double, 2>> pauses;  // from and to, in seconds since it began: no points are kept
  std::vector<WalkFix> fixes;
  bool closures = true;     // places that it comes back to are recognised
  bool stations = false;    // scanned stations hold it
  bool doors_open = false;  // else they are opened on the way
};

// Read the model for what a carried scanner sees on its way.
struct SceneOrder {};

// Scan from where the tripod stands, or along a walk.
struct ScanOrder {
  std::string instrument;  // id
  std::string project;     // on the device
  int number = 0;          // of the setup within the project
  std::string name;        // of its file, without extension
  std::string folder;      // within the project, for clusters; may be empty
  std::string station;     // where it stands
  SettingValues settings;
  bool panorama = false;  // pictures are taken
  bool compensator = true;
  double until_fraction = 1;         // of the columns: a scan that was cut short and kept
  double noise_factor = 1;           // of the range noise: dust on the optics, an instrument that is not warm
  std::vector<std::string> filters;  // of the verb `clean`: what the device itself leaves out
  std::optional<double> tripod_moved_at_fraction;  // the tripod was pushed then
  std::optional<double> passer_by_at_fraction;     // somebody walks by then
  bool operator_in_view = false;                   // who scans stays beside the scanner
  OperatorPlace operator_place;
  double operator_from_fraction = 0, operator_until_fraction = 1;  // of the columns: while these are measured
  // Of a device that gives its scans coordinates: the station set-up that was in force when it began, without one the
  // scanner's own frame.
  std::optional<StationOrientation> orientation;
  double tilt_x_deg = 0, tilt_y_deg = 0;  // of the standing axis when it began
  std::vector<std::string> sensors;       // ids of the definition's that are on and leave a reading
  SettingValues notes;                    // key and text: what goes into the file's record, such as who measured
  std::optional<WalkOrder> walk;          // of a scanner that is carried
};

// How a setup joins an earlier one: cloud to cloud.
struct LinkOrder {
  std::string from_file, to_file;
  double shift_x_m = 0, shift_y_m = 0;  // how the user laid the first by hand before the fit, from where it lay:
  double turn_deg = 0;                  // in plan, anticlockwise about itself
};
struct LinkResult {
  bool joined = false;
  double error_m = 0;       // r.m.s. of the matched surfaces
  double overlap = 0;       // share of the newer cloud
  double true_error_m = 0;  // of the solved place: what only the simulation knows
  double true_error_deg = 0;
  Pose error;      // the true place moved by it is the solved one
  std::string to;  // file of the setup that it joins
};

// Find the targets in a setup and measure them.
struct TargetOrder {
  std::string file;
};
struct FittedTarget {
  std::string name;
  std::string kind;  // "sphere" or "checkerboard"
  int points = 0;
  double range_m = 0;
  double residual_m = 0;  // r.m.s. of the fit
  double error_m = 0;     // to where it truly is
  bool found = false;
  std::string why_not;                                   // key of a word
  Eigen::Vector3d levelled_m = Eigen::Vector3d::Zero();  // of a sight: its place, levelled by what the compensator told
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();    // as fitted, in the setup's own frame
};

// Fit the target that is seen at a point of a stored setup.
struct PickOrder {
  std::string file;
  Eigen::Vector3d spot_m = Eigen::Vector3d::UnitX();  // what the cross-hair is on, in the setup's frame
  double reach_rad = 0;                               // half a cell of the picture that was aimed in
  std::string kind;                                   // that the device is told: "sphere" or "checkerboard"
  std::string name;                                   // that it gets
};

// Pick one target, scan a window about it finely, and measure it.
struct SightOrder {
  std::string instrument;  // id
  std::string station;
  std::string target;      // which one is picked
  std::string kind;        // that the device is told: "sphere" or "checkerboard"
  SettingValues settings;  // the edges of the window come on top
  bool compensator = true;
};

// A setup's picture as the device shows it, thinned out: a point for each cell, where one came back.
struct ScanPreview {
  std::uint32_t columns = 0, rows = 0;         // row 0 is the lowest
  std::vector<float> x_m, y_m, z_m;            // in the scanner's frame; NaN: nothing came back
  std::vector<std::uint8_t> grey;              // intensity, stretched
  std::vector<std::uint8_t> red, green, blue;  // empty: the scan has no colours
};
struct PreviewOrder {
  std::string file;
};

// Copies the card's files to the office.
struct TransferOrder {
  std::vector<std::string> files;
  std::string by;         // "card", "cable", "wlan"
  std::string extension;  // of the copies: ".las"; empty: as the files are
};

using Order =
    std::variant<ScanOrder, LinkOrder, TargetOrder, PreviewOrder, TransferOrder, SightOrder, PickOrder, SceneOrder>;

struct StoredSetup {
  std::string project;
  int number = 0;
  std::string name;  // "Setup 001", "house_003"
  std::string station;
  SettingValues settings;
  std::string file;
  std::uint64_t points = 0;
  double bytes = 0;
  double instrument_seconds = 0;
  bool partial = false;                     // it was cut short
  bool unlevelled = false;                  // the compensator did not help
  double lean_x_deg = 0, lean_y_deg = 0;    // of the stored cloud: what nothing has levelled
  double stood_x_deg = 0, stood_y_deg = 0;  // how the standing axis leant in truth while it scanned
  bool moved = false;                       // the tripod was pushed meanwhile
  bool tracked = false;                     // the way from the setup before is known
  bool looked_at = false;                   // its preview was opened
  bool transferred = false;                 // a copy is in the office
  std::optional<LinkResult> link;           // to the setup before, or that it was joined with
  std::string joined_with;                  // file of the setup that its user has joined it with; empty: nobody has
  std::vector<FittedTarget> targets;
  double plan_x_m = 0, plan_y_m = 0;           // where it is thought to stand, for the plan
  double plan_turn_rad = 0;                    // of its preview's frame there, counter-clockwise
  std::shared_ptr<const ScanPreview> preview;  // once it was asked for
  SettingValues notes;                         // key and text: readings of the sensors, who measured
  bool operator_in_view = false;               // somebody stood in the scanner's view meanwhile
  std::optional<PlaceError> placed;            // of the pose in the file, of a device that gives its scans coordinates
  std::optional<WalkResult> walk;              // of a scanner that is carried
};

}  // namespace standpoint
