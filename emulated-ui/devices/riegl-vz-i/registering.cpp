// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/devices/riegl-vz-i/registering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/linking.h"
#include "emulated-ui/devices/riegl-vz-i/positions.h"

namespace standpoint::riegl_vz_i {

namespace {

constexpr double kReflectorPoints = 5;  // [P] so many must lie on a reflector for the search to see it

// What each mode takes for a match, and how long it looks: all of it [P]; the names [S31]. AUTO tries the others.
struct Mode {
  const char* name;
  double max_error_m, min_overlap, seconds;
};
constexpr std::array kModes = {
    Mode{"AUTO", 0.02, 0.3, 30},         Mode{"OUTDOOR_URBAN", 0.03, 0.25, 20}, Mode{"OUTDOOR_NON_URBAN", 0.1, 0.2, 25},
    Mode{"INDOOR_SMALL", 0.01, 0.4, 10}, Mode{"INDOOR_LARGE", 0.02, 0.3, 15},   Mode{"MINING_MEDIUM", 0.05, 0.25, 20},
    Mode{"MINING_LARGE", 0.1, 0.2, 30}};

const Mode& modeOf(const Device& device) {
  const auto name = device.value("registration_mode");
  const auto found = std::find_if(kModes.begin(), kModes.end(), [&](const Mode& m) { return name == m.name; });
  return found == kModes.end() ? kModes.front() : *found;
}

}  // namespace

double registrationSeconds(const Device& device) { return modeOf(device).seconds; }

std::string registrationResult(const Device& device) {
  const auto result = device.entry("registration_result");
  return result.empty() ? "none" : result;
}

// The earlier position that the newest is registered against: the one on view, else the nearest by its rough place,
// which the device has from its own sensors [P].
static const StoredSetup* registeredAgainst(const Device& device) {
  const auto* project = device.project();
  const auto* newest = device.newestSetup();
  if (newest == nullptr) return nullptr;
  if (const auto* shown = device.shownSetup(); shown != nullptr && shown->file != newest->file) return shown;
  const StoredSetup* nearest = nullptr;
  const auto away = [&](const StoredSetup& s) {
    return std::hypot(s.plan_x_m - newest->plan_x_m, s.plan_y_m - newest->plan_y_m);
  };
  for (const auto& setup : project->setups)
    if (setup.file != newest->file && (nearest == nullptr || away(setup) <= away(*nearest))) nearest = &setup;
  return nearest;
}

Result<void> chooseReference(Device& device, const std::string& rows) {
  TRY_ASSIGN(const auto pair, pairIn(device, rows));
  if (pair.first != device.newestSetup()) return failure(ErrorKind::usage, device.word("newest_only"));
  device.change().shown = static_cast<int>(pair.second - device.project()->setups.data());
  return {};
}

void beginRegistration(Device& device) {
  device.change().entries.erase("registration_result");
  if (const auto* earlier = registeredAgainst(device)) orderLinkTo(device, *device.newestSetup(), *earlier);
}

// FAST_REG_FAILED where nothing matches at all, SCAN_REG_FAILED where the match is not good enough for the mode [P].
void judgeRegistration(Device& device) {
  auto* newest = device.newestSetup();
  if (newest == nullptr || !newest->link) return;
  const auto& mode = modeOf(device);
  const bool good =
      newest->link->joined && newest->link->error_m <= mode.max_error_m && newest->link->overlap >= mode.min_overlap;
  device.change().entries["registration_result"] = good ? "ok" : newest->link->joined ? "scan_failed" : "fast_failed";
  newest->link->joined = good;
  device.note("registration", device.state().entries.at("registration_result"));
}

static double diameter_m(const Device& device) { return device.value("reflector_model") == "flat_100" ? 0.1 : 0.05; }

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
  const double from = device.number("value.limit_from"), to = device.number("value.limit_to");
  for (auto& target : setup->targets) {
    if (!target.found) continue;
    const bool outside = target.range_m < from || target.range_m > to;
    if (!outside && target.range_m <= reach(device)) continue;
    target.found = false;
    target.why_not = outside ? "outside_limits" : "too_far_for_model";
  }
}

static void searchReflectors(Device& device) {
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

}  // namespace standpoint::riegl_vz_i
