// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <functional>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/json_file.h"
#include "emulated-ui/layout/icons.h"
#include "emulated-ui/layout/place.h"
#include "tests/emulated-ui/support.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class Layouts : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(Layouts, HaveOnePlaceForEachWidgetOfEachScanner) {
  const auto first = loadDevice(*GetParam());
  ASSERT_TRUE(first) << describe(first.error());
  for (const auto& instrument : (*first)->definition.instruments) {
    if (instrument == "*") continue;
    const auto type = loadDevice(*GetParam(), instrument);
    ASSERT_TRUE(type) << describe(type.error());
    const auto layout = loadLayout(*GetParam(), **type);
    ASSERT_TRUE(layout) << instrument << ": " << describe(layout.error());
    for (const auto& screen : (*type)->definition.screens)
      EXPECT_TRUE(layout->screens.contains(screen.id)) << screen.id;
  }
}

TEST_P(Layouts, HaveAnIconForEachKeyOfTheHomeScreen) {
  const auto type = loadDevice(*GetParam());
  const auto layout = loadLayout(*GetParam(), **type);
  ASSERT_TRUE(layout) << describe(layout.error());
  for (const auto& screen : (*type)->definition.screens)
    for (const auto& row : screen.widgets)
      if (screen.entry && row.kind == WidgetKind::button) {
        EXPECT_TRUE(layout->icons.contains(row.id)) << screen.id << '/' << row.id;
      }
}

INSTANTIATE_TEST_SUITE_P(Device, Layouts, testing::ValuesIn(everyDevice()), deviceName);

// Kinds and shares alone: neither colours nor words.
std::string shapeOf(const Region& region) {
  std::string text = std::to_string(static_cast<int>(region.kind)) + "/" + std::to_string(static_cast<int>(region.as)) +
                     "/" + std::to_string(region.widgets.size()) + "(";
  for (const auto& part : region.parts) text += shapeOf(part) + ",";
  return text + ")";
}

TEST(Homes, AreToldApartWithoutColoursAndWords) {
  std::set<std::string> shapes;
  for (const auto& device : emulatedDevices()) {
    const auto type = loadDevice(device);
    const auto layout = loadLayout(device, **type);
    ASSERT_TRUE(layout) << describe(layout.error());
    const auto& screens = (*type)->definition.screens;
    const auto home = std::find_if(screens.begin(), screens.end(), [](const ScreenRow& s) { return s.entry; });
    ASSERT_NE(home, screens.end());
    const auto shape = shapeOf(layout->screens.at(home->id).root);
    EXPECT_TRUE(shapes.insert(shape).second) << device.id << " is arranged like another one: " << shape;
  }
}

// Aspects of the displays: 480 x 800, 640 x 480 and tablets of 16:10 are those of instrument facts.
TEST(Faces, HaveTheAspectOfTheirDisplays) {
  const std::pair<const char*, float> kAspects[] = {{"leica-rtc360", 0.6F},   {"leica-p-series", 4.0F / 3},
                                                    {"faro-focus", 4.0F / 3}, {"trimble-x7", 1.6F},
                                                    {"riegl-vz-i", 5.0F / 3}, {"leica-blk360", 1.32F}};
  for (const auto& [id, aspect] : kAspects) {
    const auto& device = *findDevice(id);
    const auto layout = loadLayout(device, **loadDevice(device));
    ASSERT_TRUE(layout) << describe(layout.error());
    EXPECT_NEAR(layout->faces.front().display[2] / layout->faces.front().display[3], aspect, 0.01F) << id;
  }
}

TEST(Icons, AreFourDozenAndMoreAndEachMeansSomethingElse) {
  const auto& icons = deviceIcons();
  ASSERT_TRUE(icons) << describe(icons.error());
  EXPECT_GE(icons->size(), 48U);
  std::set<std::string> ids, meanings;
  for (const auto& icon : *icons) {
    EXPECT_TRUE(ids.insert(icon.id).second) << icon.id;
    EXPECT_TRUE(meanings.insert(icon.means).second) << icon.means;
    for (const auto& stroke : icon.strokes)
      for (const auto& [x, y] : stroke.points) {
        EXPECT_GE(std::min(x, y), 0) << icon.id;
        EXPECT_LE(std::max(x, y), 24) << icon.id;
      }
  }
}

Region widget(const std::string& id, double size = 0) {
  Region r;
  r.kind = RegionKind::widget;
  r.widget = id;
  r.size = size;
  return r;
}

Region stack(RegionKind kind, std::vector<Region> parts) {
  Region r;
  r.kind = kind;
  r.parts = std::move(parts);
  return r;
}

PlacingState allThere(const std::set<std::string>& absent = {}) {
  return {[absent](const std::string& id) { return !absent.contains(id); }, [](const Region&) { return 0; }, 10};
}

TEST(Place, PartsWithoutASizeShareWhatIsLeft) {
  const auto root = stack(RegionKind::rows, {widget("a", 0.2), widget("b"), widget("c")});
  const auto placed = placeRegions(root, {0, 0, 100, 200}, allThere());
  ASSERT_EQ(placed.size(), 3U);
  EXPECT_FLOAT_EQ(placed[0].box.height, 40);
  EXPECT_FLOAT_EQ(placed[1].box.height, 80);
  EXPECT_FLOAT_EQ(placed[2].box.y, 120);
}

TEST(Place, WhatIsNotThereLeavesItsRoomToTheOthers) {
  const auto root = stack(RegionKind::columns, {widget("a", 0.4), widget("b"), widget("c")});
  const auto placed = placeRegions(root, {0, 0, 100, 50}, allThere({"b"}));
  ASSERT_EQ(placed.size(), 2U);
  EXPECT_FLOAT_EQ(placed[1].box.x, 40);
  EXPECT_FLOAT_EQ(placed[1].box.width, 60);
}

TEST(Place, WhatLiesOnAPictureKeepsToItsCorner) {
  auto corner = widget("start");
  corner.anchor = "bottom right";
  corner.width = corner.height = 0.25;
  const auto placed = placeRegions(stack(RegionKind::over, {widget("plan"), corner}), {10, 10, 200, 100}, allThere());
  ASSERT_EQ(placed.size(), 2U);
  EXPECT_EQ(placed[1].depth, 1);
  EXPECT_FLOAT_EQ(placed[1].box.right(), 210);
  EXPECT_FLOAT_EQ(placed[1].box.bottom(), 110);
  EXPECT_FLOAT_EQ(placed[1].box.width, 50);
}

TEST(Place, OfTabsTheChosenOneIsThere) {
  auto tabs = stack(RegionKind::tabs, {widget("a"), widget("b")});
  tabs.at_bottom = true;
  auto state = allThere();
  state.tab = [](const Region&) { return 1; };
  const auto placed = placeRegions(tabs, {0, 0, 100, 100}, state);
  ASSERT_EQ(placed.size(), 2U);
  EXPECT_FLOAT_EQ(placed[0].box.y, 90) << "their titles are at the bottom";
  EXPECT_EQ(placed[1].region->widget, "b");
  EXPECT_FLOAT_EQ(placed[1].box.height, 90);
}

// The layout of the RTC360, as a teacher has edited it.
class EditedLayout : public testing::Test {
 protected:
  std::string saysOf(const std::function<void(json&)>& edit) {
    const auto& device = *findDevice("leica-rtc360");
    auto file = readJsonFile(device.folder() / "layout.json").value();
    edit(file);
    return saysOfText(file.dump());
  }
  std::string saysOfText(const std::string& text) {
    const auto& device = *findDevice("leica-rtc360");
    const auto path = folder_.path() / "leica-rtc360.json";
    std::ofstream(path, std::ios::binary) << text;
    const auto layout = readLayout(path, (*loadDevice(device))->definition);
    return layout ? "" : describe(layout.error());
  }
  static json& home(json& file) { return file["screens"]["home"]["region"]["rows"]; }
  TemporaryFolder folder_;
};

TEST_F(EditedLayout, MovesAButton) {
  EXPECT_EQ(saysOf([](json& file) { std::swap(home(file)[1], home(file)[2]); }), "");
}

TEST_F(EditedLayout, IsRefusedByFileAndPlace) {
  const std::pair<std::function<void(json&)>, const char*> kFaults[] = {
      {[](json& f) { home(f)[1] = "jobb"; },
       "/screens/home/region/rows/1: the screen 'home' has no widget 'jobb'; did you mean 'job'"},
      {[](json& f) { home(f).erase(1); }, "/screens/home: 'job' has no place"},
      {[](json& f) { home(f)[2] = "job"; }, "'job' has 2 places"},
      {[](json& f) { f["screens"]["attic"] = f["screens"]["home"]; },
       "/screens/attic: the device has no screen 'attic'"},
      {[](json& f) { f["icons"]["job"] = "foldr"; }, "/icons/job: there is no icon 'foldr'; did you mean 'folder'"},
      {[](json& f) { home(f)[2]["size"] = 0.9; }, "/screens/home/region: its parts take 1."},
      {[](json& f) { f["faces"][0]["text"] = 8; },
       "/faces/0/text: letters are 4.8 pixels high at 100 %; at least 11 can be read"},
      {[](json& f) { home(f)[7]["size"] = 0.02; }, "pixels at 100 %; a finger needs at least 30"},
      {[](json& f) { home(f)[6]["columns"][1]["as"] = "slider"; },
       "/screens/home/region/rows/6/columns/1: a key cannot be drawn as 'slider'"},
      {[](json& f) {
         f["faces"][0]["display"] = {300, 104, 480, 800};
       },
       "/faces/0/display: the display must lie in its body"},
      {[](json& f) { f["faces"][0]["keys"].erase(0); }, "/faces/0/keys: 'power' has no place on the body"},
      {[](json& f) {
         f["faces"][0]["keys"][0]["box"] = {100, 200, 90, 60};
       },
       "/faces/0/keys/0/box: a key must lie on the body beside the display"},
      {[](json& f) { f["screens"]["link"]["region"]["rows"][1]["over"][2]["width"] = 0.9; },
       "lies on what is at /screens/link/region/rows/1/over/1"},
      {[](json& f) {
         f["screens"]["new_job"] = {
             {"region", {{"rows", {{{"title", json::array()}, {"size", 0.1}}, "name", "first", "create"}}}}};
       },
       "a field that is typed into must be in a form"},
      {[](json& f) { home(f)[0]["sise"] = 1; }, "unknown key"},
      {[](json& f) { f["faces"] = json::array(); }, "/faces: a device needs at least one face"},
  };
  for (const auto& [edit, says] : kFaults) {
    const auto said = saysOf(edit);
    EXPECT_THAT(said, HasSubstr(says));
    EXPECT_THAT(said, HasSubstr("leica-rtc360.json")) << says;
  }
}

TEST_F(EditedLayout, OfAnyShapeIsReadOrRefused) {
  std::string deep = "{\"screens\":{\"home\":{\"region\":";
  for (int i = 0; i < 200; ++i) deep += "{\"rows\":[";
  for (const auto& text : {std::string(), std::string("[]"), std::string("{"), std::string("{\"faces\": 3}"), deep})
    EXPECT_NE(saysOfText(text), "");
  const auto whole = readJsonFile(findDevice("leica-rtc360")->folder() / "layout.json")->dump();
  for (std::size_t cut = 0; cut < whole.size(); cut += 97) EXPECT_NE(saysOfText(whole.substr(0, cut)), "");
}

}  // namespace
}  // namespace standpoint
