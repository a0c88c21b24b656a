// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "emulated-ui/device/program.h"

namespace standpoint {

class Device;

// A device's mark of source for rows that it shares: "event", or "event/dialogue" where a row asks another name.
struct SharedMark {
  const char* source;
  const char* rows;  // separated by blanks
};

// What a device calls the phases, screens and conditions of the transitions that all devices share. A row of which a
// part is null is not there: the device has nothing of that kind.
struct DeviceRoles {
  // Phases; several are separated by blanks.
  const char* off = "off";          // null: it is switched, and its battery ends, in its own way
  const char* ready = "idle";       // after booting, and when a scan is over
  const char* rest = "idle";        // nothing runs
  const char* idle = "idle";        // those of them in which it may begin, delete and format
  const char* working = nullptr;    // stop may be pressed, and a push spoils the scan
  const char* measuring = nullptr;  // a tilt is told
  const char* laser = "scanning";
  const char* camera = nullptr;   // only pictures are taken: setting it down spoils them, too
  const char* holding = nullptr;  // a scan is not stored yet
  const char* kept = nullptr;     // where a scan goes that is kept after an error
  // Screens.
  const char* home = "home";
  const char* scans = nullptr;      // the list from which a scan is deleted
  const char* targets = "targets";  // what a search for targets has found
  const char* tools = nullptr;      // from where it is checked and adjusted; null: it is not
  // The start: what it refuses, asks, and where it leads.
  const char* start = "start";  // event
  const char* start_anyway = "start_anyway";
  std::vector<Transition> first_questions, last_questions;  // the device's own, before and after those of all
  const char* tilted = nullptr;                             // condition under which it asks about the tilt
  const char* near = "nearest < @nearest.least";            // and about what stands too near
  const char* first = "scanning";                           // phase
  void (*begin)(Device&) = nullptr;
  // What it has.
  const char* card_needed = "";   // condition under which the scan goes with the card; null: it has no card
  bool links = true;              // setups are joined on the device
  std::vector<SharedMark> marks;  // the other rows are a choice of this emulator
};

// A device's own transitions with those behind them that all devices share. Where one of its own takes the same event
// under the same condition, or under none, the shared row is left out.
std::vector<Transition> withDefaults(std::vector<Transition> own, const DeviceRoles& roles);

// How a mark names a row.
std::string rowName(const Transition& row);

}  // namespace standpoint
