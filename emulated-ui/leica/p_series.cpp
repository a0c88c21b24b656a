// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/leica/p_series.h"

#include <algorithm>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/effects.h"

namespace standpoint {

namespace {

constexpr const char* kLaserOrCamera = "scanning imaging";
constexpr const char* kWorking = "scanning imaging paused";
constexpr const char* kHolding = "scanning imaging paused finishing storing error";

// Which field of view: all around has no edges of its own.
Result<void> applyFieldOfView(Device& d, const std::string& fov) {
  if (fov != "full") return {};
  SettingValues wanted;
  for (const auto& [key, value] : d.state().settings)
    if (!key.starts_with("horizontal_") && !key.starts_with("vertical_")) wanted.emplace_back(key, value);
  return d.setSettings(wanted);
}

void beginUnlevelled(Device& d) {
  d.change().values["compensator"] = "off";
  beginScan(d);
}

// What was measured before the tilt is stored with the rest: the whole scan carries the flag.
void resumeUnlevelled(Device& d) {
  auto& s = d.change();
  if (!s.running) return;
  const double laser = s.laser_s, done = s.scanned_s;
  ScanOrder order = *s.running;
  order.compensator = false;
  d.takeBack();
  s.running = order;
  s.elapsed_s = s.phase == "imaging" ? done - laser : laser;
  d.give(order);
  d.note("unlevelled", order.name);
}
void pausedScanning(Device& d) { d.change().entries["paused_in"] = "scanning"; }
void pausedImaging(Device& d) { d.change().entries["paused_in"] = "imaging"; }

double flagged(const Device& d) {
  double n = 0;
  for (const auto& p : d.state().projects)
    n += static_cast<double>(std::count_if(p.setups.begin(), p.setups.end(),
                                           [](const StoredSetup& s) { return s.unlevelled && !s.transferred; }));
  return n;
}

void transfer(Device& d, bool with_flagged) {
  TransferOrder order{{}, "cable"};
  for (const auto& p : d.state().projects)
    for (const auto& s : p.setups)
      if (!s.transferred && (with_flagged || !s.unlevelled)) order.files.push_back(s.file);
  if (order.files.empty()) return d.ask("refused", d.word("nothing_to_transfer"));
  d.note("import", with_flagged ? "marked" : "without_unlevelled");
  d.give(std::move(order));
}
void transferAll(Device& d) { transfer(d, true); }
void transferLevelled(Device& d) { transfer(d, false); }

// The instrument's own filter of weak points, and its compensator; the range gates are settings of the scan.
void prepare(const Device& d, ScanOrder& order) {
  order.compensator = order.compensator && d.value("compensator") == "on";
  const double weakest = d.number("value.min_intensity");
  if (weakest > 0) order.filters.push_back(fmt::format("intensity:from={:g}", weakest / 100));
}

const DeviceRoles kRoles = {
    .working = kWorking,
    .measuring = kLaserOrCamera,
    .camera = "imaging paused",
    .holding = kHolding,
    .kept = "finishing",
    .home = "",
    .scans = "setups",
    .targets = "setup_targets",
    .tools = "tools",
    .first_questions = {{"idle", "start", "cover == open", "", "", "cover_open", nullptr, "G1"},
                        {"idle", "start", "value.compensator == on and level == out", "", "", "level_question", nullptr,
                         "G1"}},
    .last_questions = {{"idle", "start", "orientation.accepted == no", "", "", "no_setup_question", nullptr, "P"},
                       {"idle", "start", "setting.images == only", "imaging", "", "", beginScan, "G1"}},
    .begin = beginScan,
    .card_needed = nullptr,
    .links = false,
    .marks = {{"G1",
               "power_key start start/no_project start/card_full start/battery_critical "
               "start/temperature_question stop_confirmed battery_low battery_critical "
               "temperature/temperature_warning format/format_question adjust"}},
};

std::vector<Transition> transitions() {
  std::vector<Transition> rows = {
      {"idle", "level_now", "", "", "level_plummet", "", nullptr, "G1"},
      // With pictures only the laser stays off.
      {"idle", "start_anyway", "setting.images == only", "imaging", "", "", beginScan, "P"},
      {"idle", "start_unlevelled", "setting.images == only", "imaging", "", "", beginUnlevelled, "G1"},
      {"idle", "start_unlevelled", "", "scanning", "", "", beginUnlevelled, "G1"},
      {"scanning", "elapsed", "imaging == yes", "imaging", "", "", nullptr, "G1"},
      {kLaserOrCamera, "elapsed", "data == yes", "storing", "", "", nullptr, "G1"},
      {"storing", "elapsed", "", "idle", "setup", "", storeScan, "G1"},
      {"scanning", "tilted", "value.compensator == on", "paused", "", "compensator_question", pausedScanning, "S18"},
      {"imaging", "tilted", "value.compensator == on", "paused", "", "compensator_question", pausedImaging, "S18"},
      {"paused", "continue_unlevelled", "entry.paused_in == imaging", "imaging", "", "", resumeUnlevelled, "G1"},
      {"paused", "continue_unlevelled", "", "scanning", "", "", resumeUnlevelled, "G1"},
      {"scanning", "keep_partial", "", "finishing", "", "", keepPartial, "P"},
      {"paused", "keep_partial", "entry.paused_in == scanning", "finishing", "", "", keepPartial, "P"},
      {"imaging paused", "keep_partial", "", "finishing", "", "", nullptr, "P"},
      {"finishing", "elapsed", "data == yes", "storing", "", "", nullptr, "P"},
      {"idle", "transfer", "setups.untransferred == 0", "", "", "nothing_to_send", nullptr, "P"},
      {"idle", "transfer", "flagged > 0", "", "", "import_question", nullptr, "S18"},
      {"idle", "transfer", "", "", "", "", transferAll, "G1"},
      {"idle", "import_marked", "", "", "", "", transferAll, "S18"},
      {"idle", "leave_out", "", "", "", "", transferLevelled, "S18"},
      {"idle", "format_confirmed", "card == present", "", "main_menu", "", formatCard, "G1"},
      {"adjusting", "set_down", "", "idle", "tools", "adjust_refused", nullptr, "P"},
  };
  addSetupTransitions(rows);
  return withDefaults(std::move(rows), kRoles);
}

std::vector<DeviceAction> actions() {
  std::vector<DeviceAction> all = setupActions();
  all.push_back({"apply_fov", applyFieldOfView});
  return all;
}

std::vector<FactRow> facts() {
  std::vector<FactRow> all = setupFacts();
  all.push_back({"flagged",
                 FactUnit::none,
                 {{}, true, 0, 1e6},
                 [](const Device& d) { return numberFact(flagged(d)); },
                 "setups without a copy that contain unlevelled lines"});
  return all;
}

}  // namespace

// Made at its first use: its parts come from two files.
const DeviceProgram& pSeriesProgram() {
  static const DeviceProgram program = {"leica/p_series.json", transitions(), actions(), facts(),
                                        setupLists(),          prepare};
  return program;
}

}  // namespace standpoint
