// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/units.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

class Focus : public testing::Test {
 protected:
  Focus() : d("faro-focus") {}
  void start() {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(150);
    ASSERT_EQ(d.screen(), "home");
  }
  void ready() {
    start();
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d.press({"manage", "scan_projects", "new_project", "name=House", "base=house_", "create"}));
  }
  static SettingValues withSettingOf(const std::string& resolution, const std::string& quality) {
    return {{"resolution", resolution}, {"quality", quality}};
  }
  TestDevice d;
};

// The display that was photographed: 1/4, 3x, no colour [S7].
TEST_F(Focus, ShowsTheRowOfTheRealDisplay) {
  start();
  ASSERT_TRUE(d.press({"parameters", "resolution_quality", "resolution=1/4", "quality=3x", "back", "colour=off"}));
  EXPECT_EQ(d.shows("scan_duration"), "4:34");
  EXPECT_EQ(d.shows("million_points"), "43.7 M");
  EXPECT_EQ(d.shows("file_size"), "136.4 MB");
  EXPECT_EQ(d.fact("expected.spacing").substr(0, 5), "6.135");
  EXPECT_EQ(d.shows("scan_size"), "10310 × 4268");
}

// Lowest quality by the mirror's limit: 1x for 1/1 to 1/4, 2x for 1/5 and 1/8, 3x for 1/10 and 1/16, 4x below.
TEST_F(Focus, GreysOutWhatTheMirrorCannotTurn) {
  start();
  const std::pair<const char*, const char*> kLowest[] = {{"1/1", "1x"},  {"1/2", "1x"},  {"1/4", "1x"},
                                                         {"1/5", "2x"},  {"1/8", "2x"},  {"1/10", "3x"},
                                                         {"1/16", "3x"}, {"1/20", "4x"}, {"1/32", "4x"}};
  ASSERT_TRUE(d.press({"parameters", "resolution_quality"}));
  for (const auto& [resolution, lowest] : kLowest) {
    auto wanted = withSettingOf(resolution, lowest);
    EXPECT_TRUE(d->setSettings(wanted)) << resolution << ' ' << lowest;
    if (std::string(lowest) == "1x") continue;
    const std::string below = std::to_string(lowest[0] - '0' - 1) + "x";
    EXPECT_FALSE(d->setSettings(withSettingOf(resolution, below))) << resolution << ' ' << below;
    const auto screen = d->screen();
    for (const auto& option : findWidget(screen, "quality")->options)
      EXPECT_EQ(option.enabled, option.value >= lowest)
          << resolution << ' ' << option.value << ": a quality does not change the resolution";
  }
}

// Noise compression needs a finer grid: 6x from 1/2 down, 8x from 1/4 down [G2].
TEST_F(Focus, OffersNoiseCompressionWhereAFinerGridIsLeft) {
  start();
  ASSERT_TRUE(d.press({"parameters", "resolution_quality", "resolution=1/1"}));
  EXPECT_TRUE(d.refuses("quality", "6x"));
  ASSERT_TRUE(d.press({"resolution=1/2", "quality=6x"}));
  EXPECT_TRUE(d.refuses("quality", "8x"));
  ASSERT_TRUE(d.press({"resolution=1/4", "quality=4x"}));
  const auto points = d.shows("million_points");
  EXPECT_EQ(d.shows("scan_duration"), "8:10");
  ASSERT_TRUE(d.press({"quality=8x"}));
  EXPECT_EQ(d.fact("expected.noise"), "0.25");
  EXPECT_EQ(d.shows("scan_duration"), "29:48") << "an assumption: each step doubles the time";
  EXPECT_EQ(d.shows("million_points"), points) << "a quality changes no points";
  ASSERT_TRUE(d.press({"resolution=1/1"}));
  EXPECT_EQ(d.fact("setting.quality"), "4x");
}

TEST_F(Focus, BracketsItsPicturesWithHdr) {
  start();
  ASSERT_TRUE(d.press({"parameters", "colour=on", "colour_settings"}));
  EXPECT_FALSE(d->expected().camera.hdr);
  EXPECT_EQ(d->expected().imaging_seconds, 60);
  for (const auto& [hdr, seconds] : {std::pair{"2x", 120}, std::pair{"3x", 180}, std::pair{"5x", 240}}) {
    ASSERT_TRUE(d.press({std::string("hdr=") + hdr}));
    EXPECT_TRUE(d->expected().camera.hdr) << hdr;
    EXPECT_EQ(d->expected().imaging_seconds, seconds) << hdr;
  }
  ASSERT_TRUE(d.press({"back", "colour=off"}));
  EXPECT_EQ(d->expected().imaging_seconds, 0);
}

TEST_F(Focus, WritesCustomerAndFacilityIntoTheRecord) {
  start();
  ASSERT_TRUE(
      d.press({"manage", "scan_projects", "new_project", "name=House", "customer=Ada", "facility=Mill", "create"}));
  EXPECT_EQ(d->project()->note, "Ada, Mill");
}

TEST_F(Focus, ManagesProfilesSensorsAndWlan) {
  start();
  EXPECT_EQ(d.shows("wlan_status"), "(not there)");
  ASSERT_TRUE(d.press({"manage", "wlan=on", "profile", "back", "sensors", "back", "back"}));
  EXPECT_EQ(d.shows("wlan_status"), "") << "the word WLAN";
  ASSERT_TRUE(d.press({"manage", "card_page"}));
  EXPECT_EQ(d.shows("address"), "192.168.43.1");
  ASSERT_TRUE(d.press({"back", "back"}));
  EXPECT_EQ(d.shows("mains_status"), "No");
}

TEST_F(Focus, ResetsItsParameters) {
  start();
  ASSERT_TRUE(d.press({"parameters", "resolution_quality", "resolution=1/20", "back", "back", "manage", "service",
                       "standard_settings"}));
  EXPECT_EQ(d.fact("setting.resolution"), "1/4");
}

TEST_F(Focus, MovesTheQualityWhenAResolutionNeedsIt) {
  start();
  ASSERT_TRUE(d.press({"parameters", "resolution_quality", "resolution=1/1", "quality=1x", "resolution=1/20"}));
  EXPECT_EQ(d.fact("setting.quality"), "4x");
}

TEST_F(Focus, SaysInTheDevicesLanguageWhatAPressMovedBesides) {
  start();
  ASSERT_TRUE(d.press({"parameters", "resolution_quality", "resolution=1/4", "quality=3x", "resolution=1/20"}));
  EXPECT_EQ(d->state().moved_along, "Quality changed from 3x to 4x: 1/20 does not allow 3x.");
  ASSERT_TRUE(d.press({"resolution=1/4"}));
  EXPECT_EQ(d->state().moved_along, "") << "nothing but what was pressed";
  d->change().language = "de";
  ASSERT_TRUE(d.press({"resolution=1/4", "quality=2x", "resolution=1/16"}));
  EXPECT_EQ(d->state().moved_along, "Qualität von 2x auf 3x geändert: 1/16 lässt 2x nicht zu.");
}

TEST_F(Focus, SaysOnAndOffInTheDevicesLanguage) {
  start();
  ASSERT_TRUE(d.press({"parameters", "colour=off"}));
  EXPECT_EQ(d.shows("colour"), "Off");
  d->change().language = "de";
  EXPECT_EQ(d.shows("colour"), "Aus");
}

TEST_F(Focus, SpinsUpScansPhotographsAndSavesUnderItsBaseName) {
  ready();
  ASSERT_TRUE(d.press({"parameters", "colour=on", "back", "start_scan"}));
  EXPECT_EQ(d.phase(), "spin_up");
  const auto order = d.scanned();
  EXPECT_EQ(order.name, "house_001");
  d->tick(9.5);
  EXPECT_EQ(d.phase(), "scanning");
  d->tick(d->fact("expected.sweep")->number.value());
  EXPECT_EQ(d.phase(), "photographing");
  d->tick(60);
  EXPECT_EQ(d.phase(), "saving");
  d->tick(60);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.screen(), "scan_view");
  EXPECT_EQ(d.shows("scan_name"), "house_001");
}

TEST_F(Focus, PausesAndGoesOnWhereItWas) {
  ready();
  ASSERT_TRUE(d.press({"start_scan"}));
  d.scanned();
  d->tick(9 + 100);
  ASSERT_TRUE(d.press({"pause"}));
  d->tick(500);
  ASSERT_TRUE(d.press({"resume"}));
  EXPECT_NEAR(d->state().elapsed_s, 100, 1e-9);
  d.settle();
  EXPECT_EQ(d.fact("setups"), "1");
}

TEST_F(Focus, KeepsOrDropsThePartOfAStoppedScan) {
  ready();
  ASSERT_TRUE(d.press({"start_scan"}));
  ASSERT_TRUE(d->takeOrder());
  d->tick(9 + 108);
  TestDevice dropped = d;
  ASSERT_TRUE(d.press({"stop", "keep_partial"}));
  const auto order = d.scanned();
  EXPECT_LT(order.until_fraction, 0.6);
  d.settle();
  EXPECT_EQ(d.fact("newest.partial"), "yes");
  ASSERT_TRUE(dropped.press({"stop", "discard"}));
  EXPECT_EQ(dropped.fact("setups"), "0");
}

TEST_F(Focus, AsksBeyondTwoDegreesAndStoresUnlevelledBeyondFive) {
  ready();
  ASSERT_TRUE(d->hand("tilt", "3,0"));
  ASSERT_TRUE(d.press({"start_scan"}));
  EXPECT_EQ(d.dialog(), "tilt_question");
  ASSERT_TRUE(d.press({"continue"}));
  EXPECT_TRUE(d.scanned().compensator);
  d.settle();
  ASSERT_TRUE(d->hand("tilt", "6,0"));
  ASSERT_TRUE(d.press({"home", "start_scan", "continue"}));
  EXPECT_FALSE(d.scanned().compensator);
  d.settle();
  EXPECT_EQ(d.fact("newest.unlevelled"), "yes");
}

TEST_F(Focus, WithTheInclinometerOffTheScanLeans) {
  ready();
  ASSERT_TRUE(d.press({"parameters", "sensors", "inclinometer=off", "back", "back", "start_scan"}));
  EXPECT_FALSE(d.scanned().compensator);
}

TEST_F(Focus, KeepsAPartialScanWhenTheBatteryBecomesCritical) {
  ready();
  ASSERT_TRUE(d.press({"start_scan"}));
  d->tick(60);
  ASSERT_TRUE(d->trouble("battery_critical"));
  EXPECT_EQ(d.phase(), "saving");
  EXPECT_EQ(d.dialog(), "battery_critical");
}

TEST_F(Focus, CarriedAwayWhileItPhotographsIsTheSameTroubleAsWhileItScans) {
  ready();
  ASSERT_TRUE(d.press({"parameters", "colour=on", "back", "start_scan"}));
  d.scanned();
  d->tick(9 + d->fact("expected.sweep")->number.value());
  ASSERT_EQ(d.phase(), "photographing");
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.phase(), "error");
  EXPECT_EQ(d.dialog(), "tripod_moved");
  ASSERT_TRUE(d.press({"ok", "keep"}));
  EXPECT_TRUE(d.scanned().tripod_moved_at_fraction.has_value());
  d.settle();
  EXPECT_EQ(d.fact("newest.tripod_moved"), "yes");
  EXPECT_EQ(d->newestSetup()->station, "S1");
}

TEST_F(Focus, UsesMarksAndKeepsProfiles) {
  start();
  ASSERT_TRUE(d.press({"parameters", "profile", "profile_list=Outdoor ...20 m"}));
  EXPECT_EQ(d.fact("setting.resolution"), "1/5");
  EXPECT_EQ(d.shows("profile"), "Outdoor ...20 m");
  ASSERT_TRUE(d.press({"resolution_quality", "resolution=1/8", "back"}));
  EXPECT_EQ(d.shows("profile"), "Outdoor ...20 m *");
  ASSERT_TRUE(d.press({"profile", "profile_name=Preview", "save_profile"}));
  EXPECT_EQ(d.dialog(), "refused");
  ASSERT_TRUE(
      d.press({"ok", "profile_name=Mine", "save_profile", "profile_list=Preview", "profile", "profile_list=Mine"}));
  EXPECT_EQ(d.fact("setting.resolution"), "1/8");
  ASSERT_TRUE(d.press({"profile", "delete_profile"}));
  EXPECT_TRUE(d.refuses("profile_list", "Mine"));
}

TEST_F(Focus, ScansAnObjectInAReducedArea) {
  start();
  ASSERT_TRUE(d.press({"parameters", "profile", "profile_list=Object HD"}));
  const auto& part = d->expected();
  EXPECT_NEAR((part.azimuth_to_rad - part.azimuth_from_rad) / kRadPerDeg, 90, 1e-9);
  EXPECT_NEAR((part.elevation_to_rad - part.elevation_from_rad) / kRadPerDeg, 90, 1e-9);
  ASSERT_TRUE(d.press({"profile", "profile_list=Preview"}));
  EXPECT_EQ(d.fact("setting.horizontal_from"), "0") << "the others have the whole";
}

TEST_F(Focus, TakesAnglesFromTheTurnedHead) {
  start();
  ASSERT_TRUE(d.press({"parameters", "scan_area", "head=90", "from_head", "head=180", "to_head"}));
  EXPECT_EQ(d.fact("setting.horizontal_from"), "90");
  EXPECT_EQ(d.fact("setting.horizontal_to"), "180");
  const auto quarter = d->fact("expected.sweep")->number.value();
  ASSERT_TRUE(d.press({"default_area"}));
  EXPECT_NEAR(d->fact("expected.sweep")->number.value() / quarter, 4, 0.01);
}

TEST_F(Focus, M70DiffersByItsDataSheet) {
  TestDevice m("faro-focus", "faro-focus-m70");
  ASSERT_TRUE(m.press({"power"}));
  m->tick(150);
  ASSERT_TRUE(m.press({"parameters", "resolution_quality"}));
  EXPECT_TRUE(m.refuses("quality", "1x")) << "its rate ends at 488 kHz";
}

}  // namespace
}  // namespace standpoint
