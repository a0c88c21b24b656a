// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/device/condition.h"
#include "emulated-ui/device/screen.h"

namespace standpoint {

class Device;

// What a device's phases and widgets do: the half of it that is code. The first transition of a phase and event whose
// guard holds is taken.
struct Transition {
  const char* from;        // phases, separated by blanks; "*": any that has power
  const char* event;       // of a widget, a dialogue's button, a trouble; "elapsed": the phase's time is over
  const char* guard = "";  // a condition
  const char* to = "";     // phase; empty: it stays
  const char* show = "";   // screen; empty: that of the phase, or the same
  const char* ask = "";    // dialogue
  void (*effect)(Device&) = nullptr;
  const char* source = "P";  // mark of the reference: "S9", "G1", "P" for a choice of this emulator
};

// An action behind a widget's "does". What it refuses is shown in a dialogue with the message.
struct DeviceAction {
  const char* name;
  Result<void> (*act)(Device&, const std::string& value);
};

// How a fact is shown to people.
enum class FactUnit { none, fraction, seconds, bytes, points, metres, degrees, celsius, millimetres };

// A fact that screens, guards and exercises may ask for.
struct FactRow {
  const char* name;
  FactUnit unit = FactUnit::none;
  FactDomain domain;
  Fact (*value)(const Device&);
  const char* about;  // for the list of facts in the documentation
};

// Rows of a list widget.
struct ListRow {
  const char* name;
  std::vector<WidgetOption> (*rows)(const Device&);
};

struct DeviceProgram {
  const char* definition;  // "leica/rtc360.json"
  std::vector<Transition> transitions;
  std::vector<DeviceAction> actions;  // beside the shared ones
  std::vector<FactRow> facts;         // beside the shared ones
  std::vector<ListRow> lists;
  // What the device's own values change in a scan: sensors that are off, folders, pictures.
  void (*prepare)(const Device&, struct ScanOrder&) = nullptr;
};

}  // namespace standpoint
