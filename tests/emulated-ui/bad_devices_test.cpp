// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/data_folder.h"
#include "core/json_file.h"
#include "emulated-ui/device/check.h"
#include "emulated-ui/menus.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const json& shippedDevice(const std::string& device) {
  static std::map<std::string, json> files;
  auto& file = files[device];
  if (file.is_null()) file = readJsonFile(findDevice(device)->folder() / "device.json").value();
  return file;
}

json& named(json& rows, const std::string& id) {
  for (auto& row : rows)
    if (row.at("id") == id) return row;
  ADD_FAILURE() << "there is no row " << id;
  return rows.front();
}
void remove(json& rows, const std::string& id) {
  const auto before = rows.size();
  for (auto row = rows.begin(); row != rows.end(); ++row)
    if (row->at("id") == id) {
      rows.erase(row);
      break;
    }
  EXPECT_LT(rows.size(), before) << id;
}

// A shipped device whose data file a teacher has edited.
class BadDevice : public testing::Test {
 protected:
  using Edit = std::function<void(json&)>;

  Result<std::shared_ptr<const DeviceType>> edited(const std::string& device, const Edit& edit) {
    json changed = shippedDevice(device);
    edit(changed);
    const auto file = folder_.path() / "x.json";
    std::ofstream(file, std::ios::binary) << changed.dump();
    auto definition = readDefinition(file);
    if (!definition) return failure(definition.error());
    const auto whole = loadDevice(*findDevice(device));
    return makeDeviceType(*std::move(definition), findDevice(device)->program(), (*whole)->instrument, (*whole)->words);
  }
  // All that is said of it.
  std::string saysOf(const std::string& device, const Edit& edit) {
    const auto type = edited(device, edit);
    if (!type) return describe(type.error());
    std::string all;
    for (const auto& fault : checkStructure(**type)) all += describe(fault) + "\n";
    return all;
  }
  TemporaryFolder folder_;
};

TEST_F(BadDevice, AShippedOneIsTaken) {
  for (const auto& device : emulatedDevices()) EXPECT_EQ(saysOf(device.id, [](json&) {}), "") << device.id;
}

TEST_F(BadDevice, EachMistakeIsNamedWithItsPlace) {
  struct Wrong {
    const char* message;
    Edit edit;
  };
  const Wrong kWrong[] = {
      {"x.json /phases", [](json& j) { j["phases"] = json::array(); }},
      {"x.json /values/0/standard", [](json& j) { j["values"][0]["standard"] = "perhaps"; }},
      {"x.json /screens", [](json& j) { j["screens"].push_back(j["screens"][0]); }},
      {"x.json /screens/0/widgets/0/kind", [](json& j) { j["screens"][0]["widgets"][0]["kind"] = "lever"; }},
      {"x.json /values/4/standard", [](json& j) { named(j["values"], "brightness")["standard"] = "bright"; }},
      {"x.json /values/4/standard", [](json& j) { named(j["values"], "brightness")["standard"] = 101; }},
      {"leica-rtc360 transition start of 'idle vis_tracking': unknown phase 'scanning_pass_1'",
       [](json& j) { named(j["phases"], "scanning_pass_1")["id"] = "first_pass"; }},
      {"unknown dialog 'card_full'", [](json& j) { remove(j["dialogs"], "card_full"); }},
      {"unknown screen 'setup'", [](json& j) { remove(j["screens"], "setup"); }},
      {"leica-rtc360/device.json /phases/storing/lasts: 'a while' is not a duration in seconds",
       [](json& j) { named(j["phases"], "storing")["lasts"] = "a while"; }},
      {"leica-rtc360/device.json /phases/storing/lasts: 'tilt' is not a duration in seconds",
       [](json& j) { named(j["phases"], "storing")["lasts"] = "tilt"; }},
      {"leica-rtc360/device.json /phases/storing/lasts: 'phase.lasts' is not a duration in seconds",
       [](json& j) { named(j["phases"], "storing")["lasts"] = "phase.lasts"; }},
      {"leica-rtc360/device.json /screens/home/job/go: unknown screen 'attic'",
       [](json& j) { named(named(j["screens"], "home")["widgets"], "job")["go"] = "attic"; }},
      {"leica-rtc360/device.json /screens/home/scan/event: no phase handles the event 'scann'",
       [](json& j) { named(named(j["screens"], "home")["widgets"], "scan")["event"] = "scann"; }},
      {"leica-rtc360/device.json /screens/home/battery/warns: unknown fact 'batery'",
       [](json& j) { named(named(j["screens"], "home")["widgets"], "battery")["warns"] = "batery < 1"; }},
      {"leica-rtc360/device.json /sounds/when: unknown fact 'value.hum'",
       [](json& j) { j["sounds"]["when"] = "value.hum == on"; }},
      {"leica-rtc360/device.json /sounds/rows/key/on: unknown event 'presed'",
       [](json& j) { named(j["sounds"]["rows"], "key")["on"] = {"presed"}; }},
      {"leica-rtc360/device.json /sounds/rows/key/on: unknown phase 'scaning'",
       [](json& j) { named(j["sounds"]["rows"], "key")["on"] = {"phase.scaning"}; }},
      {"leica-rtc360/device.json /sounds/rows/key/on: unknown trouble 'flood'",
       [](json& j) { named(j["sounds"]["rows"], "key")["on"] = {"trouble.flood"}; }},
      {"x.json /sounds/rows/0/tones: tones must be a list of [hertz, milliseconds]",
       [](json& j) { j["sounds"]["rows"][0]["tones"] = "beep"; }},
      {"x.json /sounds/rows/0/tones/0: tones must be a list", [](json& j) { j["sounds"]["rows"][0]["tones"] = {440}; }},
      {"x.json /sounds/rows/0/tones/0/0",
       [](json& j) {
         j["sounds"]["rows"][0]["tones"] = json::array({{-440, 100}});
       }},
      {"x.json /sounds/rows/0/tones: longer than 3000 ms in all",
       [](json& j) {
         j["sounds"]["rows"][0]["tones"] = json::array({{440, 2000}, {880, 2000}});
       }},
      {"x.json /sounds/rows/0/on: name at least one event", [](json& j) { j["sounds"]["rows"][0].erase("on"); }},
  };
  for (const auto& wrong : kWrong) EXPECT_THAT(saysOf("leica-rtc360", wrong.edit), HasSubstr(wrong.message));
}

TEST_F(BadDevice, WithoutCodeOfItsOwnIsRefusedByThePlaceInItsFile) {
  struct Wrong {
    const char* message;
    Edit edit;
  };
  const Wrong kWrong[] = {
      {"x.json /transitions/0/from: unknown phase 'scaning'",
       [](json& j) { j["transitions"][0]["from"] = {"scaning"}; }},
      {"x.json /transitions/0/to: unknown phase 'pictures'", [](json& j) { j["transitions"][0]["to"] = "pictures"; }},
      {"x.json /transitions/0/guard", [](json& j) { j["transitions"][0]["guard"] = "imaging =="; }},
      {"x.json /transitions/3/effect", [](json& j) { j["transitions"][3]["effect"] = "store"; }},
      {"x.json /roles/working: unknown phase 'scaning'", [](json& j) { j["roles"]["working"] = {"scaning"}; }},
      {"x.json /roles/kept: unknown phase 'attic'", [](json& j) { j["roles"]["kept"] = "attic"; }},
      {"x.json /roles/wroking", [](json& j) { j["roles"]["wroking"] = {"scanning"}; }},
      {"x.json /skin/accent: '#12' is not a colour", [](json& j) { j["skin"]["accent"] = "#12"; }},
      {"x.json /scan/levelled", [](json& j) { j["scan"]["levelled"] = "levelled == yes"; }},
      {"x.json /values/3/standard", [](json& j) { j["values"][3]["standard"] = "80"; }},
      {"generic/device.json /body/sleeps/value: unknown value 'nap'",
       [](json& j) {
         j["body"]["sleeps"] = {{"value", "nap"}, {"minutes", {{"5min", 5}}}};
       }},
      {"generic/device.json /body/sleeps/minutes: 'long' is not a choice of 'language'",
       [](json& j) {
         j["body"]["sleeps"] = {{"value", "language"}, {"minutes", {{"long", 5}}}};
       }},
      {"this event is never sent", [](json& j) { j["transitions"][0]["event"] = "nobody"; }},
  };
  for (const auto& wrong : kWrong) EXPECT_THAT(saysOf("generic", wrong.edit), HasSubstr(wrong.message));
}

TEST_F(BadDevice, ASharedTransitionThatNothingOnTheDeviceSendsIsLeftOut) {
  const auto type = edited("generic", [](json& j) {
    remove(named(j["screens"], "tools")["widgets"], "format");
    j["roles"]["off"] = nullptr;
  });
  ASSERT_TRUE(type) << describe(type.error());
  for (const auto& t : (*type)->program.transitions) {
    EXPECT_NE(t.event, "format");
    EXPECT_NE(t.event, EngineEvent::battery_empty) << "'off' is null: it ends in its own way";
  }
}

// A value that only the code asks for is not missed by any name in the file.
TEST_F(BadDevice, WhatTheCodeAsksForMayBeMissing) {
  const auto type = edited("leica-p-series", [](json& j) {
    for (const char* id : {"instrument_height", "min_intensity", "air_pressure"}) remove(j["values"], id);
  });
  ASSERT_TRUE(type) << describe(type.error());
  const Device d(*type);
  EXPECT_EQ(d.number("value.min_intensity"), 0);
}

TEST_F(BadDevice, WordsThatHoldThemselvesComeToAnEnd) {
  std::ofstream(folder_.path() / "x.json")
      << R"({"words": {"on": {"en": "{wlan}"}, "yes": {"en": "yes {wlan}"}, "wlan=yes": {"en": "it {wlan}"}}})";
  const auto words = Words::read(folder_.path());
  ASSERT_TRUE(words) << describe(words.error());
  const auto whole = *loadDevice(*findDevice("leica-rtc360"));
  const auto type =
      makeDeviceType(whole->definition, whole->program, whole->instrument, std::make_shared<const Words>(*words));
  ASSERT_TRUE(type);
  EXPECT_EQ(Device(*type).word("on"), "it {wlan}");
}

}  // namespace
}  // namespace standpoint
