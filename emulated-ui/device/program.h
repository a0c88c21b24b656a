// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/device/condition.h"
#include "emulated-ui/device/screen.h"

namespace standpoint {

class Device;

// The name of a phase. Code has a constant for each that it names; loading a device refuses a transition that names one
// which the device's file does not have.
struct PhaseId {
  std::string name;  // empty: none
  bool operator==(const PhaseId&) const = default;
};
using Phases = std::vector<PhaseId>;
inline const PhaseId kAnyPhase{"*"};  // any that has power

// What the clock, the engine, the host and the hands send by themselves.
enum class EngineEvent {
  elapsed,  // the phase's time is over
  data,     // the simulation of the running scan is done
  linked,
  targets_measured,
  transferred,
  failed,
  battery_low,
  battery_critical,
  battery_empty,
  card_inserted,
  card_removed,
  tripod_moved,
  blocked,
  temperature,
  tilted,
  tracking_lost,
  wlan_lost,
  set_down,  // the tripod, at a station
  sighted,
  not_sighted,
  reminder,  // a walk has lasted so long
  rested     // on a walk they have stood still for so long
};
inline constexpr const char* kEngineEventNames[] = {
    "elapsed",       "data",         "linked",           "targets_measured", "transferred",
    "failed",        "battery_low",  "battery_critical", "battery_empty",    "card_inserted",
    "card_removed",  "tripod_moved", "blocked",          "temperature",      "tilted",
    "tracking_lost", "wlan_lost",    "set_down",         "sighted",          "not_sighted",
    "reminder",      "rested"};

// One of these, or the name that a widget or a dialog's button of the device sends: loading a device refuses an event
// that nothing sends or no phase handles.
struct EventId {
  std::string name;
  EventId(EngineEvent event) : name(kEngineEventNames[static_cast<int>(event)]) {}  // NOLINT: so that tables are short
  EventId(std::string sent) : name(std::move(sent)) {}                              // NOLINT
  EventId(const char* sent) : name(sent) {}                                         // NOLINT
  bool operator==(const EventId&) const = default;
  bool isOfEngine() const;
};

using DeviceEffect = void (*)(Device&);

// What a device's phases and widgets do. The first transition of a phase and event whose guard holds is taken.
struct Transition {
  Phases from;
  EventId event;
  std::string guard;  // a condition
  PhaseId to;         // empty: it stays
  std::string show;   // screen; empty: that of the phase, or the same
  std::string ask;    // dialog
  DeviceEffect effect = nullptr;
  std::string source = "P";  // mark of the reference: "S9", "G1", "P" for a choice of this emulator
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
  FactDomain domain = {};
  Fact (*value)(const Device&);
  const char* about;  // for the list of facts in the documentation
};

// Rows of a list widget.
struct ListRow {
  const char* name;
  std::vector<WidgetOption> (*rows)(const Device&);
};

// Something that only this device logs; its word is "never.NAME".
struct OwnEvent {
  const char* name;
  const char* about;  // what its detail is
};

// The half of a device that is code, beside what all devices share; one without any has data only.
struct DeviceProgram {
  std::vector<Transition> transitions;
  std::vector<DeviceAction> actions;
  std::vector<FactRow> facts;
  std::vector<ListRow> lists;
  std::vector<OwnEvent> events;
  // The cloud that is laid on a plan which takes that; nothing when there is none.
  std::optional<LaidCloud> (*laid)(const Device&) = nullptr;
  // What the device's own values change in a scan: its name, filters, notes.
  void (*prepare)(const Device&, struct ScanOrder&) = nullptr;
};

}  // namespace standpoint
