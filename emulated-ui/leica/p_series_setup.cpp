// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "emulated-ui/device/device.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/leica/p_series.h"

namespace standpoint {

namespace {

constexpr const char* kSightResolution = "1.6mm";  // of a target's window [P]
constexpr double kPpmPerDegree = 1.0;              // of the range: air of 1 degree more is about 1 ppm thinner
constexpr double kPpmPerHectopascal = -0.3;
constexpr double kPressure_hpa = 1013;  // that it truly has, everywhere

std::string entry(const Device& d, const char* id) {
  const auto found = d.state().entries.find(id);
  return found == d.state().entries.end() ? std::string() : found->second;
}

bool compensatorOn(const Device& d) { return d.value("compensator") == "on"; }

// Where the axis is by the chosen mark and the typed height; nothing without a chosen mark.
std::optional<Eigen::Vector3d> axisOver(const Device& d) {
  const auto& marks = d.state().control.stations;
  const auto id = entry(d, "station_id");
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
  if (entry(d, "station_id").empty()) entries["station_id"] = d.state().around.station;
}

Result<void> pickStation(Device& d, const std::string& name) {
  d.change().entries["station_id"] = name;
  d.note("station_id", name);
  return {};
}

Result<void> toggleSighting(Device& d, const std::string& id) {
  for (auto& s : d.change().sighted)
    if (s.id == id) s.used = !s.used;
  d.change().orientation.reset();
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
  order.target = entry(d, "picked");
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
    if (!seen && entry(d, "tried").find("/" + t.name + "/") == std::string::npos) return &t;
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

const StationOrientation* here(const Device& d) { return d.state().orientation ? &*d.state().orientation : nullptr; }

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

void addSetupTransitions(std::vector<Transition>& rows) {
  const std::vector<Transition> own = {
      {"idle", "setup_station", "project.open == no", "", "", "no_project", nullptr, "G1"},
      {"idle", "setup_station", "standing == no", "", "", "no_station", nullptr, "P"},
      {"idle", "setup_station", "", "", "station_setup", "", proposeStation, "G1"},
      {"idle", "solve", "value.method == standard", "", "main_menu", "station_local", solveAndAccept, "S17"},
      {"idle", "solve",
       "value.method in {resection_4, traverse, azimuth, backsight, quick} and value.compensator == off", "", "",
       "needs_compensator", nullptr, "S17"},
      {"idle", "solve", "value.compensator == on and level == out", "", "", "level_first", nullptr, "G1"},
      {"idle", "solve", "value.method in {resection_6, auto} and value.compensator == off and targets.usable < 4", "",
       "", "needs_four", nullptr, "S48"},
      {"idle", "solve", "value.method in {resection_6, auto} and targets.usable < 3", "", "", "needs_three", nullptr,
       "S17"},
      {"idle", "solve", "value.method in {resection_4, traverse} and targets.usable < 2", "", "", "needs_two", nullptr,
       "S17"},
      {"idle", "solve", "targets.usable < @targets.needed", "", "", "needs_one", nullptr, "S17"},
      {"idle", "solve", "", "", "", "", solveAndShow, "S17"},
      {"idle", "accept", "", "", "main_menu", "station_accepted", accept, "S17"},
      {"idle", "pick", "standing == no", "", "", "no_station", nullptr, "P"},
      {"idle", "pick", "targets_visible == no", "", "", "target_not_found", nullptr, "G1"},
      {"idle", "pick", "value.compensator == on and level == out", "", "", "level_first", nullptr, "G1"},
      {"idle", "pick", "entry.picked == ''", "", "", "no_target_picked", nullptr, "G1"},
      {"idle", "pick", "", "searching_target", "", "", sightOne, "G1"},
      {"idle", "pick_all", "targets.left == 0", "", "", "no_target_left", nullptr, "P"},
      {"idle", "pick_all", "targets_visible == no", "", "", "target_not_found", nullptr, "G1"},
      {"idle", "pick_all", "value.compensator == on and level == out", "", "", "level_first", nullptr, "G1"},
      {"idle", "pick_all", "", "searching_target", "", "", sightSeries, "G1"},
      {"searching_target", "elapsed", "entry.series == yes and entry.sight in {found, missed} and targets.left > 0",
       "searching_target", "", "", sightNext, "P"},
      {"searching_target", "elapsed", "entry.series == yes and entry.sight in {found, missed}", "idle", "targets", "",
       nullptr, "P"},
      {"searching_target", "elapsed", "entry.sight == found", "idle", "target_result", "", nullptr, "G1"},
      {"searching_target", "elapsed", "entry.sight == missed", "idle", "pick_target", "target_not_found", nullptr,
       "G1"},
      {"searching_target", "sighted", "", "", "", "", sightCame, "G1"},
      {"searching_target", "not_sighted", "", "", "", "", sightMissed, "G1"},
      {"searching_target", "battery_empty", "", "off", "", "", dropSight, "P"},
      {"searching_target", "failed", "", "idle", "pick_target", "", nullptr, "P"},
      {"searching_target", "cancel_sight", "", "idle", "pick_target", "", dropSight, "P"},
      {"searching_target", "tripod_moved", "", "idle", "pick_target", "tripod_moved", dropSight, "P"},
      {"searching_target", "set_down", "", "idle", "pick_target", "tripod_moved", dropSight, "P"},
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
      {"targets.sighted", FactUnit::none, kCount,
       [](const Device& d) { return numberFact(static_cast<double>(d.state().sighted.size())); }, "measured from here"},
      {"targets.usable", FactUnit::none, kCount, [](const Device& d) { return numberFact(targetsUsable(taskOf(d))); },
       "targets in use that the method accepts"},
      {"targets.needed",
       FactUnit::none,
       {{}, true, 0, 4},
       [](const Device& d) { return numberFact(targetsNeeded(d.value("method"), compensatorOn(d))); },
       "by the method"},
      {"targets.left", FactUnit::none, kCount,
       [](const Device& d) { return numberFact(nextTarget(d) == nullptr ? 0 : 1); },
       "1: some were not measured from this station"},
      {"targets_visible", FactUnit::none, kYesNo,
       [](const Device& d) { return yesNo(d.state().around.targets_visible); }, "not occluded"},
      {"orientation.method",
       FactUnit::none,
       {},
       [](const Device& d) { return wordFact(here(d) == nullptr ? "" : here(d)->method); },
       "of the station set-up"},
      {"orientation.accepted", FactUnit::none, kYesNo,
       [](const Device& d) { return yesNo(here(d) != nullptr && here(d)->accepted); }, "the station has coordinates"},
      {"orientation.solved", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(here(d) != nullptr); },
       "a result is pending or accepted"},
      {"orientation.local", FactUnit::none, kYesNo,
       [](const Device& d) { return yesNo(here(d) != nullptr && here(d)->local); }, "the station is the local origin"},
      {"orientation.targets", FactUnit::none, kCount,
       [](const Device& d) {
         return numberFact(here(d) == nullptr ? 0 : static_cast<double>(here(d)->targets.size()));
       },
       "that were used"},
      {"orientation.rms", FactUnit::millimetres, kNumber,
       [](const Device& d) { return numberFact(here(d) == nullptr ? 0 : here(d)->rms_m * 1000); },
       "of the residuals, in millimetres"},
      {"orientation.worst", FactUnit::millimetres, kNumber,
       [](const Device& d) { return numberFact(worstResidual(here(d))); }, "residual, in millimetres"},
      {"orientation.place",
       FactUnit::none,
       {},
       [](const Device& d) { return wordFact(coordinates(d)); },
       "of the instrument, in the project's coordinates"},
      {"sight.range", FactUnit::metres, kNumber, [](const Device& d) { return numberFact(lastRange(d)); },
       "to the newest target"},
      {"sight.residual", FactUnit::millimetres, kNumber,
       [](const Device& d) {
         return numberFact(d.state().sighted.empty() ? 0 : d.state().sighted.back().residual_m * 1000);
       },
       "of its fit"},
      {"sight.points", FactUnit::none, kNumber,
       [](const Device& d) { return numberFact(d.state().sighted.empty() ? 0 : d.state().sighted.back().points); },
       "on it"},
      {"sight.name",
       FactUnit::none,
       {},
       [](const Device& d) { return wordFact(d.state().sighted.empty() ? "" : d.state().sighted.back().id); },
       "its ID"},
  };
  return rows;
}

const std::vector<ListRow>& setupLists() {
  static const std::vector<ListRow> lists = {
      {"known_stations",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         for (const auto& p : d.state().control.stations)
           rows.push_back({p.name, p.name + (entry(d, "station_id") == p.name ? "  •" : ""), true, {}});
         return rows;
       }},
      {"targets_in_view",
       [](const Device& d) {
         std::vector<WidgetOption> rows;
         for (const auto& p : d.state().control.targets)
           rows.push_back({p.name, p.name + (entry(d, "picked") == p.name ? "  •" : ""), true, {}});
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

}  // namespace standpoint
