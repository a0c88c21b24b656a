// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

#include "emulated-ui/device/settings.h"
#include "emulated-ui/widget_list.h"
#include "project/verb.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

std::shared_ptr<const ScanPreview> smallPreview() {
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
Device working(const std::shared_ptr<const DeviceType>& type, const PhaseRow& phase, const std::string& screen) {
  Device d(type);
  auto& s = d.change();
  s.phase = phase.id;
  s.screen = screen;
  s.came_from = {type->definition.screens.front().id == screen ? type->definition.screens.back().id : type->definition.screens.front().id};
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
    for (const char* name : {"T1", "T2", "T3"}) {
      FittedTarget t;
      t.name = name;
      t.kind = "sphere";
      t.points = 100;
      t.range_m = 5;
      t.residual_m = 0.001;
      t.found = true;
      setup.targets.push_back(t);
    }
    project.setups.push_back(setup);
  }
  s.projects = {project};
  s.project = 0;
  s.shown = 1;
  s.entries["name"] = "Flat";
  return d;
}

std::vector<std::string> valuesOf(const Widget& w) {
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
    case WidgetKind::number: return {std::to_string(std::lround(w.minimum)), std::to_string(std::lround((w.minimum + w.maximum) / 2))};
    case WidgetKind::area: return {"10,200,-20,30"};
    case WidgetKind::preview: return {"0.3,0.4"};
    default: return {""};
  }
}

// Everything that a press may change, but for the log.
std::string trace(Device device) {
  const auto& s = device.state();
  std::string text = s.phase + "|" + s.screen + "|" + s.dialog + "|" + s.dialog_detail + "|" + s.language + "|" + std::to_string(s.project) + "|" + std::to_string(s.shown);
  for (const auto& [key, value] : s.settings) text += "|" + key + "=" + value;
  for (const auto& [key, value] : s.values) text += "|" + key + "=" + value;
  for (const auto& [key, value] : s.entries) text += "|" + key + "=" + value;
  for (const auto& p : s.projects) {
    text += "|" + p.name + p.cluster + p.base + p.note;
    for (const auto& setup : p.setups) text += setup.name + (setup.looked_at ? "+" : "-") + (setup.link ? "l" : "");
  }
  for (const auto& t : s.sighted) text += "|" + t.id + (t.used ? "+" : "-");
  text += "|" + std::to_string(s.control.targets.size()) + (s.orientation ? s.orientation->method + s.orientation->station + (s.orientation->accepted ? "+" : "-") : "");
  if (device.takeOrder()) text += "|order";
  if (device.takeView()) text += "|view";
  if (device.takeCancel()) text += "|cancel";
  return text;
}

// Known control points, one of which was sighted.
void knowPlaces(DeviceState& s) {
  for (int n = 0; n < 4; ++n) s.control.targets.push_back({"T" + std::to_string(n + 1), {n % 2 * 5.0, n / 2 * 5.0, 1.0 + n}});
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
std::vector<Variant> variantsOf(const DeviceType& type) {
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

// Where the widget can be met: in the phases that show its screen, or in any other.
bool isPressedSomewhere(const std::shared_ptr<const DeviceType>& type, const std::string& screen, const std::string& id, bool on_body) {
  for (const auto& phase : type->definition.phases) {
    if (!phase.on && !on_body) continue;
    for (const auto& variant : variantsOf(*type)) {
      Device d = working(type, phase, screen);
      variant(d.change());
      (void)d.setSettings(d.state().settings);
      const auto shown = d.screen();
      const auto* w = findWidget(shown, id);
      if (w == nullptr || !w->enabled) continue;
      const auto before = trace(d);
      for (const auto& value : valuesOf(*w)) {
        Device pressed = d;
        if (pressed.act(id, value) && trace(pressed) != before) return true;
      }
    }
  }
  return false;
}

std::size_t choicesOf(const DeviceType& type, const std::string& key) {
  for (const auto& setting : type.instrument.settings)
    if (setting.key == key) return setting.choices.size();
  return 0;
}

// What takes a longer story to become of use; the tests that tell it.
const std::map<std::string, std::string> kTheirOwn = {
    {"trimble-x7/registration/link_list", "X7.MakesAStationAmberBetween73And91"},
    {"trimble-x7/registration/apply", "X7.MakesAStationAmberBetween73And91"},
    {"trimble-x7/registration/reject", "X7.MakesAStationAmberBetween73And91"},
    {"riegl-vz-i/control_points/georeference", "VzI.NeedsFourControlPointsWithANameAndThreeCoordinates"},
    {"riegl-vz-i/control_points/clear_points", "VzI.NeedsFourControlPointsWithANameAndThreeCoordinates"},
};

class Widgets : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(Widgets, PressedOnEveryScreen) {
  const auto first = loadDevice(*GetParam());
  ASSERT_TRUE(first) << describe(first.error());
  // A widget may need another scanner of the family: the M70 lacks a quality, one generation a camera.
  std::vector<std::shared_ptr<const DeviceType>> types = {*first};
  for (const auto& id : (*first)->definition.instruments)
    if (id != "*" && id != (*first)->instrument.id) types.push_back(*loadDevice(*GetParam(), id));
  const auto pressed = [&](const std::string& screen, const std::string& id, bool on_body) {
    return std::any_of(types.begin(), types.end(), [&](const auto& type) { return isPressedSomewhere(type, screen, id, on_body); });
  };
  const std::set<WidgetKind> kShown = {WidgetKind::status, WidgetKind::readout, WidgetKind::note, WidgetKind::progress, WidgetKind::lamp, WidgetKind::level, WidgetKind::plan};
  for (const auto& key : (*first)->definition.keys)
    if (!kShown.contains(key.kind)) EXPECT_TRUE(pressed((*first)->definition.screens.front().id, key.id, true)) << "key " << key.id;
  for (const auto& screen : (*first)->definition.screens)
    for (const auto& w : screen.widgets) {
      const bool one_choice = w.kind == WidgetKind::choice && !w.setting.empty() && choicesOf(**first, w.setting) == 1;   // nothing else can be chosen
      if (one_choice || kTheirOwn.contains(std::string(GetParam()->id) + "/" + screen.id + "/" + w.id)) continue;
      const bool only_a_list = w.kind == WidgetKind::list && w.does.empty() && w.go.empty();
      if (!kShown.contains(w.kind) && !only_a_list) EXPECT_TRUE(pressed(screen.id, w.id, false)) << screen.id << "/" << w.id << " does nothing wherever it is pressed";
    }
}

TEST_P(Widgets, ShowSomething) {
  const auto type = loadDevice(*GetParam());
  ASSERT_TRUE(type);
  for (const auto& screen : (*type)->definition.screens)
    for (const auto& row : screen.widgets) {
      if (row.shows.empty()) continue;
      const Device d = working(*type, *findPhase((*type)->definition, (*type)->definition.phases[1].id), screen.id);
      const auto shown = d.screen();
      if (const auto* w = findWidget(shown, row.id)) EXPECT_FALSE(w->value.empty()) << screen.id << "/" << row.id;
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, Widgets, testing::ValuesIn(everyDevice()), deviceName);

TEST(WidgetList, DocsListThemAll) {
  const auto list = widgetList();
  ASSERT_TRUE(list) << describe(list.error());
  std::ifstream in(dataFolder() / "docs" / "widgets.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(page == *list) << "docs/widgets.md is out of date: build/release/bin/list-widgets > docs/widgets.md";
}

}  // namespace
}  // namespace standpoint
