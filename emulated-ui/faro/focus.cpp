// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/faro/focus.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/default_transitions.h"
#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"

namespace standpoint {

namespace {

constexpr const char* kWorking = "spin_up scanning paused photographing";
constexpr const char* kHolding = "spin_up scanning paused photographing saving error";
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
  const auto& entries = device.state().entries;
  const auto typed = entries.find("profile_name");
  const std::string name = typed == entries.end() ? "" : typed->second;
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

void prepare(const Device& device, ScanOrder& order) {
  const auto* project = device.project();
  const std::string base = project == nullptr || project->base.empty() ? "Scan_" : project->base;
  order.name = fmt::format("{}{:03d}", base, order.number);
  order.compensator = order.compensator && device.value("inclinometer") == "on";
}

const FactDomain kNumber{{}, true, 0, 1e9};

const DeviceRoles kRoles = {
    .working = kWorking,
    .measuring = "scanning",
    .camera = "spin_up paused photographing",
    .holding = kHolding,
    .kept = "saving",
    .scans = "view_scans",
    .tools = "service",
    .tilted = "level != good and value.inclinometer == on",
    .first = "spin_up",
    .begin = beginScan,
    .marks = {{"S9", "power_key"},
              {"G1",
               "power_key/shut_down shut_down elapsed start start_anyway start/card_absent start/card_locked "
               "start/card_full start/battery_critical start/temperature_question start/tilt_question "
               "tilted/tilt_warning temperature/temperature_warning battery_low battery_critical transferred "
               "delete/delete_question delete_confirmed format/format_question format_confirmed adjust"},
              {"G2", "stop/stop_question stop_confirmed"}},
};

const DeviceProgram kProgram = {
    "faro/focus.json",
    withDefaults(
        {
            {"spin_up", "elapsed", "", "scanning", "", "", nullptr, "S6"},
            {"scanning", "elapsed", "imaging == yes", "photographing", "", "", nullptr, "G1"},
            {"scanning", "elapsed", "", "saving", "", "", nullptr, "G1"},
            {"photographing", "elapsed", "", "saving", "", "", nullptr, "G1"},
            {"saving", "elapsed", "data == yes and battery.state == critical and mains == no", "idle", "scan_view",
             "battery_shut_down", storeScan, "P"},
            {"saving", "elapsed", "data == yes", "idle", "scan_view", "", storeScan, "G1"},
            {"scanning", "pause", "", "paused", "", "", nullptr, "G2"},
            {"paused", "resume", "", "scanning", "", "", resumeSweep, "G2"},
            {"scanning paused", "keep_partial", "", "saving", "", "", keepPartial, "G2"},
            {"spin_up", "keep_partial", "", "idle", "home", "", dropScan, "P"},
            {"photographing", "keep_partial", "", "saving", "", "", nullptr, "P"},
            {"scanning", "tripod_moved", "", "error", "", "tripod_moved", markMoved, "P"},
            {"spin_up paused photographing", "tripod_moved", "", "", "", "tripod_moved", markMoved, "P"},
            {"scanning photographing", "battery_critical", "", "saving", "", "battery_critical", keepPartial, "P"},
        },
        kRoles),
    {{"use_profile", useProfile},
     {"save_profile", saveProfile},
     {"delete_profile", deleteProfile},
     {"area_from_head", areaFromHead},
     {"area_to_head", areaToHead}},
    {{"profile",
      FactUnit::none,
      {},
      [](const Device& d) { return wordFact(profileName(d)); },
      "selected profile; a star marks unsaved changes"},
     {"expected.saving", FactUnit::seconds, kNumber,
      [](const Device& d) { return numberFact(std::max(3.0, d.type().instrument.overhead_s - kSpinUp_s)); },
      "warm-up columns and saving"},
     {"eye_safety",
      FactUnit::none,
      {},
      [](const Device&) { return wordFact("7.5 m / 2.8 m"); },
      "axial and radial distance of eye safety [S7]"},
     {"display.columns", FactUnit::none, kNumber,
      [](const Device& d) { return numberFact(std::round(d.expected().columns * kDisplayColumns)); },
      "columns as counted on the display"},
     {"display.rows", FactUnit::none, kNumber, [](const Device& d) { return numberFact(displayRows(d.expected())); },
      "rows as counted on the display"}},
    {{"profiles", profileRows}},
    prepare,
};

}  // namespace

const DeviceProgram& focusProgram() { return kProgram; }

}  // namespace standpoint
