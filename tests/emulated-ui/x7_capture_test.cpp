// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/x7.h"

namespace standpoint {
namespace {

// Spacings and times: section 1.4; range: section 1.1. 5712 x 2237 points of 23.8 bytes.
TEST_F(X7, ListsEachDurationWithItsSevenColumns) {
  ready();
  const auto screen = d->screen();
  const auto* modes = findWidget(screen, "mode_list");
  ASSERT_NE(modes, nullptr);
  ASSERT_EQ(modes->options.size(), 4U);
  EXPECT_EQ(modes->options[0].label, "Standard | 80 m | 12.8 M | 304.1 MB | 2:00 | 11.0 mm | 106 k/s");
  EXPECT_EQ(modes->options[3].label, "Standard | 80 m | 96.6 M | 2.3 GB | 15:00 | 4.0 mm | 107 k/s");
  ASSERT_TRUE(d.press({"mode_list=7min"}));
  EXPECT_EQ(d.shows("expected_time"), "7:00");
  EXPECT_EQ(d.shows("expected_points"), "43.0 M");
  EXPECT_EQ(d.shows("expected_spacing"), "6.0 mm");
}

TEST_F(X9, HasItsOwnListOfModes) {
  ready();
  EXPECT_EQ(findWidget(d->screen(), "mode_list")->options.size(), 2U);
  ASSERT_TRUE(d.press({"duration=2min"}));
  EXPECT_EQ(d.shows("expected_time"), "1:50") << "a full scan in under 2 minutes";
}

// 4, 7 and 15 minutes [G2]; their spacings are those of the Standard duration before [P].
TEST_F(X7, MeasuresLongerOnEachPointInHighSensitivity) {
  ready();
  ASSERT_TRUE(d.press({"duration=7min", "mode=high_sensitivity"}));
  EXPECT_EQ(d.fact("setting.duration"), "7min_high") << "the same time, with fewer points";
  EXPECT_EQ(d.shows("expected_time"), "7:00");
  EXPECT_NEAR(d->fact("expected.spacing")->number.value(), 9, 0.01);
  EXPECT_NEAR(d->fact("expected.noise")->number.value(), 0.7071, 1e-4);
  EXPECT_LT(d->expected().reference_reflectivity, 0.7);
  EXPECT_TRUE(d.refuses("duration", "2min")) << "it begins at four minutes";
  const auto screen = d->screen();
  EXPECT_EQ(findWidget(screen, "mode_list")->options.size(), 3U);
  EXPECT_EQ(findWidget(screen, "duration")->options.size(), 3U) << "those of the other mode are not there";
  ASSERT_TRUE(d.press({"mode=standard"}));
  EXPECT_EQ(d.fact("setting.duration"), "7min");
}

TEST_F(X7, TakesTimeForPicturesAndTwiceAsMuchWithHdr) {
  ready();
  EXPECT_TRUE(d.refuses("hdr", "on")) << "there are no pictures to bracket";
  ASSERT_TRUE(d.press({"images=fast"}));
  EXPECT_EQ(d.shows("expected_time"), "3:00");
  ASSERT_TRUE(d.press({"images=quality"}));
  EXPECT_EQ(d.shows("expected_time"), "4:00");
  ASSERT_TRUE(d.press({"hdr=on"}));
  EXPECT_EQ(d.shows("expected_time"), "6:00");
}

TEST_F(X7, RefusesToStartWithoutProjectPlaceStorageOrBattery) {
  start();
  ASSERT_TRUE(d.press({"connect"}));
  d->tick(5);
  ASSERT_TRUE(d.press({"create_new", "create", "scan_panel", "start_scan"}));
  EXPECT_EQ(d.dialog(), "no_station");
  ASSERT_TRUE(d.press({"ok"}));
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  const std::pair<const char*, const char*> kTroubles[] = {{"card_missing", "card_absent"},
                                                           {"card_locked", "card_locked"},
                                                           {"card_full", "card_full"},
                                                           {"battery_critical", "battery_critical"}};
  for (const auto& [trouble, dialog] : kTroubles) {
    TestDevice one = d;
    ASSERT_TRUE(one->trouble(trouble));
    if (!one.dialog().empty()) {
      ASSERT_TRUE(one.press({"ok"}));
    }
    ASSERT_TRUE(one.press({"start_scan"}));
    EXPECT_EQ(one.dialog(), dialog);
    EXPECT_EQ(one.phase(), "idle");
  }
  for (const char* trouble : {"too_hot", "not_warm", "too_near"}) {
    TestDevice one = d;
    ASSERT_TRUE(one->trouble(trouble));
    if (!one.dialog().empty()) {
      ASSERT_TRUE(one.press({"ok"}));
    }
    ASSERT_TRUE(one.press({"start_scan"}));
    EXPECT_TRUE(one.dialog().ends_with("_question")) << trouble;
    ASSERT_TRUE(one.press({"continue"}));
    EXPECT_EQ(one.phase(), "calibrating") << trouble;
  }
}

TEST_F(X7, CalibratesBeforeEveryScanThenLevelsScansPhotographsAndDownloads) {
  ready();
  ASSERT_TRUE(d.press({"images=fast"}));
  for (int scan = 0; scan < 2; ++scan) {
    ASSERT_TRUE(d.press({"start_scan"}));
    EXPECT_EQ(d.phase(), "calibrating");
    EXPECT_FALSE(d->takeOrder()) << "nothing is measured yet";
    d->tick(15);
    EXPECT_EQ(d.phase(), "levelling");
    d->tick(10);
    EXPECT_EQ(d.phase(), "scanning");
    const auto order = d.scanned();
    EXPECT_TRUE(order.compensator);
    EXPECT_TRUE(order.panorama);
    d->tick(120);
    EXPECT_EQ(d.phase(), "imaging");
    d->tick(60);
    EXPECT_EQ(d.phase(), "downloading");
    d->tick(120);
    if (scan == 1) {
      d->takeOrder();
      linked(0.002, 0.8);
    }
    ASSERT_EQ(d.phase(), "idle");
    ASSERT_TRUE(d.screen() != "station_view" || d.press({"map"}));
    ASSERT_TRUE(d.press({"scan_panel"}));
  }
  EXPECT_EQ(d.fact("newest.name"), "Station 002");
}

TEST_F(X7, ScansStraightAwayAndLeaningWithSelfLevellingOff) {
  ready();
  ASSERT_TRUE(d->hand("tilt", "3,0"));
  ASSERT_TRUE(d.press({"self_levelling=off", "start_scan"}));
  d->tick(15);
  EXPECT_EQ(d.phase(), "scanning");
  EXPECT_FALSE(d.scanned().compensator);
  d->tick(200);
  EXPECT_EQ(d.fact("newest.unlevelled"), "yes");
}

TEST_F(X7, LevelsWithinTenDegreesAsksBeyondAndRefusesBeyondFortyFive) {
  ready();
  const auto levelled = [&](const char* tilt) {
    TestDevice one = d;
    EXPECT_TRUE(one->hand("tilt", tilt));
    EXPECT_TRUE(one.press({"start_scan"}));
    one->tick(30);
    return one;
  };
  auto within = levelled("9.9,0");
  EXPECT_EQ(within.phase(), "scanning");
  EXPECT_TRUE(std::get<ScanOrder>(*within->takeOrder()).compensator);
  auto beyond = levelled("10.2,0");
  EXPECT_EQ(beyond.phase(), "not_level");
  EXPECT_EQ(beyond.dialog(), "not_level_question");
  TestDevice other = beyond;
  ASSERT_TRUE(beyond.press({"continue"}));
  EXPECT_EQ(beyond.phase(), "scanning");
  EXPECT_FALSE(std::get<ScanOrder>(*beyond->takeOrder()).compensator) << "not survey grade";
  ASSERT_TRUE(other.press({"cancel"}));
  EXPECT_EQ(other.phase(), "idle");
  EXPECT_EQ(levelled("44,0").phase(), "not_level");
  auto refused = levelled("46,0");
  EXPECT_EQ(refused.phase(), "idle");
  EXPECT_EQ(refused.dialog(), "tilt_refused");
}

TEST_F(X7, ShowsTheProgressOfEachStep) {
  ready();
  beginLaser();
  d->tick(55);  // 30 s went by of which 5 s are the laser's
  const auto screen = d->screen();
  const auto* steps = findWidget(screen, "step_list");
  ASSERT_NE(steps, nullptr);
  ASSERT_EQ(steps->options.size(), 6U);
  EXPECT_EQ(steps->options[0].label, "Calibration  100 %");
  EXPECT_EQ(steps->options[2].label, "Laser  50 %");
  EXPECT_EQ(steps->options[3].label, "Images  Off");
  EXPECT_EQ(steps->options[4].label, "Download  0 %");
}

TEST_F(X7, DownloadsWhileTheOperatorWalksToTheNextStation) {
  ready();
  beginLaser();
  d->tick(116);
  ASSERT_EQ(d.phase(), "downloading");
  EXPECT_NE(d.shows("walk_on"), "(not there)");
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.phase(), "downloading");
  d->tick(60);
  ASSERT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.screen(), "station_view");
  EXPECT_EQ(d.fact("shown.station"), "S1") << "where it was scanned, not where the tripod is now";
  EXPECT_EQ(d.fact("station"), "S2");
  EXPECT_FALSE(d->takeOrder()) << "a first station has nothing to be joined to";
}

TEST_F(X7, SpoilsTheScanWhenItIsCarriedWhileTheLaserTurns) {
  ready();
  beginLaser();
  EXPECT_FALSE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.phase(), "error");
  ASSERT_TRUE(d.press({"ok", "discard"}));
  EXPECT_EQ(d.fact("setups"), "0");
}

TEST_F(X7, MustStartAgainWhenItIsMovedBeforeTheLaser) {
  ready();
  ASSERT_TRUE(d.press({"start_scan"}));
  d->tick(18);
  ASSERT_TRUE(d->hand("tripod_moved"));
  EXPECT_EQ(d.dialog(), "moved_early");
  EXPECT_EQ(d.phase(), "idle");
}

TEST_F(X7, KeepsAnInterruptedDownloadOnTheCardUntilItIsFetched) {
  for (const bool by_import : {false, true}) {
    TestDevice first = d;
    ready();
    beginLaser();
    d->tick(116);
    ASSERT_EQ(d.phase(), "downloading");
    ASSERT_TRUE(d->trouble("wlan_lost"));
    EXPECT_EQ(d.dialog(), "download_interrupted");
    EXPECT_EQ(d.phase(), "interrupted");
    ASSERT_TRUE(d.press({"ok", "resume"}));
    EXPECT_EQ(d.dialog(), "no_connection");
    ASSERT_TRUE(d.press({"ok"}));
    if (by_import) {
      ASSERT_TRUE(d->hand("go_near"));
    } else {
      ASSERT_TRUE(d.press({"connection=cable"}));
    }
    ASSERT_TRUE(d.press({"resume"}));
    d->tick(60);
    EXPECT_EQ(d.fact("setups"), "1");
    d = first;
  }
}

TEST_F(X7, GoesOnScanningWhenTheTabletIsLost) {
  ready();
  beginLaser();
  ASSERT_TRUE(d->trouble("wlan_lost"));
  EXPECT_EQ(d.dialog(), "connection_lost");
  ASSERT_TRUE(d.press({"ok"}));
  EXPECT_EQ(d.phase(), "scanning");
  d->tick(120);
  EXPECT_EQ(d.phase(), "interrupted") << "the scan waits on the card";
}

TEST_F(X7, KeepsWhatIsOnTheCardWhenTheBatteryEndsInTheDownload) {
  ready();
  beginLaser();
  d->tick(116);
  ASSERT_EQ(d.phase(), "downloading");
  ASSERT_TRUE(d->hand("unplug"));
  ASSERT_TRUE(d->hand("change_battery"));
  EXPECT_EQ(d.phase(), "off");
  EXPECT_EQ(d.fact("setups.all"), "1");
}

TEST_F(X7, LosesTheRunningScanWithItsCardAndDiscardsAStoppedOne) {
  ready();
  beginLaser();
  TestDevice other = d;
  ASSERT_TRUE(d->hand("remove_card"));
  EXPECT_EQ(d.dialog(), "card_lost");
  EXPECT_EQ(d.phase(), "idle");
  ASSERT_TRUE(other.press({"stop", "yes"}));
  EXPECT_EQ(other.phase(), "idle");
  EXPECT_EQ(other.fact("setups"), "0");
}

TEST_F(X7, ScansAnAreaOnlyWhereAStationStands) {
  ready();
  EXPECT_TRUE(d.refuses("area_scan")) << "an area needs a parent station";
  scanAt("S1");
  ASSERT_TRUE(d.press({"map", "scan_panel", "area_scan"}));
  EXPECT_EQ(d.shows("parent"), "Station 001");
  ASSERT_TRUE(d.press({"start_h=350", "delta_h=20", "start_v=60", "delta_v=45", "take_area"}));
  EXPECT_EQ(d.fact("setting.horizontal_to"), "10");
  EXPECT_EQ(d.fact("setting.vertical_from"), "-15") << "counted from the zenith";
  EXPECT_EQ(d.fact("setting.vertical_to"), "30");
  EXPECT_EQ(d.shows("expected_time"), "0:07") << "120 s x 20 / 360";
  TestDevice elsewhere = d;
  ASSERT_TRUE(elsewhere->hand("stand_at", "S9"));
  ASSERT_TRUE(elsewhere.press({"back", "start_scan"}));
  EXPECT_EQ(elsewhere.dialog(), "area_needs_parent");
  ASSERT_TRUE(d.press({"back"}));
  const auto order = beginLaser();
  EXPECT_EQ(order.name, "Area 002");
  d->tick(100);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_FALSE(d->takeOrder()) << "it stands where its parent does";
  EXPECT_EQ(d.fact("registration"), "applied");
}

TEST_F(X7, RefusesAnAreaBeyondItsField) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(
      d.press({"map", "scan_panel", "area_scan", "start_h=0", "delta_h=90", "start_v=100", "delta_v=60", "take_area"}));
  EXPECT_EQ(d.dialog(), "refused") << "160 degrees from the zenith";
  EXPECT_EQ(d.fact("setting.field_of_view"), "full_dome");
}

}  // namespace
}  // namespace standpoint
