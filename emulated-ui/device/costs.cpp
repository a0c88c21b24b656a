// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/costs.h"

#include <algorithm>
#include <deque>
#include <map>

#include <fmt/format.h>

#include "emulated-ui/device/format.h"
#include "emulated-ui/device/settings.h"

namespace standpoint {

namespace {

// "3 mm @ 10 m: 2:42, 163 M, noise x 1.0"
std::string choiceCosts(const Device& device, const InstrumentSetting& setting) {
  std::string text;
  for (const auto& choice : setting.choices) {
    const auto adapted = adaptedSettings(device.type().instrument, device.state().settings, setting.key, choice.value);
    const auto costs =
        adapted ? resolveSettings(device.type().instrument, *adapted) : Result<ScanSettings>(failure(adapted.error()));
    if (!costs) continue;
    text += fmt::format(
        "\n{}: {}, {}, {} × {:.2g}", choice.label, clockText(costs->scan_seconds + costs->imaging_seconds),
        pointsText(static_cast<double>(costs->columns) * costs->rows), device.word("help.noise"), costs->noise_factor);
  }
  return text;
}

const std::string* screenOf(const DeviceDefinition& d, const WidgetRow& row) {
  for (const auto& screen : d.screens)
    for (const auto& w : screen.widgets)
      if (&w == &row) return &screen.id;
  return nullptr;
}

}  // namespace

std::string wayTo(const Device& device, const std::string& screen) {
  const auto& d = device.type().definition;
  std::map<std::string, std::string> came;  // screen: the one before
  std::deque<std::string> open;
  for (const auto& s : d.screens)
    if (s.entry) open.push_back(s.id), came[s.id] = "";
  while (!open.empty()) {
    const auto* s = findScreen(d, open.front());
    open.pop_front();
    for (const auto& w : s->widgets)
      if (!w.go.empty() && w.go != "back" && came.emplace(w.go, s->id).second) open.push_back(w.go);
  }
  std::string way;
  for (std::string at = screen; !at.empty();) {
    way = device.word(at) + (way.empty() ? "" : " › ") + way;
    const auto before = came.find(at);
    at = before == came.end() ? "" : before->second;
  }
  return way;
}

std::string widgetHelp(const Device& device, const WidgetRow& row) {
  const auto& type = device.type();
  const std::string key = row.words + "?";
  std::string text = type.words->has(type.definition.id, key, "en") ? device.word(key) : std::string();
  for (const auto& [gesture, effect] : row.gestures) text += (text.empty() ? "" : "\n") + device.word(effect.words);
  const auto setting = std::find_if(type.instrument.settings.begin(), type.instrument.settings.end(),
                                    [&](const InstrumentSetting& s) { return s.key == row.setting; });
  if (setting != type.instrument.settings.end()) text += choiceCosts(device, *setting);
  if (const auto* screen = screenOf(type.definition, row)) text += (text.empty() ? "" : "\n") + wayTo(device, *screen);
  return text;
}

}  // namespace standpoint
