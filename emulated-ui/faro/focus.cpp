// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/faro/focus.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/settings.h"

namespace standpoint {

namespace {

constexpr const char* kWorking = "spin_up scanning paused photographing";
constexpr const char* kHolding = "spin_up scanning paused photographing saving error";
constexpr double kSpinUp_s = 9;             // [S6]: 8 to 10 s
constexpr double kDisplayColumns = 1.00684;   // the display counts the overlap, too: 10310 of 10240 [S7]

// Start values of the factory profiles are proposals [P]; the names are general knowledge [G1].
struct Profile {
  const char* name;
  const char* resolution;
  const char* quality;
};
constexpr std::array kProfiles = {Profile{"Indoor ...10 m", "1/8", "3x"},  Profile{"Indoor 10 m...", "1/5", "3x"},
                                  Profile{"Indoor HD", "1/2", "4x"},       Profile{"Outdoor ...20 m", "1/5", "4x"},
                                  Profile{"Outdoor 20 m...", "1/4", "4x"}, Profile{"Object HD", "1/1", "4x"},
                                  Profile{"Preview", "1/20", "4x"}};
constexpr const char* kOwnProfile = "profile.";   // an own one is a value of the device under this name

SettingValues settingsOf(const Profile& profile) { return {{"resolution", profile.resolution}, {"quality", profile.quality}}; }

std::vector<std::string> ownProfiles(const Device& device) {
  std::vector<std::string> names;
  for (const auto& [id, value] : device.state().values)
    if (id.starts_with(kOwnProfile)) names.push_back(id.substr(std::string(kOwnProfile).size()));
  return names;
}

std::vector<WidgetOption> profileRows(const Device& device) {
  std::vector<WidgetOption> rows;
  for (const auto& p : kProfiles) rows.push_back({p.name, fmt::format("{}  {} {}", p.name, p.resolution, p.quality), true, {}});
  for (const auto& name : ownProfiles(device)) rows.push_back({name, name, true, {}});
  return rows;
}

Result<void> useProfile(Device& device, const std::string& name) {
  const auto factory = std::find_if(kProfiles.begin(), kProfiles.end(), [&](const Profile& p) { return name == p.name; });
  const auto settings = factory != kProfiles.end() ? settingsOf(*factory) : settingsFromText(device.value(kOwnProfile + name));
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

const DeviceProgram kProgram = {
    "faro/focus.json",
    {
        {"off", "power_key", "battery.state != critical or mains == yes", "booting", "", "", nullptr, "S9"},
        {"booting", "elapsed", "", "idle", "", "", nullptr, "S9"},
        {"idle", "power_key", "", "", "", "shut_down", nullptr, "G1"},
        {"idle", "shut_down", "", "shutting_down", "", "", nullptr, "G1"},
        {"shutting_down", "elapsed", "", "off", "", "", nullptr, "G1"},
        {"idle", "start", "project.open == no", "", "", "no_project", nullptr, "P"},
        {"idle", "start", "standing == no", "", "", "no_station", nullptr, "P"},
        {"idle", "start", "card == absent", "", "", "card_absent", nullptr, "G1"},
        {"idle", "start", "card == locked", "", "", "card_locked", nullptr, "G1"},
        {"idle", "start", "card.free < @expected.bytes", "", "", "card_full", nullptr, "G1"},
        {"idle", "start", "battery.state == critical and mains == no", "", "", "battery_critical", nullptr, "G1"},
        {"idle", "start", "temperature.state != good", "", "", "temperature_question", nullptr, "G1"},
        {"idle", "start", "warm == no", "", "", "not_warm_question", nullptr, "P"},
        {"idle", "start", "level != good and value.inclinometer == on", "", "", "tilt_question", nullptr, "G1"},
        {"idle", "start", "nearest < 0.6", "", "", "near_question", nullptr, "P"},
        {"idle", "start", "", "spin_up", "", "", beginScan, "G1"},
        {"idle", "start_anyway", "", "spin_up", "", "", beginScan, "G1"},
        {"spin_up", "elapsed", "", "scanning", "", "", nullptr, "S6"},
        {"scanning", "elapsed", "imaging == yes", "photographing", "", "", nullptr, "G1"},
        {"scanning", "elapsed", "", "saving", "", "", nullptr, "G1"},
        {"photographing", "elapsed", "", "saving", "", "", nullptr, "G1"},
        {"saving", "elapsed", "data == yes", "idle", "scan_view", "", storeScan, "G1"},
        {"scanning", "pause", "", "paused", "", "", nullptr, "G2"},
        {"paused", "resume", "", "scanning", "", "", resumeSweep, "G2"},
        {kWorking, "stop", "", "", "", "stop_question", nullptr, "G2"},
        {kHolding, "stop_confirmed", "", "idle", "home", "", dropScan, "G2"},
        {"scanning paused", "keep_partial", "", "saving", "", "", keepPartial, "G2"},
        {"spin_up", "keep_partial", "", "idle", "home", "", dropScan, "P"},
        {"photographing", "keep_partial", "", "saving", "", "", nullptr, "P"},
        {"scanning", "moved", "", "error", "", "moved", markMoved, "P"},
        {"spin_up paused photographing", "moved", "", "", "", "moved", markMoved, "P"},
        {"scanning", "blocked", "", "error", "", "blocked", nullptr, "P"},
        {"error", "keep", "", "saving", "", "", nullptr, "P"},
        {"scanning photographing", "battery_critical", "", "saving", "", "battery_critical", keepPartial, "P"},
        {"*", "battery_critical", "", "", "", "battery_critical", nullptr, "G1"},
        {"*", "battery_low", "", "", "", "battery_low", nullptr, "G1"},
        {"*", "battery_empty", "", "off", "", "", dropScan, "P"},
        {kHolding, "card_removed", "", "idle", "home", "card_lost", dropScan, "P"},
        {kHolding, "failed", "", "idle", "home", "", nullptr, "P"},
        {"scanning", "tilted", "", "", "", "tilt_warning", nullptr, "G1"},
        {"*", "temperature", "", "", "", "temperature_warning", nullptr, "G1"},
        {"idle", "targets_measured", "", "", "targets", "", nullptr, "P"},
        {"idle", "linked", "link == joined", "", "", "link_joined", nullptr, "P"},
        {"idle", "linked", "", "", "", "link_failed", nullptr, "P"},
        {"idle", "transferred", "", "", "", "transferred", nullptr, "G1"},
        {"idle", "delete", "", "", "", "delete_question", nullptr, "G1"},
        {"idle", "delete_confirmed", "", "", "view_scans", "", deleteShownSetup, "G1"},
        {"idle", "format", "", "", "", "format_question", nullptr, "G1"},
        {"idle", "format_confirmed", "card == present", "", "home", "", formatCard, "G1"},
        {"idle", "format_confirmed", "card == absent", "", "", "card_absent", nullptr, "P"},
        {"idle", "format_confirmed", "", "", "", "card_locked", nullptr, "P"},
        {"idle", "adjust", "level == good and warm == yes", "adjusting", "", "", nullptr, "G1"},
        {"idle", "adjust", "", "", "", "adjust_refused", nullptr, "P"},
        {"adjusting", "elapsed", "", "idle", "service", "adjusted", nullptr, "P"},
        {"adjusting", "moved", "", "idle", "service", "adjust_refused", nullptr, "P"},
    },
    {{"use_profile", useProfile}, {"save_profile", saveProfile}, {"delete_profile", deleteProfile},
     {"area_from_head", areaFromHead}, {"area_to_head", areaToHead}},
    {{"profile", FactUnit::none, {}, [](const Device& d) { return wordFact(profileName(d)); }, "the chosen profile; a star where it was changed"},
     {"expected.saving", FactUnit::seconds, kNumber, [](const Device& d) { return numberFact(std::max(3.0, d.type().instrument.overhead_s - kSpinUp_s)); }, "warm-up columns and saving"},
     {"eye_safety", FactUnit::none, {}, [](const Device&) { return wordFact("7.50 m / 2.8 m"); }, "axial and radial distance of eye safety [S7]"},
     {"display.columns", FactUnit::none, kNumber, [](const Device& d) { return numberFact(std::round(d.expected().columns * kDisplayColumns)); }, "columns as the display counts them"}},
    {{"profiles", profileRows}},
    prepare,
};

}  // namespace

const DeviceProgram& focusProgram() { return kProgram; }

}  // namespace standpoint
