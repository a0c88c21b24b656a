// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/device/condition.h"
#include "emulated-ui/device/screen.h"

namespace standpoint {

// A device as its data file has it: what its screens hold, how long its phases last, what its body and card are. What
// its widgets and phases do stands in code (program.h). The file is emulated-ui/<maker>/<device>.json; a label is a key
// of the words. Each widget carries the mark of the source that says the real device has it.

struct WidgetRow {
  std::string id;
  WidgetKind kind = WidgetKind::readout;
  // What it is bound to; a widget has at most one of setting, value and list.
  std::string setting;         // of the scanner's data sheet: choice or number
  bool possible_only = false;  // choices that the other settings exclude are left out instead of grey
  std::string value;           // of this file
  std::string list;            // rows, of the code
  std::string shows;           // a fact, or a text with {facts} in it
  // What it does when it is pressed, in this order.
  std::string does;     // an action of the code; when that refuses, the rest is left out
  std::string event;    // of the state machine
  std::string go;       // screen to show; "back" = to where one came from
  Condition when;       // it is there only then
  Condition enabled;    // else it is grey, with the word why_not
  Condition warns;      // then it is shown as a warning, with the word why_not
  std::string why_not;  // key of a word
  std::string words;    // key of its label and help; standard: its id
  std::string source;   // mark: "S9", "G1", "P"
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
  std::string screen;  // shown while it lasts; empty: the screen stays
  std::string lasts;   // seconds, or the fact that tells them; empty: it waits
  std::string lamp;    // "green", "red flashing", …
  bool on = true;      // the device has power
  bool laser = false;  // it turns: a bump spoils the scan
  bool waits = false;  // for whoever uses it: its time is no work, only the end of its patience
  std::string source;
};

struct ValueRow {
  std::string id;
  WidgetKind kind = WidgetKind::toggle;  // choice, toggle, text or number
  std::vector<std::string> choices;
  std::string default_value;
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
  double warm_up_s = 0;          // until it is used to another temperature
  double tilt_full_deg = 0;      // up to this the compensator is exact
  double tilt_limit_deg = 0;     // beyond this it does not work
  double display_aspect = 0.62;  // width over height; 0 = no display
  bool tablet = false;           // the display is a tablet's
  std::string sleeps_after;      // value of this file: minutes at rest, "never"; empty: its display does not sleep
  std::string skin;
};

struct DeviceDefinition {
  std::string id;                        // "leica-rtc360"
  std::string title;                     // "Leica RTC360"
  std::vector<std::string> instruments;  // ids of the scanners that it drives; the first is the standard
  std::string about;                     // where its facts come from
  BodyRow body;
  std::vector<PhaseRow> phases;  // the first is where it starts
  std::vector<ValueRow> values;
  std::vector<ScreenRow> screens;
  std::vector<WidgetRow> keys;  // on the body
  std::vector<DialogRow> dialogs;
  std::vector<SensorRow> sensors;
};

Result<DeviceDefinition> readDefinition(const std::filesystem::path& file);

const ScreenRow* findScreen(const DeviceDefinition& definition, const std::string& id);
const PhaseRow* findPhase(const DeviceDefinition& definition, const std::string& id);
const ValueRow* findValue(const DeviceDefinition& definition, const std::string& id);
const DialogRow* findDialog(const DeviceDefinition& definition, const std::string& id);

}  // namespace standpoint
