// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/devices/leica-p-series/station_setup.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/devices/leica-p-series/phases.h"

namespace standpoint::leica_p_series {

namespace {

constexpr const char* kSightResolution = "1.6mm";  // of a target's window [P]
constexpr double kPpmPerDegree = 1.0;              // of the range: air of 1 degree more is about 1 ppm thinner
constexpr double kPpmPerHectopascal = -0.3;
constexpr double kPressure_hpa = 1013;  // that it truly has, everywhere

bool compensatorOn(const Device& d) { return d.value("compensator") == "on"; }

// Where the axis is by the chosen mark and the typed height; nothing without a chosen mark.
std::optional<Eigen::Vector3d> axisOver(const Device& d) {
  const auto& marks = d.state().control.stations;
  const auto id = d.entry("station_id");
  const auto found = std::find_if(marks.begin(), marks.end(), [&](const ControlPlace& p) { return p.name == id; });
  if (found == marks.end()) return std::nullopt;
  return found->place_m + Eigen::Vector3d(0, 0, d.number("value.instrument_height"));
}

// What the typed air makes of each range, against the air that there is.
double wrongAir(const Device& d) {
  const double ppm = kPpmPerDegree * (d.number("value.air_temperature") - d.state().around.temperature_c) +
                     kPpmPerHectopascal * (d.number("value.air_pressure") - kPressure_hpa);
  return 1 + ppm * 1e-6;
}

OrientationTask taskOf(const Device& d) {
  OrientationTask task;
  task.method = d.value("method");
  task.station = d.state().around.station;
  task.sighted = d.state().sighted;
  for (auto& s : task.sighted) s.place_m *= wrongAir(d);
  task.known = d.state().control.targets;
  if (task.method == "traverse")
    task.known = d.project() == nullptr ? std::vector<ControlPlace>() : d.project()->carried;
  task.axis_m = axisOver(d);
  task.azimuth_deg = d.number("value.azimuth");
  task.compensator = compensatorOn(d);
  return task;
}

const StationOrientation* inForce(const Device& d) {
  const auto& accepted = d.state().accepted;
  return accepted && !accepted->carried_away ? &*accepted : nullptr;
}

bool solve(Device& d) {
  auto solved = solveOrientation(taskOf(d));
  if (!solved) {
    d.ask("refused", d.word(solved.error().message));
    return false;
  }
  d.change().orientation = *std::move(solved);
  d.note("station_solved", d.value("method"));
  return true;
}
void solveAndShow(Device& d) {
  if (solve(d)) d.show("station_result");
}

void accept(Device& d) { d.acceptOrientation(); }
void solveAndAccept(Device& d) {
  if (solve(d)) d.acceptOrientation();
}
void proposeStation(Device& d) {
  auto& entries = d.change().entries;
  if (d.entry("station_id").empty()) entries["station_id"] = d.state().around.station;
}

Result<void> pickStation(Device& d, const std::string& name) {
  d.change().entries["station_id"] = name;
  d.note("station_id", name);
  return {};
}

Result<void> toggleSighting(Device& d, const std::string& id) {
  for (auto& s : d.change().sighted)
    if (s.id == id) s.used = !s.used;
  d.change().orientation.reset();  // to be solved anew; what was accepted stays in force
  d.note("target_used", id);
  return {};
}

Result<void> forgetSightings(Device& d, const std::string&) {
  d.change().sighted.clear();
  d.change().orientation.reset();
  return {};
}

// Picked in the image: the ID is proposed, and may be typed over.
Result<void> pickTarget(Device& d, const std::string& name) {
  d.change().entries["picked"] = name;
  d.change().entries["target_id"] = name;
  d.change().entries.try_emplace("target_height", "0");
  return {};
}

void sight(Device& d) {
  SightOrder order;
  order.instrument = d.type().instrument.id;
  order.station = d.state().around.station;
  order.target = d.entry("picked");
  order.kind = d.value("target_type") == "sphere" ? "sphere" : "checkerboard";
  order.settings = withSetting(
      withSetting(resolveSettings(d.type().instrument, {})->values, "resolution", kSightResolution), "images", "off");
  order.compensator = compensatorOn(d) && d.tilt() <= d.type().definition.body.tilt_limit_deg;
  d.change().entries.erase("sight");
  d.give(order);
}
// All targets that were not measured from here yet, one after the other.
const ControlPlace* nextTarget(const Device& d) {
  for (const auto& t : d.state().control.targets) {
    const auto& all = d.state().sighted;
    const bool seen = std::any_of(all.begin(), all.end(), [&](const SightedTarget& s) { return s.id == t.name; });
    if (!seen && d.entry("tried").find("/" + t.name + "/") == std::string::npos) return &t;
  }
  return nullptr;
}
void sightNext(Device& d) {
  const auto* next = nextTarget(d);
  if (next == nullptr) return;
  auto& entries = d.change().entries;
  entries["picked"] = entries["target_id"] = next->name;
  entries["target_height"] = std::string(1, '0');
  entries["tried"] += fmt::format("/{}/", next->name);
  entries["series"] = "yes";
  sight(d);
}
void sightSeries(Device& d) {
  d.change().entries.erase("tried");
  sightNext(d);
}
void sightOne(Device& d) {
  d.change().entries["series"] = "no";
  sight(d);
}
void sightCame(Device& d) { d.change().entries["sight"] = "found"; }
void sightMissed(Device& d) { d.change().entries["sight"] = "missed"; }
void dropSight(Device& d) { d.takeBack(); }

double worstResidual(const StationOrientation* o) {
  double worst = 0;
  if (o != nullptr)
    for (const auto& t : o->targets) worst = std::max(worst, t.residual_m);
  return worst * 1000;
}

// What was solved last, else what is in force.
const StationOrientation* here(const Device& d) { return d.state().orientation ? &*d.state().orientation : inForce(d); }

std::string coordinates(const Device& d) {
  const auto* o = here(d);
  if (o == nullptr || o->method.empty()) return "";
  if (o->local) return "0.000  0.000  0.000";
  const Eigen::Vector3d p = (o->pose.translation + d.state().control.shift_m) / (d.showsFeet() ? kMetresPerFoot : 1);
  return fmt::format("{:.3f}  {:.3f}  {:.3f}", p.x(), p.y(), p.z());
}

double lastRange(const Device& d) { return d.state().sighted.empty() ? 0 : d.state().sighted.back().place_m.norm(); }

const FactDomain kYesNo{{"yes", "no"}};
const FactDomain kCount{{}, true, 0, 1000};
const FactDomain kNumber{{}, true, 0, 1e9};

}  // namespace

StationOrientation orientationOfScans(const Device& device) {
  if (const auto* accepted = inForce(device)) return *accepted;
  StationOrientation own;
  own.station = device.state().around.station;
  own.compensator = compensatorOn(device);
  own.local = true;
  return own;
}

void addSetupTransitions(std::vector<Transition>& rows) {
  const std::vector<Transition> own = {
      {.from = {phase::idle},
       .event = "setup_station",
       .guard = "project.open == no",
       .ask = "no_project",
       .source = "G1"},
      {.from = {phase::idle}, .event = "setup_station", .guard = "standing == no", .ask = "no_station"},
      {.from = {phase::idle},
       .event = "setup_station",
       .show = "station_setup",
       .effect = proposeStation,
       .source = "G1"},
      {.from = {phase::idle},
       .event = "solve",
       .guard = "value.method == standard",
       .show = "main_menu",
       .ask = "station_local",
       .effect = solveAndAccept,
       .source = "S17"},
      {.from = {phase::idle},
       .event = "solve",
       .guard = "value.method in {resection_4, traverse, azimuth, backsight, quick} and value.compensator == off",
       .ask = "needs_compensator",
       .source = "S17"},
      {.from = {phase::idle},
       .event = "solve",
       .guard = "value.compensator == on and level == out",
       .ask = "level_first",
       .source = "G1"},
      {.from = {phase::idle},
       .event = "solve",
       .guard = "value.method in {resection_6, auto} and value.compensator == off and targets.usable < 4",
       .ask = "needs_four",
       .source = "S48"},
      {.from = {phase::idle},
       .event = "solve",
       .guard = "value.method in {resection_6, auto} and targets.usable < 3",
       .ask = "needs_three",
       .source = "S17"},
      {.from = {phase::idle},
       .event = "solve",
       .guard = "value.method in {resection_4, traverse} and targets.usable < 2",
       .ask = "needs_two",
       .source = "S17"},
      {.from = {phase::idle},
       .event = "solve",
       .guard = "targets.usable < @targets.needed",
       .ask = "needs_one",
       .source = "S17"},
      {.from = {phase::idle}, .event = "solve", .effect = solveAndShow, .source = "S17"},
      {.from = {phase::idle},
       .event = "accept",
       .show = "main_menu",
       .ask = "station_accepted",
       .effect = accept,
       .source = "S17"},
      {.from = {phase::idle}, .event = "pick", .guard = "standing == no", .ask = "no_station"},
      {.from = {phase::idle},
       .event = "pick",
       .guard = "targets_visible == no",
       .ask = "target_not_found",
       .source = "G1"},
      {.from = {phase::idle},
       .event = "pick",
       .guard = "value.compensator == on and level == out",
       .ask = "level_first",
       .source = "G1"},
      {.from = {phase::idle},
       .event = "pick",
       .guard = "entry.picked == ''",
       .ask = "no_target_picked",
       .source = "G1"},
      {.from = {phase::idle}, .event = "pick", .to = phase::searching_target, .effect = sightOne, .source = "G1"},
      {.from = {phase::idle}, .event = "pick_all", .guard = "targets.left == 0", .ask = "no_target_left"},
      {.from = {phase::idle},
       .event = "pick_all",
       .guard = "targets_visible == no",
       .ask = "target_not_found",
       .source = "G1"},
      {.from = {phase::idle},
       .event = "pick_all",
       .guard = "value.compensator == on and level == out",
       .ask = "level_first",
       .source = "G1"},
      {.from = {phase::idle},
       .event = "pick_all",
       .to = phase::searching_target,
       .effect = sightSeries,
       .source = "G1"},
      {.from = {phase::searching_target},
       .event = Event::elapsed,
       .guard = "entry.series == yes and entry.sight in {found, missed} and targets.left > 0",
       .to = phase::searching_target,
       .effect = sightNext},
      {.from = {phase::searching_target},
       .event = Event::elapsed,
       .guard = "entry.series == yes and entry.sight in {found, missed}",
       .to = phase::idle,
       .show = "targets"},
      {.from = {phase::searching_target},
       .event = Event::elapsed,
       .guard = "entry.sight == found",
       .to = phase::idle,
       .show = "target_result",
       .source = "G1"},
      {.from = {phase::searching_target},
       .event = Event::elapsed,
       .guard = "entry.sight == missed",
       .to = phase::idle,
       .show = "pick_target",
       .ask = "target_not_found",
       .source = "G1"},
      {.from = {phase::searching_target}, .event = Event::sighted, .effect = sightCame, .source = "G1"},
      {.from = {phase::searching_target}, .event = Event::not_sighted, .effect = sightMissed, .source = "G1"},
      {.from = {phase::searching_target}, .event = Event::battery_empty, .to = phase::off, .effect = dropSight},
      {.from = {phase::searching_target}, .event = Event::failed, .to = phase::idle, .show = "pick_target"},
      {.from = {phase::searching_target},
       .event = "cancel_sight",
       .to = phase::idle,
       .show = "pick_target",
       .effect = dropSight},
      {.from = {phase::searching_target},
       .event = Event::tripod_moved,
       .to = phase::idle,
       .show = "pick_target",
       .ask = "tripod_moved",
       .effect = dropSight},
      {.from = {phase::searching_target},
       .event = Event::set_down,
       .to = phase::idle,
       .show = "pick_target",
       .ask = "tripod_moved",
       .effect = dropSight},
  };
  rows.insert(rows.end(), own.begin(), own.end());
}

const std::vector<DeviceAction>& setupActions() {
  static const std::vector<DeviceAction> actions = {{"pick_station", pickStation},
                                                    {"toggle_sighting", toggleSighting},
                                                    {"forget_sightings", forgetSightings},
                                                    {"pick_target", pickTarget}};
  return actions;
}

const std::vector<FactRow>& setupFacts() {
  static const std::vector<FactRow> rows = {
      {.name = "targets.sighted",
       .domain = kCount,
       .value = [](const Device& d) { return numberFact(static_cast<double>(d.state().sighted.size())); },
       .about = "measured from here"},
      {.name = "targets.usable",
       .domain = kCount,
       .value = [](const Device& d) { return numberFact(targetsUsable(taskOf(d))); },
       .about = "targets in use that the method accepts"},
      {.name = "targets.needed",
       .domain = {{}, true, 0, 4},
       .value = [](const Device& d) { return numberFact(targetsNeeded(d.value("method"), compensatorOn(d))); },
       .about = "by the method"},
      {.name = "targets.left",
       .domain = kCount,
       .value = [](const Device& d) { return numberFact(nextTarget(d) == nullptr ? 0 : 1); },
       .about = "1: some were not measured from this station"},
      {.name = "targets_visible",
       .domain = kYesNo,
       .value = [](const Device& d) { return yesNo(d.state().around.targets_visible); },
       .about = "not occluded"},
      {.name = "orientation.method",
       .value = [](const Device& d) { return wordFact(here(d) == nullptr ? "" : here(d)->method); },
       .about = "of the station set-up"},
      {.name = "orientation.accepted",
       .domain = kYesNo,
       .value = [](const Device& d) { return yesNo(inForce(d) != nullptr); },
       .about = "the station has coordinates"},
      {.name = "orientation.solved",
       .domain = kYesNo,
       .value = [](const Device& d) { return yesNo(here(d) != nullptr); },
       .about = "a result is pending or accepted"},
      {.name = "orientation.local",
       .domain = kYesNo,
       .value = [](const Device& d) { return yesNo(here(d) != nullptr && here(d)->local); },
       .about = "the station is the local origin"},
      {.name = "orientation.targets",
       .domain = kCount,
       .value =
           [](const Device& d) {
             return numberFact(here(d) == nullptr ? 0 : static_cast<double>(here(d)->targets.size()));
           },
       .about = "that were used"},
      {.name = "orientation.rms",
       .unit = FactUnit::millimetres,
       .domain = kNumber,
       .value = [](const Device& d) { return numberFact(here(d) == nullptr ? 0 : here(d)->rms_m * 1000); },
       .about = "of the residuals, in millimetres"},
      {.name = "orientation.worst",
       .unit = FactUnit::millimetres,
       .domain = kNumber,
       .value = [](const Device& d) { return numberFact(worstResidual(here(d))); },
       .about = "residual, in millimetres"},
      {.name = "orientation.place",
       .value = [](const Device& d) { return wordFact(coordinates(d)); },
       .about = "of the instrument, in the project's coordinates"},
      {.name = "sight.range",
       .unit = FactUnit::metres,
       .domain = kNumber,
       .value = [](const Device& d) { return numberFact(lastRange(d)); },
       .about = "to the newest target"},
      {.name = "sight.residual",
       .unit = FactUnit::millimetres,
       .domain = kNumber,
       .value =
           [](const Device& d) {
             return numberFact(d.state().sighted.empty() ? 0 : d.state().sighted.back().residual_m * 1000);
           },
       .about = "of its fit"},
      {.name = "sight.points",
       .domain = kNumber,
       .value =
           [](const Device& d) { return numberFact(d.state().sighted.empty() ? 0 : d.state().sighted.back().points); },
       .about = "on it"},
      {.name = "sight.name",
       .value = [](const Device& d) { return wordFact(d.state().sighted.empty() ? "" : d.state().sighted.back().id); },
       .about = "its ID"},
  };
  return rows;
}

const std::vector<ListRow>& setupLists() {
  static const std::vector<ListRow> lists = {
      {"known_stations",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         for (const auto& p : d.state().control.stations)
           rows.push_back({p.name, p.name + (d.entry("station_id") == p.name ? "  •" : ""), true, {}});
         return rows;
       }},
      {"targets_in_view",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         for (const auto& p : d.state().control.targets)
           rows.push_back({p.name, p.name + (d.entry("picked") == p.name ? "  •" : ""), true, {}});
         return rows;
       }},
      {"sightings",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         for (const auto& s : d.state().sighted) {
           std::string row = fmt::format("{} {}  {}  {} pts  {}", s.used ? "•" : "–", s.id,
                                         lengthText(s.place_m.norm(), d.showsFeet()), s.points,
                                         smallLengthText(s.residual_m, d.showsFeet()));
           rows.push_back({s.id, row, true, {}});
         }
         return rows;
       }},
      {"residuals",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         if (const auto* o = here(d))
           for (const auto& t : o->targets)
             rows.push_back({t.id, t.id + "  " + smallLengthText(t.residual_m, d.showsFeet()), true, {}});
         return rows;
       }},
  };
  return lists;
}

}  // namespace standpoint::leica_p_series
