// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "emulated-ui/device/effects.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/device/settings.h"
#include "emulated-ui/devices/trimble-x7/links.h"
#include "emulated-ui/devices/trimble-x7/phases.h"
#include "emulated-ui/devices/trimble-x7/tablet.h"

namespace standpoint::trimble_x7 {

namespace {

constexpr double kZenith_deg = 141;  // 282 deg of the vertical turn, from the zenith down [G1]
const Phases kSteps = {phase::calibrating, phase::levelling,   phase::scanning,
                       phase::imaging,     phase::downloading, phase::registering};

}  // namespace

std::vector<WidgetOption> modeRows(const Device& device) {
  std::vector<WidgetOption> rows;
  const auto& instrument = device.type().instrument;
  for (const auto& setting : instrument.settings) {
    if (setting.key != "duration") continue;
    for (const auto& choice : setting.choices) {
      const auto mode = resolveSettings(instrument, withSetting(device.state().settings, "duration", choice.value));
      if (!mode) continue;
      const double points = static_cast<double>(mode->columns) * mode->rows;
      const double spacing_mm = (mode->azimuth_to_rad - mode->azimuth_from_rad) / mode->columns * 10000;
      rows.push_back({choice.value,
                      fmt::format("{} | {:.0f} m | {} | {} | {} | {:.1f} mm | {:.0f} k/s", device.shown("setting.mode"),
                                  mode->max_range_m, pointsText(points),
                                  bytesText(points * device.type().definition.body.bytes_per_point),
                                  clockText(mode->scan_seconds), spacing_mm, points / mode->scan_seconds / 1000),
                      true,
                      {}});
    }
  }
  return rows;
}

Result<void> chooseMode(Device& device, const std::string& duration) {
  return device.setSettings(withSetting(device.state().settings, "duration", duration));
}

const StoredSetup* parentOfArea(const Device& device) {
  const auto* project = device.project();
  if (project == nullptr) return nullptr;
  for (auto setup = project->setups.rbegin(); setup != project->setups.rend(); ++setup)
    if (setup->station == device.state().around.station) return &*setup;
  return nullptr;
}

// The fields of the window begin with what is scanned now.
Result<void> proposeArea(Device& device, const std::string&) {
  const auto angle = [&](const char* key) { return device.number(std::string("setting.") + key); };
  const double from = angle("horizontal_from"), width = angle("horizontal_to") - from;
  auto& entries = device.change().entries;
  entries["start_h"] = fmt::format("{:g}", from);
  entries["delta_h"] = fmt::format("{:g}", width > 0 ? width : width + 360);
  entries["start_v"] = fmt::format("{:g}", 90 - angle("vertical_to"));
  entries["delta_v"] = fmt::format("{:g}", angle("vertical_to") - angle("vertical_from"));
  return {};
}

// Start and width in degrees, the vertical counted from the zenith [S15].
Result<void> takeArea(Device& device, const std::string&) {
  const auto number = [&](const char* id) { return device.entryNumber(id); };
  const double start_h = number("start_h"), delta_h = number("delta_h"), start_v = number("start_v"),
               delta_v = number("delta_v");
  if (start_h >= 360 || !(delta_h > 0 && delta_h <= 360) || !(delta_v > 0 && start_v + delta_v <= kZenith_deg))
    return failure(ErrorKind::usage, device.word("area_wrong"));
  const double end_h = delta_h >= 360 ? start_h : std::fmod(start_h + delta_h, 360);
  auto wanted = withSetting(device.state().settings, "field_of_view", "area");
  wanted = withSetting(wanted, "horizontal_from", fmt::format("{:g}", start_h));
  wanted = withSetting(wanted, "horizontal_to", fmt::format("{:g}", end_h));
  wanted = withSetting(wanted, "vertical_from", fmt::format("{:g}", 90 - start_v - delta_v));
  return device.setSettings(withSetting(wanted, "vertical_to", fmt::format("{:g}", 90 - start_v)));
}

static bool stepIsOff(const Device& device, const PhaseId& step) {
  const bool area = device.setting("field_of_view") == "area";
  return (step == phase::levelling && device.value("self_levelling") == "off") ||
         (step == phase::imaging && !device.expected().imaging) ||
         (step == phase::registering && (device.value("auto_registration") == "off" || area));
}

double stepProgress(const Device& device) {
  const double lasts = device.number("phase.lasts");
  const double fraction = lasts > 0 ? std::clamp(device.state().elapsed_s / lasts, 0.0, 1.0) : 0;
  const bool simulated = device.in(phase::scanning) && !device.state().data;
  return simulated ? std::min(fraction, device.state().engine_fraction) : fraction;
}

std::vector<WidgetOption> stepRows(const Device& device) {
  std::vector<WidgetOption> rows;
  bool done = device.in(kSteps);
  for (const auto& step : kSteps) {
    const bool now = device.in(step);
    done = done && !now;
    const std::string state = stepIsOff(device, step) ? device.word("off")
                              : now                   ? fmt::format("{:.0f} %", stepProgress(device) * 100)
                              : done                  ? "100 %"
                                                      : "0 %";
    rows.push_back({step.name, device.word("phase=" + step.name) + "  " + state, true, {}});
  }
  return rows;
}

void prepareScan(const Device& device, ScanOrder& order) {
  order.name = fmt::format("{} {:03d}", device.setting("field_of_view") == "area" ? "Area" : "Station", order.number);
}

void storeStation(Device& device) {
  storeScan(device);
  if (const auto* newest = device.newestSetup()) forgetRegistration(device, *newest);
}

void storeAndRegister(Device& device) {
  storeStation(device);
  orderLink(device);
}

// A window of a station stands where that station does.
void storeArea(Device& device) {
  storeStation(device);
  if (const auto* newest = device.newestSetup()) setRegistration(device, *newest, "applied");
}

}  // namespace standpoint::trimble_x7
