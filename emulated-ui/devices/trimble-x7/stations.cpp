// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "emulated-ui/device/picture.h"
#include "emulated-ui/devices/trimble-x7/links.h"
#include "emulated-ui/devices/trimble-x7/tablet.h"

namespace standpoint::trimble_x7 {

namespace {

constexpr std::size_t kLatest = 5, kNearest = 3;
const std::string kAnnotation = "annotation.";  // + file and number: a value of the device

}  // namespace

std::vector<WidgetOption> stationRows(const Device& device) {
  std::vector<WidgetOption> rows;
  const auto* project = device.project();
  if (project == nullptr || project->setups.empty()) return rows;
  const auto& setups = project->setups;
  const auto& centre = device.shownSetup() != nullptr ? *device.shownSetup() : setups.back();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < setups.size(); ++i) order.push_back(i);
  const auto filter = device.value("view_filter");
  if (filter == "latest" && order.size() > kLatest) order.erase(order.begin(), order.end() - kLatest);
  if (filter == "nearest") {
    const auto away = [&](std::size_t i) {
      return std::hypot(setups[i].plan_x_m - centre.plan_x_m, setups[i].plan_y_m - centre.plan_y_m);
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return away(a) < away(b); });
    order.resize(std::min(order.size(), kNearest));
  }
  for (const auto i : order)
    rows.push_back(
        {std::to_string(i),
         fmt::format("{}  {}  {}{}", setups[i].name, setups[i].station,
                     device.word("registration=" + (i == 0 ? "reference" : registrationOf(device, setups[i]))),
                     setups[i].moved        ? "  !"
                     : setups[i].unlevelled ? "  ~"
                                            : ""),
         true,
         {}});
  return rows;
}

Result<void> addAnnotation(Device& device, const std::string&) {
  const auto* setup = device.shownSetup();
  const auto text = device.entry("annotation");
  if (setup == nullptr || text.empty()) return failure(ErrorKind::usage, device.word("annotation_empty"));
  auto& values = device.change().values;
  for (int n = 1; n < 100; ++n)
    if (values.emplace(fmt::format("{}{}.{:02d}", kAnnotation, setup->file, n), text).second) break;
  device.change().entries["annotation"].clear();
  device.note("annotation", text);
  return {};
}

std::vector<WidgetOption> annotationRows(const Device& device) {
  std::vector<WidgetOption> rows;
  if (const auto* setup = device.shownSetup())
    for (const auto& [id, text] : device.state().values)
      if (id.starts_with(kAnnotation + setup->file + ".")) rows.push_back({id, text, true, {}});
  return rows;
}

Result<void> switchPointer(Device& device, const std::string&) {
  device.change().entries.erase("pointer");
  return {};
}

// With the pointer on a tap turns it to that spot of the station view, if the scanner still stands where that was
// scanned.
Result<void> measureOrPoint(Device& device, const std::string& at) {
  if (device.value("pointer") != "on") return sharedAction(device, "measure", at);
  const auto* setup = device.shownSetup();
  if (setup == nullptr || !setup->preview) return failure(ErrorKind::usage, device.word("no_preview"));
  if (setup->station != device.state().around.station)
    return failure(ErrorKind::usage, device.word("pointer_elsewhere"));
  if (!spotIn(*setup->preview, at)) return failure(ErrorKind::usage, device.word("no_point"));
  device.change().entries["pointer"] = at;
  device.note("pointed", at);
  return {};
}

std::optional<Eigen::Vector3d> pointerSpot(const Device& device) {
  const auto* setup = device.shownSetup();
  if (device.value("pointer") != "on" || setup == nullptr || !setup->preview ||
      setup->station != device.state().around.station)
    return std::nullopt;
  return spotIn(*setup->preview, device.entry("pointer"));
}

double unmeasured(const Device& device) {
  const auto* setup = device.shownSetup();
  if (setup == nullptr || !setup->preview || setup->preview->x_m.empty()) return 0;
  const auto& x = setup->preview->x_m;
  return static_cast<double>(std::count_if(x.begin(), x.end(), [](float v) { return !std::isfinite(v); })) /
         static_cast<double>(x.size());
}

// Type, level, description [S15].
std::vector<WidgetOption> errorRows(const Device& device) {
  struct Row {
    const char *condition, *wrong_unless, *level, *word;
  };
  static constexpr std::array kRows = {
      Row{"battery.state", "good", "warning", "battery_low_word"}, Row{"card", "present", "error", "card_missing_word"},
      Row{"level", "good", "warning", "tilt_word"}, Row{"temperature.state", "good", "warning", "temperature_word"},
      Row{"wlan", "yes", "error", "wlan_lost"}};
  std::vector<WidgetOption> rows;
  for (const auto& row : kRows)
    if (device.fact(row.condition)->text != row.wrong_unless)
      rows.push_back({row.word,
                      fmt::format("{} | {}", device.word(std::string("level=") + row.level), device.word(row.word)),
                      true,
                      {}});
  return rows;
}

}  // namespace standpoint::trimble_x7
