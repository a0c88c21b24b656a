// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "emulated-ui/device/settings.h"
#include "tests/emulated-ui/support.h"

// Devices in the middle of their work, and what can be done to them, for tests that try everything everywhere.
namespace standpoint {

inline std::shared_ptr<const ScanPreview> smallPreview() {
  auto preview = std::make_shared<ScanPreview>();
  preview->columns = 8;
  preview->rows = 4;
  for (int i = 0; i < 32; ++i) {
    preview->x_m.push_back(static_cast<float>(i));
    preview->y_m.push_back(1);
    preview->z_m.push_back(0);
    preview->grey.push_back(static_cast<std::uint8_t>(8 * i));
  }
  return preview;
}

// On, at rest, with a project of two scans, one of which is on view: what most widgets need to be of use.
inline Device working(const std::shared_ptr<const DeviceType>& type, const PhaseRow& phase, const std::string& screen) {
  Device d(type);
  auto& s = d.change();
  s.phase = phase.id;
  s.screen = screen;
  s.came_from = {type->definition.screens.front().id == screen ? type->definition.screens.back().id
                                                               : type->definition.screens.front().id};
  s.around.station = "S1";
  DeviceProject project;
  project.name = "House";
  for (int n : {1, 2}) {
    StoredSetup setup;
    setup.project = project.name;
    setup.number = n;
    setup.name = "Setup " + std::to_string(n);
    setup.station = "S1";
    setup.file = setup.name + ".e57";
    setup.points = 1000000;
    setup.bytes = 1e7;
    setup.settings = s.settings;
    setup.preview = smallPreview();
    for (const char* name : {"T1", "T2", "T3"}) setup.targets.push_back(fittedSphere(name, 100));
    project.setups.push_back(setup);
  }
  s.projects = {project};
  s.project = 0;
  s.shown = 1;
  s.entries["name"] = "Flat";
  return d;
}

inline std::vector<std::string> valuesOf(const Widget& w) {
  switch (w.kind) {
    case WidgetKind::choice:
    case WidgetKind::list: {
      std::vector<std::string> values;
      for (const auto& o : w.options)
        if (o.enabled) values.push_back(o.value);
      return values;
    }
    case WidgetKind::toggle: return {"on", "off"};
    case WidgetKind::text: return {"Something"};
    case WidgetKind::number:
      return {std::to_string(std::lround(w.minimum)), std::to_string(std::lround((w.minimum + w.maximum) / 2))};
    case WidgetKind::area: return {"10,200,-20,30"};
    case WidgetKind::preview: return {"0.3,0.4"};
    default: return {""};
  }
}

// Everything that a press may change, but for the log.
inline std::string trace(Device device) {
  const auto& s = device.state();
  std::string text = s.phase + "|" + s.screen + "|" + s.dialog + "|" + s.dialog_detail + "|" + s.language + "|" +
                     std::to_string(s.project) + "|" + std::to_string(s.shown);
  for (const auto& [key, value] : s.settings) text += "|" + key + "=" + value;
  for (const auto& [key, value] : s.values) text += "|" + key + "=" + value;
  for (const auto& [key, value] : s.entries) text += "|" + key + "=" + value;
  for (const auto& p : s.projects) {
    text += "|" + p.name + p.cluster + p.base + p.note;
    for (const auto& setup : p.setups) text += setup.name + (setup.looked_at ? "+" : "-") + (setup.link ? "l" : "");
  }
  for (const auto& t : s.sighted) text += "|" + t.id + (t.used ? "+" : "-");
  text += "|" + std::to_string(s.control.targets.size()) +
          (s.orientation ? s.orientation->method + s.orientation->station + (s.orientation->accepted ? "+" : "-") : "");
  if (device.takeOrder()) text += "|order";
  if (device.takeView()) text += "|view";
  if (device.takeCancel()) text += "|cancel";
  return text;
}

// Known control points, one of which was sighted.
inline void knowPlaces(DeviceState& s) {
  for (int n = 0; n < 4; ++n)
    s.control.targets.push_back({"T" + std::to_string(n + 1), {n % 2 * 5.0, n / 2 * 5.0, 1.0 + n}});
  s.control.stations.push_back({"S1", {1, 1, 0}});
  s.control.stations.push_back({"S9", {2, 2, 0}});
  s.sighted.push_back({"T1", {3, 0, 1}, 1.5, 0.001, 90, true});
  s.orientation = StationOrientation{};
  s.orientation->method = s.values["method"];
  s.orientation->station = "S9";
}

using Variant = std::function<void(DeviceState&)>;

// Situations that single widgets need: nothing stored, a scan that runs or was pushed, other settings and values, known
// control points.
inline std::vector<Variant> variantsOf(const DeviceType& type) {
  std::vector<Variant> variants = {
      [](DeviceState&) {},
      [](DeviceState& s) { s.projects.clear(), s.project = -1; },
      [](DeviceState& s) { s.projects[0].setups.clear(), s.shown = -1; },
      [](DeviceState& s) { s.running = ScanOrder{}; },
      [](DeviceState& s) { s.running = ScanOrder{}, s.moved = true; },
      [](DeviceState& s) {
        for (auto& setup : s.projects[0].setups) setup.link = LinkResult{true, 0.01, 0.3, 0, 0};
      },
      knowPlaces,
      [](DeviceState& s) {
        for (const char* id : {"first", "index", "start_index"}) s.entries[id] = "7";
        s.entries["name"] = "Another";
      },
      [](DeviceState& s) { s.values["head"] = "90"; },
      [](DeviceState& s) {
        for (auto& [key, value] : s.settings)
          if (key == "horizontal_from" || key == "vertical_from") value = "10";
      },
  };
  for (const auto& value : type.definition.values)
    for (const auto& choice : value.choices)
      variants.push_back([id = value.id, choice](DeviceState& s) {
        s.values[id] = choice;
        knowPlaces(s);
      });
  for (const auto& setting : type.instrument.settings)
    for (const auto& choice : setting.choices)
      variants.push_back([key = setting.key, choice = choice.value, &type](DeviceState& s) {
        if (const auto adapted = adaptedSettings(type.instrument, s.settings, key, choice)) s.settings = *adapted;
      });
  return variants;
}

}  // namespace standpoint
