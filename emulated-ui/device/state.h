// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/device/orders.h"
#include "emulated-ui/device/orientation.h"
#include "emulated-ui/device/walk.h"

namespace standpoint {

// Where the instrument stands and what is done to it: by hands, weather and troubles, not by its keys.
struct Surroundings {
  std::string station;     // where the tripod stands; empty: nowhere
  double nearest_m = 100;  // surface to the instrument
  double tilt_x_deg = 0, tilt_y_deg = 0;
  double temperature_c = 20;
  double acclimatised_s = 1e9;  // since it came to this temperature
  bool dust = false;            // on the optics
  bool mains = false;
  double battery = 1;  // share
  bool card_present = true, card_locked = false;
  double card_bytes = 0;  // capacity
  double card_used_bytes = 0;
  bool tracking = true;  // the way between setups is followed
  bool wlan = true;
  bool targets_visible = true;
  bool passer_by = false;           // will cross the next scan
  bool operator_in_view = false;    // who scans does not step behind the scanner
  OperatorPlace operator_place;     // then
  bool registration_fails = false;  // the next link finds nothing in common
  bool cover_open = false;          // of the compartment for battery and memory
};

struct DeviceProject {
  std::string name;
  std::string base;     // of the scans' names
  std::string note;     // customer, description
  int first = 1;        // number of its first setup
  std::string cluster;  // folder for the next scans
  std::vector<StoredSetup> setups;
  std::vector<ControlPlace> carried;  // targets as accepted station set-ups gave them: what a traverse goes on from
  std::string photo;                  // "", or where its picture is from: "take", "existing"
};

// Something that happened, for exercises and the replay: pressed, refused, stored, …
struct DeviceEvent {
  double at_s = 0;   // the device's clock
  std::string what;  // "pressed", "setting", "scan_started", "scan_stored", "trouble", …
  std::string detail;
};

// All that a device knows; a plain value.
struct DeviceState {
  std::string phase;
  double elapsed_s = 0;  // in it
  double clock_s = 0;    // since it was made
  std::string screen;
  std::vector<std::string> came_from;
  std::string dialog;         // id; empty: none
  std::string dialog_detail;  // what its text says as {detail}
  std::string language = "en";
  SettingValues settings;  // complete, in the instrument's words
  std::map<std::string, std::string> values;
  std::map<std::string, std::string> entries;  // fields that are typed but not yet taken: a new project's name
  Surroundings around;
  WalkState walk;  // of a scanner that is carried
  std::vector<DeviceProject> projects;
  int project = -1;  // the open one
  int shown = -1;    // setup on view
  std::optional<ScanOrder> running;
  double scanned_s = 0, laser_s = 0;              // of the running scan: in all its phases, and with the laser on
  double engine_fraction = 0;                     // of the simulation behind it
  std::string linking, linking_to;                // files of the setups whose link was ordered last
  std::optional<StoredSetup> data;                // the simulation is done before the device's clock is
  bool moved = false;                             // since the scan began
  ControlList control;                            // known places, copied to the device
  std::vector<SightedTarget> sighted;             // from where the tripod stands
  std::optional<StationOrientation> orientation;  // that was solved last, of where it stands
  std::optional<StationOrientation> accepted;     // in force, until the tripod is carried away
  std::vector<DeviceEvent> log;
  double untouched_s = 0;   // at rest, since somebody pressed something or the device had something to say
  std::string moved_along;  // what the last press moved besides what was pressed, in words; else empty
  std::uint64_t noted = 0;  // events so far, with those that the log had no room for
};

}  // namespace standpoint
