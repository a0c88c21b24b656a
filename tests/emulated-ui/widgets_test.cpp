// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "emulated-ui/widget_list.h"
#include "project/verb.h"
#include "tests/emulated-ui/working.h"

namespace standpoint {
namespace {

// Where the widget can be met: in the phases that show its screen, or in any other.
bool isPressedSomewhere(const std::shared_ptr<const DeviceType>& type, const std::string& screen, const std::string& id,
                        bool on_body) {
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

class Widgets : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(Widgets, PressedOnEveryScreen) {
  const auto first = loadDevice(*GetParam());
  ASSERT_TRUE(first) << describe(first.error());
  // A widget may need another scanner of the family: the M70 lacks a quality, one generation a camera.
  std::vector<std::shared_ptr<const DeviceType>> types = {*first};
  for (const auto& id : (*first)->definition.instruments)
    if (id != "*" && id != (*first)->instrument.id) types.push_back(*loadDevice(*GetParam(), id));
  const auto pressed = [&](const std::string& screen, const std::string& id, bool on_body) {
    return std::any_of(types.begin(), types.end(),
                       [&](const auto& type) { return isPressedSomewhere(type, screen, id, on_body); });
  };
  const auto elsewhere = testedBy(*GetParam(), "widgets");
  const std::set<WidgetKind> kShown = {WidgetKind::status, WidgetKind::readout, WidgetKind::note, WidgetKind::progress,
                                       WidgetKind::lamp,   WidgetKind::level,   WidgetKind::plan, WidgetKind::seen};
  for (const auto& key : (*first)->definition.keys)
    if (!kShown.contains(key.kind)) {
      EXPECT_TRUE(pressed((*first)->definition.screens.front().id, key.id, true)) << "key " << key.id;
    }
  for (const auto& screen : (*first)->definition.screens)
    for (const auto& w : screen.widgets) {
      const bool one_choice = w.kind == WidgetKind::choice && !w.setting.empty() &&
                              choicesOf(**first, w.setting) == 1;  // nothing else can be chosen
      if (one_choice || elsewhere.contains(screen.id + "/" + w.id)) continue;
      const bool only_a_list = w.kind == WidgetKind::list && w.does.empty() && w.go.empty();
      if (!kShown.contains(w.kind) && !only_a_list) {
        EXPECT_TRUE(pressed(screen.id, w.id, false))
            << screen.id << "/" << w.id << " does nothing wherever it is pressed";
      }
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
      if (const auto* w = findWidget(shown, row.id)) {
        EXPECT_FALSE(w->value.empty()) << screen.id << "/" << row.id;
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, Widgets, testing::ValuesIn(everyDevice()), deviceName);

TEST(WidgetList, DocsListThemAll) {
  const auto list = widgetList();
  ASSERT_TRUE(list) << describe(list.error());
  std::ifstream in(SOURCE_DIR "/docs/reference/widgets.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(page == *list)
      << "docs/reference/widgets.md is out of date: build/release/bin/list-widgets > docs/reference/widgets.md";
}

}  // namespace
}  // namespace standpoint
