// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/riegl/vz_i.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>

#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/riegl/positions.h"

namespace standpoint {

namespace {

constexpr const char* kWorking = "scanning photographing";
constexpr const char* kHolding = "scanning photographing storing error";
constexpr const char* kAfter = "searching processing";
constexpr double kReflectorPoints = 5;      // [P] so many must lie on a reflector for the search to see it
constexpr std::size_t kMostControlPoints = 200;
constexpr std::size_t kFewestSeen = 3;      // tie points that a position needs [S34]
const std::string kControl = "control.";    // + project + name: a value of the device

std::string entry(const Device& device, const char* id) {
  const auto found = device.state().entries.find(id);
  return found == device.state().entries.end() ? std::string() : found->second;
}

// --- registration ---

// What each mode takes for a match, and how long it looks: all of it [P]; the names [S31]. AUTO tries the others.
struct Mode {
  const char* name;
  double most_error_m, least_overlap, seconds;
};
constexpr std::array kModes = {Mode{"AUTO", 0.02, 0.3, 30},          Mode{"OUTDOOR_URBAN", 0.03, 0.25, 20}, Mode{"OUTDOOR_NON_URBAN", 0.1, 0.2, 25},
                               Mode{"INDOOR_SMALL", 0.01, 0.4, 10},  Mode{"INDOOR_LARGE", 0.02, 0.3, 15},   Mode{"MINING_MEDIUM", 0.05, 0.25, 20},
                               Mode{"MINING_LARGE", 0.1, 0.2, 30}};

const Mode& modeOf(const Device& device) {
  const auto name = device.value("registration_mode");
  const auto found = std::find_if(kModes.begin(), kModes.end(), [&](const Mode& m) { return name == m.name; });
  return found == kModes.end() ? kModes.front() : *found;
}

std::string registrationResult(const Device& device) {
  const auto result = entry(device, "registration_result");
  return result.empty() ? "none" : result;
}

void beginRegistration(Device& device) {
  device.change().entries.erase("registration_result");
  orderLink(device);
}

// FAST_REG_FAILED where nothing matches at all, SCAN_REG_FAILED where the match is not good enough for the mode [P].
void judgeRegistration(Device& device) {
  auto* newest = device.newestSetup();
  if (newest == nullptr || !newest->link) return;
  const auto& mode = modeOf(device);
  const bool good = newest->link->joined && newest->link->error_m <= mode.most_error_m && newest->link->overlap >= mode.least_overlap;
  device.change().entries["registration_result"] = good ? "ok" : newest->link->joined ? "scan_failed" : "fast_failed";
  newest->link->joined = good;
  device.note("registration", device.state().entries.at("registration_result"));
}

// --- reflectors ---

double diameter_m(const Device& device) { return device.value("reflector_model") == "flat_100" ? 0.1 : 0.05; }

// N = A / (s r)^2 (instrument facts, section 4.3).
double reach(const Device& device) {
  const auto& e = device.expected();
  const double step = (e.azimuth_to_rad - e.azimuth_from_rad) / std::max(1U, e.columns);
  return std::sqrt(std::numbers::pi / 4 * diameter_m(device) * diameter_m(device) / kReflectorPoints) / step;
}

void filterReflectors(Device& device) {
  auto* setup = device.shownSetup() != nullptr ? device.shownSetup() : device.newestSetup();
  device.change().entries["searched"] = "yes";
  if (setup == nullptr) return;
  const double from = std::strtod(device.value("limit_from").c_str(), nullptr), to = std::strtod(device.value("limit_to").c_str(), nullptr);
  for (auto& target : setup->targets) {
    if (!target.found) continue;
    const bool outside = target.range_m < from || target.range_m > to;
    if (!outside && target.range_m <= reach(device)) continue;
    target.found = false;
    target.why_not = device.word(outside ? "outside_limits" : "too_far_for_model");
  }
}

void searchReflectors(Device& device) {
  device.change().entries.erase("searched");
  if (const auto* newest = device.newestSetup()) device.give(TargetOrder{newest->file});
}

void storeAndSearch(Device& device) {
  storePosition(device);
  searchReflectors(device);
}
void storeAndRegister(Device& device) {
  storePosition(device);
  beginRegistration(device);
}

// --- control points ---

std::string controlOf(const Device& device) { return kControl + (device.project() == nullptr ? "" : device.project()->name) + "/"; }

std::vector<std::string> controlNames(const Device& device) {
  std::vector<std::string> names;
  const auto key = controlOf(device);
  for (const auto& [id, value] : device.state().values)
    if (id.starts_with(key)) names.push_back(id.substr(key.size()));
  return names;
}

// A line of the list: a name and three coordinates, parted by commas or semicolons [S31].
Result<void> addPoint(Device& device, const std::string&) {
  std::string line = entry(device, "control_point");
  std::replace(line.begin(), line.end(), ';', ',');
  std::array<std::string, 4> field;
  std::size_t at = 0, n = 0;
  for (; n < field.size() && at <= line.size(); ++n) {
    const auto end = std::min(line.find(',', at), line.size());
    field[n] = line.substr(at, end - at);
    at = end + 1;
  }
  bool whole = n == field.size() && at > line.size() && !field[0].empty();
  for (std::size_t i = 1; i < field.size() && whole; ++i) {
    char* end = nullptr;
    whole = std::isfinite(std::strtod(field[i].c_str(), &end)) && end != field[i].c_str() && *end == '\0';
  }
  if (!whole) return failure(ErrorKind::usage, device.word("control_point_wrong"));
  if (controlNames(device).size() >= kMostControlPoints) return failure(ErrorKind::usage, device.word("control_points_full"));
  device.change().values[controlOf(device) + field[0]] = field[1] + " " + field[2] + " " + field[3];
  device.change().entries["control_point"].clear();
  device.note("control_point", field[0]);
  return {};
}

Result<void> clearPoints(Device& device, const std::string&) {
  for (const auto& name : controlNames(device)) device.change().values.erase(controlOf(device) + name);
  device.change().values.erase("georeferenced");
  return {};
}

// The project is tied to the list where enough of its points were found as reflectors.
Result<void> georeference(Device& device, const std::string&) {
  std::size_t seen = 0;
  for (const auto& name : controlNames(device)) {
    const auto& setups = device.project()->setups;
    seen += std::any_of(setups.begin(), setups.end(), [&](const StoredSetup& s) {
      return std::any_of(s.targets.begin(), s.targets.end(), [&](const FittedTarget& t) { return t.found && t.name == name; });
    }) ? 1 : 0;
  }
  if (seen < kFewestSeen) return failure(ErrorKind::usage, device.word("too_few_seen"));
  device.change().values["georeferenced"] = device.project()->name;
  device.note("georeferenced", std::to_string(seen));
  return {};
}

std::vector<WidgetOption> controlRows(const Device& device) {
  std::vector<WidgetOption> rows;
  for (const auto& name : controlNames(device)) rows.push_back({name, name + "  " + device.value(controlOf(device) + name), true, {}});
  return rows;
}

bool isGeoreferenced(const Device& device) { return device.project() != nullptr && device.value("georeferenced") == device.project()->name; }

// --- pattern ---

// Lines are counted from the zenith: 30 to 130 degrees are elevations of 60 to -40.
Result<void> proposePattern(Device& device, const std::string&) {
  const auto angle = [&](const char* key) { return std::strtod(device.setting(key).c_str(), nullptr); };
  auto& entries = device.change().entries;
  entries["line_start"] = fmt::format("{:g}", 90 - angle("vertical_to"));
  entries["line_stop"] = fmt::format("{:g}", 90 - angle("vertical_from"));
  entries["line_step"] = device.setting("line_step");
  entries["frame_start"] = device.setting("horizontal_from");
  entries["frame_stop"] = device.setting("horizontal_to");
  entries["frame_step"] = device.setting("frame_step");
  return {};
}

Result<void> takePattern(Device& device, const std::string&) {
  const auto number = [&](const char* id) { return std::strtod(entry(device, id).c_str(), nullptr); };
  const double line_start = number("line_start"), line_stop = number("line_stop"), frame_start = number("frame_start"), frame_stop = number("frame_stop");
  if (!(line_start >= 30 && line_stop <= 130 && line_start < line_stop && frame_start < frame_stop && frame_stop <= 360))
    return failure(ErrorKind::usage, device.word("pattern_wrong"));
  auto wanted = withSetting(device.state().settings, "pattern", "custom");
  wanted = withSetting(wanted, "vertical_from", fmt::format("{:g}", 90 - line_stop));
  wanted = withSetting(wanted, "vertical_to", fmt::format("{:g}", 90 - line_start));
  wanted = withSetting(wanted, "horizontal_from", fmt::format("{:g}", frame_start));
  wanted = withSetting(wanted, "horizontal_to", fmt::format("{:g}", frame_stop));
  wanted = withSetting(wanted, "line_step", entry(device, "line_step"));
  return device.setSettings(withSetting(wanted, "frame_step", entry(device, "frame_step")));
}

// A pattern with a name has the whole field and its own steps.
Result<void> wholeField(Device& device, const std::string&) {
  if (device.setting("pattern") == "custom") return {};
  auto wanted = device.state().settings;
  for (const auto& setting : device.type().instrument.settings)
    if (setting.choices.empty()) wanted = withSetting(wanted, setting.key, setting.standard);
  if (auto ok = device.setSettings(wanted); !ok) return ok;
  return proposePattern(device, {});
}

void prepare(const Device& device, ScanOrder& order) { order.name = nextPositionName(device); }

std::string opstate(const Device& device) {
  const auto& phase = device.state().phase;
  if (phase == "waiting" || phase == "error") return "waiting";
  if (phase == "scanning" || phase == "photographing") return "scanning";
  return phase == "storing" || phase == "searching" || phase == "processing" ? "processing" : "unavailable";
}

const FactDomain kYesNo{{"yes", "no"}, false, 0, 0};
FactDomain upTo(double most) { return {{}, true, 0, most}; }

const std::vector<FactRow> kFacts = {
    {"opstate", FactUnit::none, {{"unavailable", "waiting", "scanning", "processing"}, false, 0, 0}, [](const Device& d) { return wordFact(opstate(d)); }, "the four states of the maker's interface [S31]"},
    {"setup.next", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(nextPosition(d)); }, "number of the next scan position"},
    {"position.name", FactUnit::none, {}, [](const Device& d) { return wordFact(nextPositionName(d)); }, "of the next scan"},
    {"position.taken", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(positionTaken(d)); }, "the next number has a scan already"},
    {"positions.double", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(doublePositions(d)); }, "scans that share their number with another"},
    {"card", FactUnit::none, {{"present", "absent", "locked"}, false, 0, 0}, [](const Device& d) { return wordFact(cardState(d)); }, "the chosen storage medium"},
    {"card.free", FactUnit::bytes, upTo(1e16), [](const Device& d) { return numberFact(cardFree(d)); }, "on the chosen storage medium"},
    {"card.scans_left", FactUnit::none, upTo(1e9), [](const Device& d) { return numberFact(std::floor(cardFree(d) / std::max(1.0, d.expectedBytes()))); }, "scans of these settings that still fit there"},
    {"registration.seconds", FactUnit::seconds, upTo(1e4), [](const Device& d) { return numberFact(modeOf(d).seconds); }, "that the mode looks for a match"},
    {"registration.result", FactUnit::none, {{"none", "ok", "fast_failed", "scan_failed"}, false, 0, 0}, [](const Device& d) { return wordFact(registrationResult(d)); }, "of the newest registration"},
    {"reflector.reach", FactUnit::metres, upTo(1e6), [](const Device& d) { return numberFact(reach(d)); }, "distance to which five points lie on the chosen reflector"},
    {"searched", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(entry(d, "searched") == "yes"); }, "the search for reflectors is done"},
    {"control_points", FactUnit::none, upTo(1e6), [](const Device& d) { return numberFact(static_cast<double>(controlNames(d).size())); }, "in the project's list"},
    {"georeferenced", FactUnit::none, kYesNo, [](const Device& d) { return yesNo(isGeoreferenced(d)); }, "the project is tied to its control points"},
};

const DeviceProgram kProgram = {
    "riegl/vz_i.json",
    {
        {"unavailable", "power_key", "battery.state != critical or mains == yes", "booting", "", "", nullptr, "S31"},
        {"booting", "elapsed", "", "waiting", "", "", nullptr, "P"},
        {"waiting", "power_key", "", "", "", "shut_down", nullptr, "P"},
        {"waiting", "shut_down", "", "shutting_down", "", "", nullptr, "P"},
        {"shutting_down", "elapsed", "", "unavailable", "", "", nullptr, "P"},
        // What the scan refuses, then what it asks.
        {"waiting", "scan", "project.open == no", "", "", "no_project", nullptr, "S31"},
        {"waiting", "scan", "standing == no", "", "", "no_station", nullptr, "P"},
        {"waiting", "scan", "card == absent", "", "", "card_absent", nullptr, "P"},
        {"waiting", "scan", "card == locked", "", "", "card_locked", nullptr, "P"},
        {"waiting", "scan", "card.free < @expected.bytes", "", "", "card_full", nullptr, "P"},
        {"waiting", "scan", "battery.state == critical and mains == no", "", "", "battery_critical", nullptr, "P"},
        {"waiting", "scan", "position.taken == yes", "", "", "position_question", nullptr, "S32"},
        {"waiting", "scan", "temperature.state != good", "", "", "temperature_question", nullptr, "P"},
        {"waiting", "scan", "warm == no", "", "", "not_warm_question", nullptr, "P"},
        {"waiting", "scan", "level == out", "", "", "tilt_question", nullptr, "P"},
        {"waiting", "scan", "nearest < 1.5", "", "", "near_question", nullptr, "P"},
        {"waiting", "scan", "", "scanning", "", "", beginScan, "S31"},
        {"waiting", "scan_anyway", "", "scanning", "", "", beginScan, "P"},
        {"scanning", "elapsed", "imaging == yes and setting.image_mode == after_scan", "photographing", "", "", nullptr, "S31"},
        {kWorking, "elapsed", "", "storing", "", "", nullptr, "S31"},
        {"storing", "elapsed", "data == yes and value.reflector_search == on", "searching", "", "", storeAndSearch, "S31"},
        {"storing", "elapsed", "data == yes and value.registration == on and setups > 0", "processing", "", "", storeAndRegister, "S31"},
        {"storing", "elapsed", "data == yes", "waiting", "position_view", "", storePosition, "S31"},
        {"searching", "targets_measured", "", "", "", "", filterReflectors, "S31"},
        {"searching", "elapsed", "searched == yes and value.registration == on and setups > 1", "processing", "", "", beginRegistration, "S31"},
        {"searching", "elapsed", "searched == yes", "waiting", "reflectors", "", nullptr, "S31"},
        {"processing waiting unavailable", "linked", "", "", "", "", judgeRegistration, "S31"},
        {"processing", "elapsed", "registration.result == ok", "waiting", "position_view", "", nullptr, "S31"},
        {"processing", "elapsed", "registration.result == fast_failed", "waiting", "registration", "fast_reg_failed", nullptr, "S31"},
        {"processing", "elapsed", "registration.result == scan_failed", "waiting", "registration", "scan_reg_failed", nullptr, "S31"},
        {"waiting", "register", "", "processing", "", "", beginRegistration, "S31"},
        {kAfter, "failed", "", "waiting", "positions", "", nullptr, "P"},
        // Troubles.
        {kWorking, "stop", "", "", "", "stop_question", nullptr, "P"},
        {kHolding, "stop_confirmed", "", "waiting", "home", "", dropScan, "P"},
        {kWorking, "moved", "", "error", "", "moved", markMoved, "P"},
        {"photographing", "set_down", "", "error", "", "moved", markMoved, "P"},
        {"scanning", "blocked", "", "error", "", "blocked", nullptr, "P"},
        {"error", "keep", "", "storing", "", "", nullptr, "P"},
        {kHolding, "card_removed", "value.storage != ssd", "waiting", "home", "card_lost", dropScan, "P"},
        {kHolding, "failed", "", "waiting", "home", "", nullptr, "P"},
        {kWorking, "tilted", "", "", "", "tilt_warning", nullptr, "P"},
        {"*", "temperature", "", "", "", "temperature_warning", nullptr, "P"},
        {"*", "battery_low", "", "", "", "battery_low", nullptr, "P"},
        {"*", "battery_critical", "", "", "", "battery_critical", nullptr, "P"},
        {"*", "battery_empty", "", "unavailable", "", "", dropScan, "P"},
        {"waiting", "targets_measured", "", "", "reflectors", "", filterReflectors, "S31"},
        {"waiting", "transferred", "", "", "", "transferred", nullptr, "S35"},
        {"waiting", "delete", "", "", "", "delete_question", nullptr, "P"},
        {"waiting", "delete_confirmed", "", "", "positions", "", deletePosition, "P"},
        {"waiting", "format", "", "", "", "format_question", nullptr, "P"},
        {"waiting", "format_confirmed", "card == present", "", "home", "", formatMedium, "P"},
        {"waiting", "format_confirmed", "card == absent", "", "", "card_absent", nullptr, "P"},
        {"waiting", "format_confirmed", "", "", "", "card_locked", nullptr, "P"},
    },
    {{"load_or_create", loadOrCreate}, {"open_position_project", openPositionProject}, {"propose_position", proposePosition}, {"set_base", setBase},
     {"number_from_here", numberFromHere}, {"propose_pattern", proposePattern}, {"take_pattern", takePattern}, {"whole_field", wholeField},
     {"add_point", addPoint}, {"clear_points", clearPoints}, {"georeference", georeference}},
    kFacts,
    {{"control_points", controlRows}},
    prepare,
};

}  // namespace

const DeviceProgram& vzIProgram() { return kProgram; }

}  // namespace standpoint
