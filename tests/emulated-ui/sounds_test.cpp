// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include <gtest/gtest.h>

#include "support.h"

namespace standpoint {
namespace {

std::string heard(TestDevice& device, std::uint64_t since) {
  const auto* sound = soundSince(*device, since);
  return sound == nullptr ? "" : sound->id;
}

class Sounds : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(Sounds, OfAPressAndOfAPassedTroubleCanBeToldApart) {
  TestDevice device(GetParam()->id);
  device->change().log.clear();
  device->note("pressed", "home/scan");
  EXPECT_EQ(heard(device, 0), "key");
  device->note("dialog", "no_project");
  EXPECT_EQ(heard(device, 0), "question") << "of both, the one that stands later in the file";
  device->note("trouble", "battery_low");
  EXPECT_EQ(heard(device, 0), "battery");
  EXPECT_EQ(heard(device, 3), "") << "all of it was heard";
  device->note("dialog", "refused");
  EXPECT_EQ(heard(device, 3), "refusal") << "a dialogue with a sound of its own";
  device->note("setting", "resolution=6mm");
  EXPECT_EQ(heard(device, 4), "") << "nothing sounds for that";
}

TEST_P(Sounds, AreThereForWhatSomebodyWhoLooksAwayWaitsFor) {
  const auto device = loadDevice(*GetParam()).value();
  std::set<std::string> ids;
  for (const auto& row : device->definition.sounds.rows) ids.insert(row.id);
  for (const char* id : {"key", "switched_on", "scan_begins", "scan_stored", "question", "refusal", "battery"})
    EXPECT_TRUE(ids.contains(id)) << id;
}

INSTANTIATE_TEST_SUITE_P(Devices, Sounds, testing::ValuesIn(everyDevice()), deviceName);

TEST(SoundSwitch, OfTheDeviceItselfSilencesIt) {
  for (const auto& [id, value] : {std::pair{"leica-rtc360", "beep"}, {"faro-focus", "sound"}}) {
    TestDevice device(id);
    const auto before = device->state().noted;
    device->note("pressed", "home/scan");
    EXPECT_EQ(heard(device, before), "key") << id;
    device->change().values[value] = "off";
    EXPECT_EQ(heard(device, before), "") << id;
  }
}

TEST(SoundOfAScan, BeginsWithItAndEndsWithItsStoring) {
  TestDevice device("generic");
  const auto after = [&](auto does) {
    const auto before = device->state().noted;
    does();
    return heard(device, before);
  };
  EXPECT_EQ(after([&] { EXPECT_TRUE(device.press({"power"})); }), "switched_on");
  device.settle();
  (void)device->hand("stand_at", "S1");
  const auto started = after([&] {
    EXPECT_TRUE(device.press({"project", "new_project", "create"})) << device.screen();
    EXPECT_TRUE(device.screen() == "home" || device.press({"home"}));
    EXPECT_TRUE(device.press({"start_scan"})) << device.screen();
  });
  EXPECT_EQ(started, "scan_begins") << device.phase() << " " << device.dialog();
  EXPECT_EQ(after([&] {
              device.scanned();
              device.settle();
            }),
            "scan_stored");
}

}  // namespace
}  // namespace standpoint
