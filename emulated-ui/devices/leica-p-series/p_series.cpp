// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/devices/leica-p-series/phases.h"
#include "emulated-ui/devices/leica-p-series/station_setup.h"

// Leica ScanStation P-series (P30, P40, P50) with its touch screen: station set-up, scan, image, targets, status,
// tools. Transitions: instrument facts, section 2.4.
namespace standpoint::leica_p_series {

namespace {

using Event = EngineEvent;

const Phases kLaserOrCamera = {phase::scanning, phase::imaging};
const Phases kWorking = {phase::scanning, phase::imaging, phase::paused};
const Phases kHolding = {phase::scanning,  phase::imaging, phase::paused,
                         phase::finishing, phase::storing, phase::error};

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
  s.elapsed_s = d.in(phase::imaging) ? done - laser : laser;
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

// Coordinates by the station set-up, and the instrument's own filter of weak points; the range gates are settings of
// the scan.
void prepare(const Device& d, ScanOrder& order) {
  order.orientation = orientationOfScans(d);
  const double weakest = d.number("value.min_intensity");
  if (weakest > 0) order.filters.push_back(fmt::format("intensity:from={:g}", weakest / 100));
}

const DeviceRoles kRoles = {
    .working = kWorking,
    .measuring = kLaserOrCamera,
    .camera = {phase::imaging, phase::paused},
    .holding = kHolding,
    .kept = phase::finishing,
    .home = "",
    .scans = "setups",
    .targets = "setup_targets",
    .tools = "tools",
    .first_questions =
        {
            {.from = {phase::idle}, .event = "start", .guard = "cover == open", .ask = "cover_open", .source = "G1"},
            {.from = {phase::idle},
             .event = "start",
             .guard = "value.compensator == on and level == out",
             .ask = "level_question",
             .source = "G1"},
        },
    .last_questions =
        {
            {.from = {phase::idle},
             .event = "start",
             .guard = "orientation.accepted == no",
             .ask = "no_setup_question"},
            {.from = {phase::idle},
             .event = "start",
             .guard = "setting.images == only",
             .to = phase::imaging,
             .effect = beginScan,
             .source = "G1"},
        },
    .card_needed = std::nullopt,
    .links = false,
    .marks = {{"G1", rowsOf("power_key start start/no_project start/card_full start/battery_critical "
                            "start/temperature_question stop_confirmed battery_low battery_critical "
                            "temperature/temperature_warning format/format_question adjust")}},
};

std::vector<Transition> transitions() {
  std::vector<Transition> rows = {
      {.from = {phase::idle}, .event = "level_now", .show = "level_plummet", .source = "G1"},
      // With pictures only the laser stays off.
      {.from = {phase::idle},
       .event = "start_anyway",
       .guard = "setting.images == only",
       .to = phase::imaging,
       .effect = beginScan},
      {.from = {phase::idle},
       .event = "start_unlevelled",
       .guard = "setting.images == only",
       .to = phase::imaging,
       .effect = beginUnlevelled,
       .source = "G1"},
      {.from = {phase::idle},
       .event = "start_unlevelled",
       .to = phase::scanning,
       .effect = beginUnlevelled,
       .source = "G1"},
      {.from = {phase::scanning},
       .event = Event::elapsed,
       .guard = "imaging == yes",
       .to = phase::imaging,
       .source = "G1"},
      {.from = kLaserOrCamera, .event = Event::elapsed, .guard = "data == yes", .to = phase::storing, .source = "G1"},
      {.from = {phase::storing},
       .event = Event::elapsed,
       .to = phase::idle,
       .show = "setup",
       .effect = storeScan,
       .source = "G1"},
      {.from = {phase::scanning},
       .event = Event::tilted,
       .guard = "value.compensator == on",
       .to = phase::paused,
       .ask = "compensator_question",
       .effect = pausedScanning,
       .source = "S18"},
      {.from = {phase::imaging},
       .event = Event::tilted,
       .guard = "value.compensator == on",
       .to = phase::paused,
       .ask = "compensator_question",
       .effect = pausedImaging,
       .source = "S18"},
      {.from = {phase::paused},
       .event = "continue_unlevelled",
       .guard = "entry.paused_in == imaging",
       .to = phase::imaging,
       .effect = resumeUnlevelled,
       .source = "G1"},
      {.from = {phase::paused},
       .event = "continue_unlevelled",
       .to = phase::scanning,
       .effect = resumeUnlevelled,
       .source = "G1"},
      {.from = {phase::scanning}, .event = "keep_partial", .to = phase::finishing, .effect = keepPartial},
      {.from = {phase::paused},
       .event = "keep_partial",
       .guard = "entry.paused_in == scanning",
       .to = phase::finishing,
       .effect = keepPartial},
      {.from = {phase::imaging, phase::paused}, .event = "keep_partial", .to = phase::finishing},
      {.from = {phase::finishing}, .event = Event::elapsed, .guard = "data == yes", .to = phase::storing},
      {.from = {phase::idle}, .event = "transfer", .guard = "setups.untransferred == 0", .ask = "nothing_to_send"},
      {.from = {phase::idle}, .event = "transfer", .guard = "flagged > 0", .ask = "import_question", .source = "S18"},
      {.from = {phase::idle}, .event = "transfer", .effect = transferAll, .source = "G1"},
      {.from = {phase::idle}, .event = "import_marked", .effect = transferAll, .source = "S18"},
      {.from = {phase::idle}, .event = "leave_out", .effect = transferLevelled, .source = "S18"},
      {.from = {phase::idle},
       .event = "format_confirmed",
       .guard = "card == present",
       .show = "main_menu",
       .effect = formatCard,
       .source = "G1"},
      {.from = {phase::adjusting},
       .event = Event::set_down,
       .to = phase::idle,
       .show = "tools",
       .ask = "adjust_refused"},
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
  all.push_back({.name = "flagged",
                 .domain = {{}, true, 0, 1e6},
                 .value = [](const Device& d) { return numberFact(flagged(d)); },
                 .about = "setups without a copy that contain unlevelled lines"});
  return all;
}

}  // namespace

const DeviceProgram& program() {
  static const DeviceProgram all = {
      .transitions = transitions(),
      .actions = actions(),
      .facts = facts(),
      .lists = setupLists(),
      .events =
          {
              {.name = "unlevelled", .about = "scan started without compensator: the setup's name (P-series)"},
              {.name = "target_used", .about = "target included in or excluded from the set-up: its id (P-series)"},
              {.name = "station_solved", .about = "the method (P-series)"},
              {.name = "station_id", .about = "entered name (P-series)"},
              {.name = "import", .about = "how unlevelled setups were imported (P-series)"},
          },
      .prepare = prepare,
  };
  return all;
}

}  // namespace standpoint::leica_p_series
