// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/device.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"

// FARO Focus S, M and Premium, which differ by their data sheets: off, booting, idle, spin-up, scanning, pictures,
// saving. Transitions: instrument facts, section 2.1.
namespace standpoint::faro_focus {

namespace {

namespace phase {

const PhaseId idle{"idle"}, spin_up{"spin_up"}, scanning{"scanning"}, paused{"paused"}, photographing{"photographing"},
    saving{"saving"}, error{"error"};

}  // namespace phase

using Event = EngineEvent;

const Phases kWorking = {phase::spin_up, phase::scanning, phase::paused, phase::photographing};
const Phases kHolding = {phase::spin_up,       phase::scanning, phase::paused,
                         phase::photographing, phase::saving,   phase::error};
constexpr double kSpinUp_s = 9;              // [S6]: 8 to 10 s
constexpr double kDisplayColumns = 1.00684;  // the display counts the overlap, too: 10310 of 10240 [S7]

// Of rows the display counts both ends: 150 degrees are 4266.67 steps of 1/4 and 4268 rows [S7].
double displayRows(const ScanSettings& settings) {
  const double step = (settings.azimuth_to_rad - settings.azimuth_from_rad) / std::max(1U, settings.columns);
  return std::round((settings.elevation_to_rad - settings.elevation_from_rad) / step + 1);
}

// Start values of the factory profiles are proposals [P]; the names are general knowledge [G1].
struct Profile {
  const char* name;
  const char* resolution;
  const char* quality;
  bool reduced = false;  // the area is: a quarter of the turn about the object
};
constexpr std::array kProfiles = {Profile{"Indoor ...10 m", "1/8", "3x"},  Profile{"Indoor 10 m...", "1/5", "3x"},
                                  Profile{"Indoor HD", "1/2", "4x"},       Profile{"Outdoor ...20 m", "1/5", "4x"},
                                  Profile{"Outdoor 20 m...", "1/4", "4x"}, Profile{"Object HD", "1/1", "4x", true},
                                  Profile{"Preview", "1/20", "4x"}};
constexpr const char* kOwnProfile = "profile.";  // an own one is a value of the device under this name

SettingValues settingsOf(const Profile& profile) {
  SettingValues settings = {{"resolution", profile.resolution}, {"quality", profile.quality}};
  if (profile.reduced)
    for (const auto& [edge, angle] : {std::pair{"horizontal_from", "315"}, std::pair{"horizontal_to", "45"},
                                      std::pair{"vertical_from", "-45"}, std::pair{"vertical_to", "45"}})
      settings.emplace_back(edge, angle);
  return settings;
}

std::vector<std::string> ownProfiles(const Device& device) {
  std::vector<std::string> names;
  for (const auto& [id, value] : device.state().values)
    if (id.starts_with(kOwnProfile)) names.push_back(id.substr(std::string(kOwnProfile).size()));
  return names;
}

std::vector<WidgetOption> profileRows(const Device& device) {
  std::vector<WidgetOption> rows;
  for (const auto& p : kProfiles)
    rows.push_back({p.name, fmt::format("{}  {} {}", p.name, p.resolution, p.quality), true, {}});
  for (const auto& name : ownProfiles(device)) rows.push_back({name, name, true, {}});
  return rows;
}

Result<void> useProfile(Device& device, const std::string& name) {
  const auto factory =
      std::find_if(kProfiles.begin(), kProfiles.end(), [&](const Profile& p) { return name == p.name; });
  const auto settings =
      factory != kProfiles.end() ? settingsOf(*factory) : settingsFromText(device.value(kOwnProfile + name));
  if (auto ok = device.setSettings(settings); !ok) return ok;
  device.change().entries["profile"] = name;
  device.change().entries["profile_settings"] = settingsText(device.state().settings);
  return {};
}

Result<void> saveProfile(Device& device, const std::string&) {
  const auto name = device.entry("profile_name");
  if (auto ok = checkName(device, name); !ok) return ok;
  if (std::any_of(kProfiles.begin(), kProfiles.end(), [&](const Profile& p) { return name == p.name; }))
    return failure(ErrorKind::usage, device.word("factory_profile"));
  device.change().values[kOwnProfile + name] = settingsText(device.state().settings);
  device.change().entries["profile"] = name;
  device.change().entries["profile_settings"] = settingsText(device.state().settings);
  device.note("profile_saved", name);
  return {};
}

Result<void> deleteProfile(Device& device, const std::string&) {
  const auto& entries = device.state().entries;
  const auto chosen = entries.find("profile");
  if (chosen == entries.end() || device.change().values.erase(kOwnProfile + chosen->second) == 0)
    return failure(ErrorKind::usage, device.word("factory_profile"));
  device.note("profile_deleted", chosen->second);
  device.change().entries.erase("profile");
  return {};
}

std::string profileName(const Device& device) {
  const auto& entries = device.state().entries;
  const auto chosen = entries.find("profile");
  if (chosen == entries.end()) return "";
  const auto settings = entries.find("profile_settings");
  const bool changed = settings == entries.end() || settings->second != settingsText(device.state().settings);
  return chosen->second + (changed ? " *" : "");
}

// The head is turned by hand to where the area shall begin or end.
Result<void> headIs(Device& device, const char* setting) {
  SettingValues wanted = device.state().settings;
  for (auto& [key, value] : wanted)
    if (key == setting) value = device.value("head");
  return device.setSettings(wanted);
}
Result<void> areaFromHead(Device& device, const std::string&) { return headIs(device, "horizontal_from"); }
Result<void> areaToHead(Device& device, const std::string&) { return headIs(device, "horizontal_to"); }

void resumeSweep(Device& device) { device.change().elapsed_s = device.state().laser_s; }

const FactDomain kNumber{{}, true, 0, 1e9};

const DeviceRoles kRoles = {
    .working = kWorking,
    .measuring = {phase::scanning},
    .camera = {phase::spin_up, phase::paused, phase::photographing},
    .holding = kHolding,
    .kept = phase::saving,
    .scans = "view_scans",
    .tools = "service",
    .tilted = "level != good and value.inclinometer == on",
    .first = phase::spin_up,
    .marks = {{"S9", rowsOf("power_key")},
              {"G1",
               rowsOf("power_key/shut_down shut_down elapsed start start_anyway start/card_absent start/card_locked "
                      "start/card_full start/battery_critical start/temperature_question start/tilt_question "
                      "tilted/tilt_warning temperature/temperature_warning battery_low battery_critical transferred "
                      "delete/delete_question delete_confirmed format/format_question format_confirmed adjust")},
              {"G2", rowsOf("stop/stop_question stop_confirmed")}},
};

std::vector<Transition> transitions() {
  return withDefaults(
      {
          {.from = {phase::spin_up}, .event = Event::elapsed, .to = phase::scanning, .source = "S6"},
          {.from = {phase::scanning},
           .event = Event::elapsed,
           .guard = "imaging == yes",
           .to = phase::photographing,
           .source = "G1"},
          {.from = {phase::scanning}, .event = Event::elapsed, .to = phase::saving, .source = "G1"},
          {.from = {phase::photographing}, .event = Event::elapsed, .to = phase::saving, .source = "G1"},
          {.from = {phase::saving},
           .event = Event::elapsed,
           .guard = "data == yes and battery.state == critical and mains == no",
           .to = phase::idle,
           .show = "scan_view",
           .ask = "battery_shut_down",
           .effect = storeScan},
          {.from = {phase::saving},
           .event = Event::elapsed,
           .guard = "data == yes",
           .to = phase::idle,
           .show = "scan_view",
           .effect = storeScan,
           .source = "G1"},
          {.from = {phase::scanning}, .event = "pause", .to = phase::paused, .source = "G2"},
          {.from = {phase::paused}, .event = "resume", .to = phase::scanning, .effect = resumeSweep, .source = "G2"},
          {.from = {phase::scanning, phase::paused},
           .event = "keep_partial",
           .to = phase::saving,
           .effect = keepPartial,
           .source = "G2"},
          {.from = {phase::spin_up}, .event = "keep_partial", .to = phase::idle, .show = "home", .effect = dropScan},
          {.from = {phase::photographing}, .event = "keep_partial", .to = phase::saving},
          {.from = {phase::scanning},
           .event = Event::tripod_moved,
           .to = phase::error,
           .ask = "tripod_moved",
           .effect = markMoved},
          {.from = {phase::spin_up, phase::paused, phase::photographing},
           .event = Event::tripod_moved,
           .ask = "tripod_moved",
           .effect = markMoved},
          {.from = {phase::scanning, phase::photographing},
           .event = Event::battery_critical,
           .to = phase::saving,
           .ask = "battery_critical",
           .effect = keepPartial},
      },
      kRoles);
}

std::vector<FactRow> facts() {
  return {
      {.name = "profile",
       .value = [](const Device& d) { return wordFact(profileName(d)); },
       .about = "selected profile; a star marks unsaved changes"},
      {.name = "expected.saving",
       .unit = FactUnit::seconds,
       .domain = kNumber,
       .value = [](const Device& d) { return numberFact(std::max(3.0, d.type().instrument.overhead_s - kSpinUp_s)); },
       .about = "warm-up columns and saving"},
      {.name = "eye_safety",
       .value = [](const Device&) { return wordFact("7.5 m / 2.8 m"); },
       .about = "axial and radial distance of eye safety [S7]"},
      {.name = "display.columns",
       .domain = kNumber,
       .value = [](const Device& d) { return numberFact(std::round(d.expected().columns * kDisplayColumns)); },
       .about = "columns as counted on the display"},
      {.name = "display.rows",
       .domain = kNumber,
       .value = [](const Device& d) { return numberFact(displayRows(d.expected())); },
       .about = "rows as counted on the display"},
  };
}

}  // namespace

const DeviceProgram& program() {
  static const DeviceProgram all = {
      .transitions = transitions(),
      .actions = {{"use_profile", useProfile},
                  {"save_profile", saveProfile},
                  {"delete_profile", deleteProfile},
                  {"area_from_head", areaFromHead},
                  {"area_to_head", areaToHead}},
      .facts = facts(),
      .lists = {{"profiles", profileRows}},
      .events =
          {
              {.name = "profile_saved", .about = "its name (Focus)"},
              {.name = "profile_deleted", .about = "its name (Focus)"},
          },
  };
  return all;
}

}  // namespace standpoint::faro_focus
