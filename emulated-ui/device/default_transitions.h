// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/program.h"

namespace standpoint {

// A device's mark of source for rows that it shares: "event", or "event/dialogue" where a row asks another name.
struct SharedMark {
  std::string source;
  std::vector<std::string> rows;
};

std::vector<std::string> rowsOf(const char* names);  // that are separated by blanks

// What a device calls the phases, screens and conditions of the transitions that all devices share. A row of which a
// part is absent is not there: the device has nothing of that kind.
struct DeviceRoles {
  std::optional<PhaseId> off = PhaseId{"off"};  // absent: it is switched, and its battery ends, in its own way
  PhaseId ready{"idle"};                        // after booting, and when a scan is over
  Phases rest = {{"idle"}};                     // nothing runs
  Phases idle = {{"idle"}};                     // those of them in which it may begin, delete and format
  Phases working;                               // stop may be pressed, and a push spoils the scan
  Phases measuring;                             // a tilt is reported
  Phases laser = {{"scanning"}};
  Phases camera;                // only pictures are taken: setting it down spoils them, too
  Phases holding;               // a scan is not stored yet
  std::optional<PhaseId> kept;  // where a scan goes that is kept after an error
  // Screens.
  std::string home = "home";
  std::optional<std::string> scans;                // the list from which a scan is deleted
  std::optional<std::string> targets = "targets";  // what a search for targets has found
  std::optional<std::string> tools;                // from where it is checked and adjusted; absent: it is not
  // The start: what it refuses, asks, and where it leads.
  std::string start = "start";  // event
  std::string start_anyway = "start_anyway";
  std::vector<Transition> first_questions, last_questions;  // the device's own, before and after those of all
  std::optional<std::string> tilted;                        // condition under which it asks about the tilt
  std::string near = "nearest < @nearest.least";            // and about what stands too near
  PhaseId first{"scanning"};
  DeviceEffect begin = beginScan;
  // What it has.
  std::optional<std::string> card_needed = "";  // condition under which the scan goes with the card; absent: no card
  bool links = true;                            // setups are joined on the device
  std::vector<SharedMark> marks;                // the other rows are a choice of this emulator
};

// A device's own transitions with those behind them that all devices share. Where one of its own takes the same event
// under the same condition, or under none, the shared row is left out.
std::vector<Transition> withDefaults(std::vector<Transition> own, const DeviceRoles& roles);

// How a mark names a row.
std::string rowName(const Transition& row);

}  // namespace standpoint
