// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "core/data_folder.h"
#include "emulated-ui/device/check.h"
#include "project/verb.h"
#include "survey/instruments.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

std::vector<Instrument> shippedInstruments() {
  auto all = readInstruments(dataFolder() / "scanners" / "instruments");
  EXPECT_TRUE(all) << describe(all.error());
  return all ? *std::move(all) : std::vector<Instrument>{};
}

class Generic : public testing::Test {
 protected:
  Generic() : d("generic") {}

  void ready() {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(30);
    ASSERT_EQ(d.screen(), "home");
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d->hand("plug_in"));
    ASSERT_TRUE(d.press({"project", "new_project", "name=House", "base=h_", "first=3", "create"}));
  }
  ScanOrder scan() {
    EXPECT_TRUE(d.screen() == "home" || d.press({"home"}));
    EXPECT_TRUE(d.press({"start_scan"}));
    const auto order = d.scanned();
    d->tick(d->fact("expected.seconds")->number.value() + 4);
    return order;
  }

  TestDevice d;
};

TEST(GenericDevice, DrivesEveryShippedScannerOnATripodWithAllItsSettings) {
  int driven = 0;
  for (const auto& instrument : shippedInstruments()) {
    const auto type = loadDevice(*findDevice("generic"), instrument.id);
    if (instrument.moving) {
      EXPECT_FALSE(type) << instrument.id << " needs a trajectory";
      continue;
    }
    ++driven;
    ASSERT_TRUE(type) << describe(type.error());
    for (const auto& fault : checkDevice(**type)) ADD_FAILURE() << instrument.id << ": " << describe(fault);
    TestDevice d("generic", instrument.id);
    ASSERT_TRUE(d.press({"power"}));
    d->tick(30);
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d.press({"project", "new_project", "create", "settings"}));
    const auto screen = d->screen();
    for (const auto& setting : instrument.settings) {
      const auto* widget = findWidget(screen, "setting." + setting.key);
      ASSERT_NE(widget, nullptr) << instrument.id << ' ' << setting.key;
      EXPECT_EQ(widget->options.size(), setting.choices.size());
    }
    ASSERT_TRUE(d.press({"back", "start_scan"}));
    EXPECT_EQ(d.scanned().instrument, instrument.id);
    d.settle();
    EXPECT_EQ(d.fact("setups"), "1") << instrument.id;
  }
  EXPECT_GE(driven, 15);
}

TEST(GenericDevice, DrivesAScannerOfTheUsersOwn) {
  for (auto instrument : shippedInstruments()) {
    if (instrument.id != "zf-imager-5016") continue;
    instrument.id = "my-scanner";
    instrument.maker = "Institute";
    instrument.model = "Breadboard";
    instrument.settings.push_back(
        {"back", "Lamp", "", {{"dim", "Dim", {}}, {"bright", "Bright", {{"noise_factor", 0.5}}}}, 0, 0, "dim"});
    auto definition = readDefinition(findDevice("generic")->folder() / "device.json");
    auto words = Words::read(dataFolder() / "emulated-ui" / "words");
    ASSERT_TRUE(definition && words);
    ASSERT_TRUE(words->add(findDevice("generic")->folder() / "words.json", "generic"));
    const auto type = makeDeviceType(*definition, findDevice("generic")->program(), instrument,
                                     std::make_shared<const Words>(*words));
    ASSERT_TRUE(type) << describe(type.error());
    Device device(*type);
    ASSERT_TRUE(device.act("power"));
    device.tick(30);
    ASSERT_TRUE(device.act("settings"));
    EXPECT_EQ(findWidget(device.screen(), "setting.back")->label, "Lamp") << "the label of its data sheet";
    const double noise = device.expected().noise_factor;
    ASSERT_TRUE(device.act("setting.back", "bright"));
    EXPECT_DOUBLE_EQ(device.expected().noise_factor, noise / 2);
    ASSERT_TRUE(device.act("back")) << "a setting of that name does not take the button's place";
    EXPECT_EQ(findWidget(device.screen(), "scanner")->value, "Institute Breadboard");
  }
}

TEST(GenericDevice, IsTheOneForScannersThatNoOtherDrives) {
  EXPECT_STREQ(deviceFor("zf-imager-5016").id, "generic");
  EXPECT_STREQ(deviceFor("my-scanner").id, "generic");
  EXPECT_STREQ(deviceFor("trimble-x9").id, "trimble-x7");
  EXPECT_STREQ(deviceFor("riegl-vz-400i").id, "riegl-vz-i");
}

TEST_F(Generic, ScansPhotographsStoresAndLinks) {
  ready();
  ASSERT_TRUE(d.press({"settings", "setting.images=on", "back", "start_scan"}));
  const auto order = d.scanned();
  EXPECT_EQ(order.name, "h_003");
  EXPECT_TRUE(order.panorama);
  EXPECT_TRUE(order.compensator);
  d->tick(d->fact("expected.scan")->number.value() + 1);
  EXPECT_EQ(d.phase(), "photographing");
  d->tick(d->fact("expected.imaging")->number.value());
  EXPECT_EQ(d.phase(), "storing");
  d->tick(3);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.screen(), "scan_view");
  EXPECT_FALSE(d->takeOrder()) << "there is nothing to link to yet";
  EXPECT_EQ(scan().name, "h_004");
  const auto link = d->takeOrder();
  ASSERT_TRUE(link && std::holds_alternative<LinkOrder>(*link));
  d->linkDone({true, 0.002, 0.6, 0, 0});
  EXPECT_EQ(d.dialog(), "link_joined");
}

TEST_F(Generic, RecomputesTimePointsSpacingAndSizeWithEverySetting) {
  ready();
  ASSERT_TRUE(d.press({"settings"}));
  const auto* setting = findWidget(d->screen(), "setting.resolution");
  ASSERT_NE(setting, nullptr);
  std::set<std::string> points, sizes, spacings;
  const auto options = findWidget(d->screen(), "setting.resolution")->options;
  for (const auto& option : options) {
    ASSERT_TRUE(d.press({"setting.resolution=" + option.value}));
    points.insert(d.shows("expected_points"));
    sizes.insert(d.shows("expected_size"));
    spacings.insert(d.shows("expected_spacing"));
  }
  EXPECT_EQ(points.size(), options.size());
  EXPECT_EQ(sizes.size(), options.size());
  EXPECT_EQ(spacings.size(), options.size());
  ASSERT_TRUE(d.press({"standard_settings", "setting.horizontal_to=90"}));
  const auto quarter = d->fact("expected.points")->number.value();
  ASSERT_TRUE(d.press({"area", "standard_area"}));
  EXPECT_NEAR(d->fact("expected.points")->number.value() / quarter, 4, 0.01);
}

TEST_F(Generic, RefusesOrAsksByTheRulesOfAllInstruments) {
  ready();
  const std::pair<const char*, const char*> kTroubles[] = {{"card_missing", "card_absent"},
                                                           {"card_locked", "card_locked"},
                                                           {"card_full", "card_full"},
                                                           {"too_cold", "temperature_question"},
                                                           {"not_warm", "not_warm_question"},
                                                           {"tilted", "tilt_question"},
                                                           {"too_near", ""}};
  for (const auto& [trouble, dialog] : kTroubles) {
    TestDevice one = d;
    ASSERT_TRUE(one->trouble(trouble));
    if (!one.dialog().empty()) {
      ASSERT_TRUE(one.press({"ok"}));
    }
    ASSERT_TRUE(one.press({"start_scan"}));
    EXPECT_EQ(one.dialog(), dialog) << trouble << ": this scanner measures from 0.3 m on";
  }
}

TEST_F(Generic, LeansWithItsCompensatorOffAndAsksNothing) {
  ready();
  ASSERT_TRUE(d->hand("tilt", "4,0"));
  ASSERT_TRUE(d.press({"settings", "compensator=off", "back", "start_scan"}));
  EXPECT_FALSE(d.scanned().compensator);
}

TEST_F(Generic, KeepsAPartWhenStopped) {
  ready();
  ASSERT_TRUE(d.press({"start_scan"}));
  d.scanned();
  d->tick(d->fact("expected.scan")->number.value() / 2);
  ASSERT_TRUE(d.press({"stop", "keep_partial"}));
  const auto order = d.scanned();
  EXPECT_NEAR(order.until_fraction, 0.5, 0.01);
  d->tick(10);
  EXPECT_EQ(d.fact("newest.partial"), "yes");
}

}  // namespace
}  // namespace standpoint
