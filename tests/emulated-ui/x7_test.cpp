// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>

#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

// Transitions and rules: instrument facts, section 2.5.
class X7 : public testing::Test {
 protected:
  explicit X7(const std::string& instrument = {}) : d("trimble-x7", instrument) {}

  void start() {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(60);
    ASSERT_EQ(d.screen(), "start");
  }
  // On, connected, with a project, standing at S1, quick settings, on the scan panel.
  void ready(const std::string& project = "House") {
    start();
    ASSERT_TRUE(d.press({"connect"}));
    d->tick(10);
    ASSERT_EQ(d.phase(), "idle");
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d->hand("plug_in"));
    ASSERT_TRUE(d.press({"create_new", "name=" + project, "create", "scan_panel", "images=off"}));
  }
  // Until the laser turns.
  ScanOrder beginLaser() {
    EXPECT_TRUE(d.press({"start_scan"}));
    d->tick(30);
    EXPECT_EQ(d.phase(), "scanning");
    return d.scanned();
  }
  void scanAt(const std::string& station) {
    ASSERT_TRUE(d->hand("stand_at", station));
    const auto home = d.screen() == "station_view" ? "map" : d.screen() == "registration" ? "back" : "";
    ASSERT_TRUE(*home == '\0' || d.press({home}));
    ASSERT_TRUE(d.screen() != "map_view" || d.press({"scan_panel"}));
    beginLaser();
    d->tick(200);
  }
  // Two stations, the second of which is waiting for its link.
  LinkOrder secondStation() {
    scanAt("S1");
    EXPECT_EQ(d.phase(), "idle");
    scanAt("S2");
    EXPECT_EQ(d.phase(), "registering");
    const auto order = d->takeOrder();
    EXPECT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
    return order && std::holds_alternative<LinkOrder>(*order) ? std::get<LinkOrder>(*order) : LinkOrder{};
  }
  void linked(double error_m, double overlap, bool joined = true) {
    d->linkDone({joined, error_m, overlap, 0, 0});
    d->tick(20);
    d->tick(1);
  }

  TestDevice d;
};

class X9 : public X7 {
 protected:
  X9() : X7("trimble-x9") {}
};

TEST_F(X7, StartsWithoutItsScannerAndShowsThatItIsNotConnected) {
  start();
  EXPECT_EQ(d.phase(), "disconnected");
  EXPECT_EQ(d.shows("connected"), "not connected");
  ASSERT_TRUE(d.press({"create_new", "create"}));
  EXPECT_EQ(d.screen(), "map_view") << "after Create the Map View opens";
  EXPECT_EQ(d.shows("connected"), "not connected") << "with the red icon";
  ASSERT_TRUE(d.press({"scan_panel"}));
  EXPECT_TRUE(d.refuses("start_scan"));
}

TEST_F(X7, ConnectsByWlanOrByCable) {
  start();
  ASSERT_TRUE(d->trouble("wlan_lost"));
  ASSERT_TRUE(d.press({"connect"}));
  EXPECT_EQ(d.dialog(), "no_connection");
  ASSERT_TRUE(d.press({"ok", "connection=cable", "connect"}));
  d->tick(5);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.shows("connected"), "connected") << "the icon goes";
  ASSERT_TRUE(d.press({"create_new", "create", "status", "disconnect"}));
  EXPECT_EQ(d.phase(), "disconnected");
  ASSERT_TRUE(d.press({"connection=wlan"}));
  ASSERT_TRUE(d->hand("go_near"));
  ASSERT_TRUE(d.press({"connect"}));
  d->tick(5);
  EXPECT_EQ(d.phase(), "idle");
}

TEST_F(X7, KeepsCreateGreyUntilTheStartIndexIsValid) {
  start();
  ASSERT_TRUE(d.press({"create_new"}));
  EXPECT_EQ(d.shows("first"), "1");
  for (const char* wrong : {"0", "1.5"}) {
    ASSERT_TRUE(d.press({std::string("first=") + wrong}));
    EXPECT_TRUE(d.refuses("create")) << wrong;
  }
  EXPECT_TRUE(d.refuses("first", "1000000"));
  EXPECT_TRUE(d.refuses("first", "-3"));
  for (const char* good : {"999999", "1", "17"}) {
    TestDevice one = d;
    ASSERT_TRUE(one.press({std::string("first=") + good, "create"}));
    EXPECT_EQ(one.shows("next_station"), good);
  }
}

TEST_F(X7, FixesTheStartIndexWithCreate) {
  start();
  ASSERT_TRUE(d.press({"create_new", "first=40", "create"}));
  for (const char* away : {"menu", "all_projects", "project_list=0", "scan_panel"}) {
    EXPECT_TRUE(d.refuses("first", "7")) << d.screen();
    ASSERT_TRUE(d.press({away}));
  }
  EXPECT_EQ(d.fact("project.first"), "40");
}

TEST_F(X7, TakesAStandardNameForAnEmptyOneAndRefusesForbiddenCharacters) {
  start();
  ASSERT_TRUE(d.press({"create_new"}));
  for (const char* sign : {"\\", "/", ":", "*", "?", "\"", "<", ">", "|"}) {
    TestDevice one = d;
    ASSERT_TRUE(one.press({std::string("name=House ") + sign + " 2", "create"}));
    EXPECT_EQ(one.dialog(), "refused") << sign;
    EXPECT_EQ(one.fact("projects"), "0");
  }
  ASSERT_TRUE(d.press({"name=", "first=12", "create"}));
  EXPECT_EQ(d.shows("project"), "Project 001");
  EXPECT_EQ(d.shows("next_station"), "12") << "what was typed stays";
}

TEST_F(X7, DescribesAProjectWithTimeAndUser) {
  start();
  ASSERT_TRUE(d.press({"options", "operator=Olena", "back", "create_new"}));
  EXPECT_EQ(d.shows("note"), "1:00, Olena");
}

// Spacings and times: section 1.4; range: section 1.1. 5712 x 2237 points of 26 bytes.
TEST_F(X7, ListsEachDurationWithItsSevenColumns) {
  ready();
  const auto screen = d->screen();
  const auto* modes = findWidget(screen, "mode_list");
  ASSERT_NE(modes, nullptr);
  ASSERT_EQ(modes->options.size(), 4U);
  EXPECT_EQ(modes->options[0].label, "Standard | 80 m | 12.8 M | 332.2 MB | 2:00 | 11.0 mm | 106 k/s");
  EXPECT_EQ(modes->options[3].label, "Standard | 80 m | 96.6 M | 2.5 GB | 15:00 | 4.0 mm | 107 k/s");
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

TEST_F(X7, OffersNoHighSensitivityBecauseItsSpacingsAreNotKnown) {
  ready();
  EXPECT_TRUE(d.refuses("mode", "high_sensitivity"));
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
  ASSERT_TRUE(d->hand("push"));
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

TEST_F(X7, RegistersEachNewStationWithTheOneBefore) {
  ready();
  const auto order = secondStation();
  EXPECT_EQ(order.from_file, "scans/House/Station 002.e57");
  EXPECT_EQ(order.to_file, "scans/House/Station 001.e57");
  EXPECT_EQ(order.turn_deg, 0);
  d->tick(60);
  EXPECT_EQ(d.phase(), "registering") << "it waits for the fit";
}

// [S14]: good links have a confidence of about 99, a consistency of 100 and an overlap of 73 to 88 %.
TEST_F(X7, MakesAStationGreenFromAConfidenceOf91On) {
  ready();
  secondStation();
  linked(0.002, 0.8);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.fact("registration"), "registered");
  EXPECT_GE(d->fact("confidence")->number.value(), 99);
  EXPECT_GE(d->fact("consistency")->number.value(), 99.5);
  EXPECT_TRUE(d.dialog().empty());
  EXPECT_EQ(d.screen(), "map_view");
}

// 6 mm: 100 / (1 + 0.6^4) = 88.5; full overlap takes nothing.
TEST_F(X7, MakesAStationAmberBetween73And91) {
  ready();
  secondStation();
  linked(0.006, 0.9);
  EXPECT_EQ(d.fact("registration"), "check");
  EXPECT_NEAR(d->fact("confidence")->number.value(), 88.5, 0.1);
  EXPECT_EQ(d.dialog(), "check_by_eye");
  ASSERT_TRUE(d.press({"ok"}));
  const auto screen = d->screen();
  const auto* links = findWidget(screen, "link_list");
  ASSERT_NE(links, nullptr);
  ASSERT_TRUE(d.press({"link_list=" + links->options.back().value}));
  TestDevice other = d;
  ASSERT_TRUE(d.press({"apply"}));
  EXPECT_EQ(d.fact("registration"), "applied");
  EXPECT_EQ(d.fact("stations.registered"), "2");
  ASSERT_TRUE(other.press({"reject"}));
  EXPECT_EQ(other.fact("registration"), "rejected");
  EXPECT_EQ(other.fact("stations.registered"), "1");
}

// An overlap of 20 % takes exp(-1) = 37 %.
TEST_F(X7, DoesNotRegisterBelow73) {
  ready();
  secondStation();
  TestDevice other = d;
  linked(0.002, 0.2);
  EXPECT_EQ(d.fact("registration"), "failed");
  EXPECT_NEAR(d->fact("confidence")->number.value(), 63.1, 0.15);
  EXPECT_EQ(d.dialog(), "not_registered");
  ASSERT_TRUE(d.press({"ok"}));
  EXPECT_TRUE(d.refuses("apply"));
  d = other;
  linked(0, 0, false);
  EXPECT_EQ(d.fact("registration"), "failed") << "nothing in common";
}

TEST_F(X7, TheLimitsAre73And91) {
  // Overlap 1: the confidence is the consistency, 100 / (1 + x^4) with x = error / 10 mm.
  const auto errorFor = [](double confidence) { return 0.010 * std::pow(100 / confidence - 1, 0.25); };
  ready();
  secondStation();
  const std::pair<double, const char*> kCases[] = {
      {91.01, "registered"}, {90.99, "check"}, {73.01, "check"}, {72.99, "failed"}};
  const TestDevice waiting = d;
  for (const auto& [confidence, state] : kCases) {
    d = waiting;
    linked(errorFor(confidence), 1);
    EXPECT_EQ(d.fact("registration"), state) << confidence;
  }
}

TEST_F(X7, RefusesALinkWhenTheTiltsDifferByFiveDegrees) {
  for (const auto& [tilt, state] : {std::pair{"4.9,0", "registered"}, std::pair{"5,0", "failed"}}) {
    const TestDevice fresh = d;
    ready();
    ASSERT_TRUE(d.press({"self_levelling=off"}));
    beginLaser();
    d->tick(200);
    ASSERT_TRUE(d->hand("stand_at", "S2"));
    ASSERT_TRUE(d->hand("tilt", tilt));
    ASSERT_TRUE(d.press({"map", "scan_panel"}));
    beginLaser();
    d->tick(200);
    d->takeOrder();
    linked(0.001, 0.9);
    EXPECT_EQ(d.fact("registration"), state) << tilt;
    EXPECT_EQ(d.dialog(), state == std::string("failed") ? "tilt_difference" : "");
    d = fresh;
  }
}

TEST_F(X7, LevelledStationsMayStandAsTheyLike) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d->hand("tilt", "8,0"));
  scanAt("S2");
  d->takeOrder();
  linked(0.001, 0.9);
  EXPECT_EQ(d.fact("registration"), "registered");
}

TEST_F(X7, RefinesFromWhereTheCloudWasLaidByHand) {
  ready();
  secondStation();
  linked(0.009, 0.1);
  ASSERT_TRUE(d.press({"ok", "shift_x=1.5", "shift_y=-0.4", "turn=180", "refine"}));
  EXPECT_EQ(d.phase(), "refining");
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
  const auto link = std::get<LinkOrder>(*order);
  EXPECT_EQ(link.shift_x_m, 1.5);
  EXPECT_EQ(link.shift_y_m, -0.4);
  EXPECT_EQ(link.turn_deg, 180);
  linked(0.0015, 0.8);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.screen(), "registration");
  EXPECT_EQ(d.fact("registration"), "registered");
  EXPECT_EQ(d.fact("value.turn"), "0") << "it has been laid";
}

TEST_F(X7, MayTakeAWrongMatchInASymmetricalRoomForAGoodOne) {
  ready();
  secondStation();
  d->linkDone({true, 0.0015, 0.85, 6.0, 180.0});  // the room turned round: only the simulation knows
  d->tick(20);
  EXPECT_EQ(d.fact("registration"), "registered");
  ASSERT_TRUE(d.press({"registration", "reject"}));
  EXPECT_EQ(d.fact("registration"), "rejected") << "the eye of the operator is the last check";
}

TEST_F(X7, ASymmetricalRoomTurnsTheStartOfEveryLinkByHalfATurn) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d->trouble("symmetrical_room"));
  scanAt("S2");
  const auto automatic = d->takeOrder();
  ASSERT_TRUE(automatic && std::holds_alternative<LinkOrder>(*automatic));
  EXPECT_EQ(std::get<LinkOrder>(*automatic).turn_deg, 180);
  linked(0.0015, 0.85);
  ASSERT_TRUE(d.press({"registration", "turn=-170", "refine"}));   // laid back by hand, ten degrees short
  const auto refined = d->takeOrder();
  ASSERT_TRUE(refined && std::holds_alternative<LinkOrder>(*refined));
  EXPECT_EQ(std::get<LinkOrder>(*refined).turn_deg, 10);
}

TEST_F(X7, RefinesAllLinksOneAfterTheOther) {
  ready();
  secondStation();
  linked(0.002, 0.8);
  scanAt("S3");
  d->takeOrder();
  linked(0.002, 0.8);
  ASSERT_TRUE(d.press({"registration", "refine_all"}));
  for (const char* file : {"scans/House/Station 002.e57", "scans/House/Station 003.e57"}) {
    const auto order = d->takeOrder();
    ASSERT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
    EXPECT_EQ(std::get<LinkOrder>(*order).from_file, file);
    linked(0.001, 0.7);
  }
  EXPECT_EQ(d.phase(), "idle");
  ASSERT_TRUE(d.press({"report"}));
  EXPECT_EQ(d.shows("registered_stations"), "3 / 3");
  EXPECT_EQ(d.shows("worst_error"), "1.0 mm");
  EXPECT_EQ(findWidget(d->screen(), "report_list")->options.size(), 2U);
}

TEST_F(X7, StoresWithoutALinkWhenAutoRegistrationIsOff) {
  ready();
  ASSERT_TRUE(d.press({"auto_registration=off"}));
  scanAt("S1");
  scanAt("S2");
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_FALSE(d->takeOrder());
  EXPECT_EQ(d.fact("registration"), "none");
  ASSERT_TRUE(d.press({"map", "registration", "refine"}));
  EXPECT_TRUE(std::holds_alternative<LinkOrder>(*d->takeOrder()));
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

TEST_F(X7, ShowsAllTheLatestOrTheNearestStations) {
  std::vector<StoredSetup> stored;
  for (int i = 1; i <= 7; ++i) {
    StoredSetup s;
    s.project = "House";
    s.number = i;
    s.name = "Station 00" + std::to_string(i);
    s.file = s.name;
    s.plan_x_m = i == 1 ? 7.5 : i;
    stored.push_back(s);
  }
  d->load(stored);
  start();
  ASSERT_TRUE(d.press({"all_projects", "project_list=0"}));
  const auto rows = [&] { return findWidget(d->screen(), "station_list")->options; };
  EXPECT_EQ(rows().size(), 7U);
  ASSERT_TRUE(d.press({"view_filter=latest"}));
  EXPECT_EQ(rows().front().value, "2");
  EXPECT_EQ(rows().size(), 5U);
  ASSERT_TRUE(d.press({"view_filter=nearest"}));
  ASSERT_EQ(rows().size(), 3U);
  EXPECT_EQ(rows()[1].value, "0") << "station 1 stands beside station 7";
  EXPECT_EQ(d.shows("next_station"), "8");
}

TEST_F(X7, ShowsHowMuchOfTheStationViewIsUnmeasured) {
  ready();
  scanAt("S1");
  auto preview = std::make_shared<ScanPreview>();
  preview->columns = 2;
  preview->rows = 2;
  preview->x_m = preview->y_m = preview->z_m = {1, 2, 3, std::numeric_limits<float>::quiet_NaN()};
  d->previewDone("scans/House/Station 001.e57", preview);
  EXPECT_EQ(d.shows("unmeasured"), "25 %");
}

TEST_F(X7, KeepsAnnotationsWithTheirStation) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d.press({"annotation=Door was shut", "add_annotation"}));
  EXPECT_EQ(findWidget(d->screen(), "annotation_list")->options.at(0).label, "Door was shut");
  ASSERT_TRUE(d.press({"add_annotation"}));
  EXPECT_EQ(d.dialog(), "refused") << "it is empty";
}

TEST_F(X7, ListsItsErrorsWithLevelAndDescription) {
  ready();
  ASSERT_TRUE(d.press({"back", "status"}));
  EXPECT_TRUE(findWidget(d->screen(), "error_list")->options.empty());
  ASSERT_TRUE(d->trouble("card_locked"));
  const auto screen = d->screen();
  const auto* errors = findWidget(screen, "error_list");
  ASSERT_EQ(errors->options.size(), 1U);
  EXPECT_TRUE(errors->options[0].label.starts_with("Error | "));
}

TEST_F(X7, ImportsOnlyRawScansThatAreOnTheCard) {
  start();
  ASSERT_TRUE(d.press({"import_project", "import_format=TDX", "import_now"}));
  EXPECT_EQ(d.dialog(), "refused");
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

TEST_F(X7, ExportsByCableOrWlan) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d.press({"map", "export", "export_format=E57", "by_wlan"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<TransferOrder>(*order));
  EXPECT_EQ(std::get<TransferOrder>(*order).by, "wlan");
  d->transferDone(std::get<TransferOrder>(*order).files);
  EXPECT_EQ(d.dialog(), "transferred");
  ASSERT_TRUE(d.press({"ok"}));
  EXPECT_EQ(d.shows("untransferred"), "0");
}

TEST_F(X7, ExportsTheFormatsThatCanBeWrittenAndNoOthers) {
  ready();
  scanAt("S1");
  ASSERT_TRUE(d.press({"map", "export"}));
  for (const char* makers : {"TDX", "RCP", "POD", "TZF"}) {
    ASSERT_TRUE(d.press({std::string("export_format=") + makers}));
    EXPECT_TRUE(d.refuses("by_cable")) << makers;
    EXPECT_TRUE(d.refuses("by_wlan")) << makers;
  }
  const std::pair<const char*, const char*> kWritten[] = {{"E57", ""}, {"LAS", ".las"}, {"PTX", ".ptx"}};
  for (const auto& [format, extension] : kWritten) {
    ASSERT_TRUE(d.press({std::string("export_format=") + format, "by_cable"}));
    const auto order = d->takeOrder();
    ASSERT_TRUE(order);
    EXPECT_EQ(std::get<TransferOrder>(*order).extension, extension);
  }
}

TEST_F(X7, PointsItsLaserAtWhatIsTappedInTheStationView) {
  ready();
  scanAt("S1");
  auto picture = std::make_shared<ScanPreview>();
  picture->columns = 4, picture->rows = 2;
  picture->x_m = {1, 0, -1, 0, 1, 0, -1, std::nanf("")};
  picture->y_m = {0, -1, 0, 1, 0, -1, 0, 1};
  picture->z_m = {0, 0, 0, 0, 1, 1, 1, 1};
  picture->grey.assign(8, 0);
  d->shownSetup()->preview = picture;
  EXPECT_EQ(d.shows("pointer_spot"), "(not there)");
  ASSERT_TRUE(d.press({"pointer=on", "preview=0.3,0.9"}));
  EXPECT_EQ(d.shows("pointer_spot"), "1.00 m  H 90.0°  V 90.0°");
  EXPECT_EQ(d.fact("entry.measured_from"), "") << "a tap points and does not measure";
  ASSERT_TRUE(d.press({"preview=0.99,0.1"}));
  EXPECT_EQ(d.dialog(), "refused") << "no point came back from there";
  ASSERT_TRUE(d.press({"ok"}));
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d->fact("pointer.range")->number, 0) << "it was carried away";
  ASSERT_TRUE(d.press({"preview=0.3,0.9"}));
  EXPECT_EQ(d.dialog(), "refused");
  ASSERT_TRUE(d.press({"ok", "pointer=off", "preview=0.3,0.9"}));
  EXPECT_NE(d.fact("entry.measured_from"), "");
}

TEST_F(X7, ListsProjectsThatHaveAPicture) {
  start();
  ASSERT_TRUE(d.press({"create_new", "name=A", "project_photo=take", "create", "menu", "create_new", "name=B", "project_photo=none", "create", "menu", "all_projects"}));
  const auto screen = d->screen();
  const auto* list = findWidget(screen, "project_list");
  ASSERT_NE(list, nullptr);
  EXPECT_EQ(list->options[0].label, "A  (0)  (with a picture)");
  EXPECT_EQ(list->options[1].label, "B  (0)");
}

}  // namespace
}  // namespace standpoint
