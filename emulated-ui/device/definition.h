// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/device/condition.h"
#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/screen.h"
#include "emulated-ui/device/sounds.h"

namespace standpoint {

// A device as its data file has it: what its screens hold, how long its phases last, what its body and card are, how it
// looks, and where its phases lead as far as that needs no code of its own (program.h). The file is
// emulated-ui/devices/<id>/device.json; a label is a key of the words beside it. Each widget carries the mark of the
// source that says the real device has it.

// What something that is done to a widget does, in this order.
struct WidgetEffect {
  std::string does;   // an action of the code; when that refuses, the rest is left out
  std::string event;  // of the state machine
  std::string go;     // screen to show; "back" = to where one came from

  bool empty() const { return does.empty() && event.empty() && go.empty(); }
};

struct GestureEffect : WidgetEffect {
  std::string words;  // key of a word that says so, for the widget's help
};

struct WidgetRow : WidgetEffect {  // of a press
  std::string id;
  WidgetKind kind = WidgetKind::readout;
  // What it is bound to; a widget has at most one of setting, value and list.
  std::string setting;         // of the scanner's data sheet: choice or number
  bool possible_only = false;  // choices that the other settings exclude are left out instead of grey
  std::string value;           // of this file
  std::string list;            // rows, of the code
  std::string shows;           // a fact, or a text with {facts} in it
  std::map<Gesture, GestureEffect> gestures;
  Condition when;                        // it is there only then
  Condition enabled;                     // else it is grey, with the word why_not
  Condition warns;                       // then it is shown as a warning, with the word why_not
  std::string why_not;                   // key of a word
  double minimum = 0, maximum = 999999;  // of a number that is typed and bound to nothing
  std::string words;                     // key of its label and help; standard: its id
  std::string source;                    // mark: "S9", "G1", "P"
};

struct ScreenRow {
  std::string id;
  bool entry = false;  // code or a phase shows it; it need not be reached by a widget
  std::vector<WidgetRow> widgets;
};

struct DialogButton {
  std::string id;     // key of a word
  std::string event;  // empty: it only closes the dialogue
};
struct DialogRow {
  std::string id;  // key of its text, which may hold {facts}
  std::vector<DialogButton> buttons;
};

// A state of the state machine that takes a time of its own, or waits.
struct PhaseRow {
  std::string id;
  std::string screen;             // shown while it lasts; empty: the screen stays
  std::optional<double> lasts_s;  // neither this nor the fact: it waits
  std::string lasts_fact;         // in seconds
  std::string lamp;               // "green", "red flashing", …
  bool on = true;                 // the device has power
  bool laser = false;             // it turns: a bump spoils the scan
  bool waits = false;             // for whoever uses it: its time is no work, only the end of its patience
  std::string source;

  bool ends() const { return lasts_s.has_value() || !lasts_fact.empty(); }  // by itself
};

struct ValueRow {
  std::string id;
  WidgetKind kind = WidgetKind::toggle;  // choice, toggle, text or number
  std::vector<std::string> choices;
  std::string default_value;  // as it is shown
  double minimum = 0, maximum = 0;
  std::string unit;
  std::string source;
  bool kept = true;  // over the day: false for what is true of the moment, such as a connection
};

// A sensor whose reading stands in the record of each scan.
struct SensorRow {
  std::string id;     // "compass", "altimeter", "gps"
  std::string value;  // of this file that switches it; empty: it is always on
  double sigma = 0;   // 1 σ in degrees or metres, as it is stated with the reading
  std::string source;
};

// What the body can bear and hold.
struct BodyRow {
  double battery_s = 0;                                   // a full one lasts so long
  double battery_warning = 0.1, battery_critical = 0.03;  // shares
  bool card_inside = false;                               // it cannot be taken out
  double card_bytes = 0;
  double bytes_per_point = 0;
  double coldest_c = 0, hottest_c = 0;
  double warm_up_s = 0;       // until it is used to another temperature
  double tilt_full_deg = 0;   // up to this the compensator is exact
  double tilt_limit_deg = 0;  // beyond this it does not work
  // A value of this file, and after how many minutes at rest its display goes dark at each choice; a choice that is not
  // named: never.
  std::string sleeps_by;
  std::map<std::string, double> sleeps_after_min;
};

// What a scanner that is carried tells by itself while it records.
struct WalkRow {
  std::vector<double> reminders_min;  // of the walk: the event "reminder" comes then
  double rest_s = 0;                  // after standing still for so long the event "rested" comes; 0: never
};

// How it looks: our own colours, 0xRRGGBB, and proportions. What a file leaves out is plain.
struct SkinRow {
  std::uint32_t body = 0x3A3A3A, body_edge = 0x545454, display = 0xF5F5F5, title_bar = 0x34495E, title_text = 0xFFFFFF,
                tile = 0xFFFFFF, tile_hover = 0xE2E8F0, tile_text = 0x242424, accent = 0x3478BE, accent_text = 0xFFFFFF,
                key = 0x3478BE, text = 0x242424, dim = 0x6A6A6A, line = 0xD0D5DB;
  std::uint32_t key_text = 0xFFFFFF, warning = 0xB22214, off = 0x8C8C8C;  // on the key; of what is wrong; a switch's
  double rounding = 0.3;                                                  // of tiles, in units
};

// What a scan of it is called and when it is levelled.
struct ScanRow {
  std::string name = "Setup ";  // before its number
  bool project_base = false;    // the project's base of names, where it has one, takes the place of that
  Condition levelled;           // empty: within the limits of its body
};

struct DeviceDefinition {
  std::string id;                        // "leica-rtc360"
  std::string title;                     // "Leica RTC360"
  std::vector<std::string> instruments;  // ids of the scanners that it drives; the first is the standard
  std::string about;                     // where its facts come from
  BodyRow body;
  WalkRow walk;
  SkinRow skin;
  ScanRow scan;
  std::vector<PhaseRow> phases;  // the first is where it starts
  std::vector<ValueRow> values;
  std::vector<ScreenRow> screens;
  std::vector<WidgetRow> keys;  // on the body
  std::vector<DialogRow> dialogs;
  std::vector<SensorRow> sensors;
  SoundsRow sounds;
  // Transitions that need no code of the device's own; with roles, those that all devices share stand behind them.
  std::vector<Transition> transitions;
  std::optional<DeviceRoles> roles;
};

// An error names the file, as <folder>/<file>, and the place as a JSON pointer.
Result<DeviceDefinition> readDefinition(const std::filesystem::path& file);

// Events that its widgets, keys and buttons send.
std::set<std::string> eventsSent(const DeviceDefinition& definition);

const ScreenRow* findScreen(const DeviceDefinition& definition, const std::string& id);
const PhaseRow* findPhase(const DeviceDefinition& definition, const std::string& id);
const ValueRow* findValue(const DeviceDefinition& definition, const std::string& id);
const DialogRow* findDialog(const DeviceDefinition& definition, const std::string& id);

}  // namespace standpoint
