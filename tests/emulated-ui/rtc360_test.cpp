// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

class Rtc360 : public testing::Test {
 protected:
  Rtc360() : d("leica-rtc360") {}

  void start() {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(60);
    ASSERT_EQ(d.screen(), "home");
  }
  // On, with a job, standing at S1.
  void ready(const std::string& job = "Training") {
    start();
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d.press({"job", "new_job", "name=" + job, "create"}));
  }
  void scanOnce() {
    ASSERT_TRUE(d.press({"scan"}));
    d.scanned();
    d.settle();
  }

  TestDevice d;
};

TEST_F(Rtc360, StartsWithItsKeyAndThenShowsHome) {
  EXPECT_TRUE(d.screen().empty());
  EXPECT_TRUE(d.refuses("scan")) << "it is off";
  ASSERT_TRUE(d.press({"power"}));
  EXPECT_TRUE(d->busy());
  EXPECT_EQ(d.phase(), "booting");
  d->tick(60);
  EXPECT_EQ(d.screen(), "home");
  EXPECT_FALSE(d->busy());
}

TEST_F(Rtc360, DoesNotStartOnAnEmptyBattery) {
  ASSERT_TRUE(d->trouble("battery_critical"));
  EXPECT_TRUE(d.refuses("power"));
  ASSERT_TRUE(d->hand("change_battery"));
  EXPECT_TRUE(d.press({"power"}));
}

TEST_F(Rtc360, AsksBeforeItIsSwitchedOff) {
  start();
  ASSERT_TRUE(d.press({"power", "no"}));
  EXPECT_EQ(d.phase(), "idle");
  ASSERT_TRUE(d.press({"power", "yes"}));
  d.settle();
  EXPECT_EQ(d.phase(), "off");
  EXPECT_TRUE(d.screen().empty());
}

TEST_F(Rtc360, MakesNamesAndOpensAJob) {
  ready("House");
  EXPECT_EQ(d.shows("job"), "House");
  EXPECT_EQ(d.shows("next_setup"), "1");
  ASSERT_TRUE(d.press({"job", "new_job", "name=a/b", "create"}));
  EXPECT_EQ(d.dialog(), "refused") << "the name becomes a folder's";
  ASSERT_TRUE(d.press({"ok", "name=House", "create"}));
  EXPECT_EQ(d.dialog(), "refused") << "the name is taken";
  ASSERT_TRUE(d.press({"ok", "name=Garden", "first=7", "create"}));
  EXPECT_EQ(d.shows("job"), "Garden");
  EXPECT_EQ(d.shows("next_setup"), "7");
  ASSERT_TRUE(d.press({"job"}));
  EXPECT_TRUE(d.refuses("job_list", "2"));
  ASSERT_TRUE(d.press({"job_list=0"}));
  EXPECT_EQ(d.shows("job"), "House");
}

TEST_F(Rtc360, DeletesTheOpenJobWithItsSetups) {
  ready("House");
  ASSERT_TRUE(d.press({"scan"}));
  d.scanned();
  d.settle();
  const double used = d->state().around.card_used_bytes;
  ASSERT_GT(used, 0);
  ASSERT_TRUE(d.press({"home", "job", "delete_job"}));
  EXPECT_EQ(d.dialog(), "delete_job_question");
  ASSERT_TRUE(d.press({"no"}));
  EXPECT_EQ(d->state().projects.size(), 1U);
  ASSERT_TRUE(d.press({"delete_job", "yes"}));
  EXPECT_TRUE(d->state().projects.empty());
  EXPECT_EQ(d->state().around.card_used_bytes, 0);
  EXPECT_TRUE(d.happened("project_deleted", "House"));
  EXPECT_EQ(d.screen(), "jobs");
  EXPECT_TRUE(d.refuses("delete_job"));
}

TEST_F(Rtc360, OnlyTakesPicturesWithTheScanOff) {
  ready();
  ASSERT_TRUE(d.press({"settings", "resolution=6mm", "images=on", "double_scan=off", "laser_scan=off"}));
  EXPECT_EQ(d.shows("expected_time"), "1:00");
  EXPECT_EQ(d.fact("expected.points"), "0");
  EXPECT_EQ(d.fact("expected.bytes"), "0");
  EXPECT_TRUE(d.refuses("double_scan", "on")) << "a double scan needs the scan";
  ASSERT_TRUE(d.press({"images=off", "back", "scan"}));
  EXPECT_EQ(d.dialog(), "nothing_chosen");
  ASSERT_TRUE(d.press({"ok", "settings", "images=on", "back"}));
  EXPECT_EQ(d.shows("settings"), "Images (HDR)");
  ASSERT_TRUE(d.press({"scan"}));
  EXPECT_EQ(d.phase(), "photographing");
  const auto order = d.scanned(0);
  EXPECT_TRUE(order.panorama);
  d->tick(70);
  EXPECT_EQ(d.phase(), "vis_tracking");
}

TEST_F(Rtc360, ShowsItsSettingsAndItsStateOnHome) {
  ready();
  ASSERT_TRUE(d.press({"settings", "resolution=3mm", "images=on", "double_scan=on", "back"}));
  EXPECT_EQ(d.shows("settings"), "High (3 mm @ 10 m) · Double scan · Images (HDR)");
  EXPECT_EQ(d.shows("vis_status"), "") << "the word VIS";
  EXPECT_EQ(d.shows("wlan_status"), "(not there)");
  ASSERT_TRUE(d.press({"tools", "vis=off", "back"}));
  EXPECT_EQ(d.shows("vis_status"), "(not there)");
}

// Times and grids: instrument facts, section 1.4.
TEST_F(Rtc360, ShowsTheTimeAndThePointsOfItsSettings) {
  ready();
  ASSERT_TRUE(d.press({"settings", "resolution=12mm", "images=on", "double_scan=off"}));
  EXPECT_EQ(d.shows("expected_time"), "1:26");
  EXPECT_EQ(d.shows("expected_points"), "10.6 M (5084 × 2083)");
  ASSERT_TRUE(d.press({"images=off"}));
  EXPECT_EQ(d.shows("expected_time"), "0:26");
  ASSERT_TRUE(d.press({"double_scan=on"}));
  EXPECT_EQ(d.shows("expected_time"), "0:52");
  ASSERT_TRUE(d.press({"resolution=6mm", "images=on", "double_scan=off"}));
  EXPECT_EQ(d.shows("expected_time"), "1:51");
  EXPECT_TRUE(d.refuses("resolution", "5mm"));
}

TEST_F(Rtc360, RefusesToScanAndSaysWhy) {
  start();
  ASSERT_TRUE(d.press({"scan"}));
  EXPECT_EQ(d.dialog(), "no_project");
  ASSERT_TRUE(d.press({"ok", "job", "new_job", "create", "scan"}));
  EXPECT_EQ(d.dialog(), "no_station");
  ASSERT_TRUE(d.press({"ok"}));
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  const std::pair<const char*, const char*> kTroubles[] = {{"card_missing", "card_absent"},
                                                           {"card_locked", "card_locked"},
                                                           {"card_full", "card_full"},
                                                           {"battery_critical", "battery_critical"}};
  for (const auto& [trouble, dialog] : kTroubles) {
    ASSERT_TRUE(d->trouble(trouble));
    if (!d.dialog().empty()) {
      ASSERT_TRUE(d.press({"ok"}));
    }
    ASSERT_TRUE(d.press({"scan"}));
    EXPECT_EQ(d.dialog(), dialog) << trouble;
    EXPECT_FALSE(d->takeOrder()) << trouble;
    ASSERT_TRUE(d.press({"ok"}));
    ASSERT_TRUE(d->hand("change_card"));
  }
  ASSERT_TRUE(d->hand("plug_in"));
  ASSERT_TRUE(d.press({"scan"}));
  EXPECT_EQ(d.phase(), "scanning_pass_1");
}

TEST_F(Rtc360, AsksWhenLevelTemperatureOrDistanceAreOutsideItsLimits) {
  ready();
  for (const char* trouble : {"too_hot", "not_warm", "tilted", "too_near"}) {
    TestDevice one = d;
    ASSERT_TRUE(one->trouble(trouble));
    if (!one.dialog().empty()) {
      ASSERT_TRUE(one.press({"ok"}));
    }
    ASSERT_TRUE(one.press({"scan"}));
    EXPECT_TRUE(one.dialog().ends_with("_question")) << trouble;
    TestDevice other = one;
    ASSERT_TRUE(one.press({"cancel"}));
    EXPECT_FALSE(one->takeOrder());
    ASSERT_TRUE(other.press({"continue"}));
    EXPECT_EQ(other.phase(), "scanning_pass_1") << trouble;
  }
}

TEST_F(Rtc360, ScansTakesImagesStoresAndShowsTheDataAtOnce) {
  ready("House");
  ASSERT_TRUE(d.press({"settings", "resolution=12mm", "images=on", "back", "scan"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order);
  const auto scan = std::get<ScanOrder>(*order);
  EXPECT_EQ(scan.project, "House");
  EXPECT_EQ(scan.station, "S1");
  EXPECT_EQ(scan.name, "Setup 001");
  EXPECT_TRUE(scan.panorama);
  EXPECT_FALSE(d->takeOrder()) << "once";
  d->orderMoved(1);
  d->tick(13);
  EXPECT_EQ(d.shows("progress"), "15 %");
  EXPECT_EQ(d.shows("remaining"), "1:13");
  d->tick(20);
  EXPECT_EQ(d.phase(), "photographing");
  d.finish(scan);
  d->tick(53.5);
  EXPECT_EQ(d.phase(), "storing");
  EXPECT_FALSE(d->takeStored());
  d->tick(2);
  EXPECT_TRUE(d->takeStored());
  EXPECT_EQ(d.phase(), "vis_tracking");
  EXPECT_EQ(d.screen(), "setup");
  EXPECT_EQ(d.shows("setup_points"), "1.0 M, 23.8 MB");
  ASSERT_TRUE(d.press({"view"}));
  EXPECT_EQ(d->takeView()->file, "scans/House/Setup 001.e57");
  ASSERT_TRUE(d.press({"home"}));
  EXPECT_EQ(d.shows("next_setup"), "2");
}

TEST_F(Rtc360, SweepsTwiceInADoubleScan) {
  ready();
  ASSERT_TRUE(d.press({"settings", "resolution=12mm", "images=off", "double_scan=on", "back", "scan"}));
  d.scanned();
  d->tick(25);
  EXPECT_EQ(d.phase(), "scanning_pass_1");
  d->tick(2);
  EXPECT_EQ(d.phase(), "scanning_pass_2");
  d->tick(26);
  EXPECT_EQ(d.phase(), "storing");
}

TEST_F(Rtc360, WaitsForTheSimulationWhenItIsSlowerThanTheInstrument) {
  ready();
  ASSERT_TRUE(d.press({"scan"}));
  const auto order = d->takeOrder();
  d->orderMoved(0.4);
  ASSERT_TRUE(d->hand("plug_in"));
  const double whole_s = d->expected().scan_seconds + d->expected().imaging_seconds;
  d->tick(100000);
  EXPECT_EQ(d.shows("progress"), "40 %") << "what is shown as done is done";
  EXPECT_NEAR(d->number("remaining"), 0.6 * whole_s, 1e-6) << "and what is not is still to come";
  EXPECT_TRUE(d->busy());
  d.finish(std::get<ScanOrder>(*order));
  d->tick(10);
  EXPECT_TRUE(d->takeStored());
}

TEST_F(Rtc360, DiscardsTheSetupWhenStoppedAfterAsking) {
  ready();
  ASSERT_TRUE(d.press({"scan"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(d.press({"stop", "no"}));
  EXPECT_FALSE(d->takeCancel());
  d.finish(std::get<ScanOrder>(*order));
  ASSERT_TRUE(d.press({"stop", "yes"}));
  EXPECT_TRUE(d->takeCancel());
  EXPECT_FALSE(d->busy());
  d->tick(500);
  EXPECT_FALSE(d->takeStored());
  EXPECT_EQ(d.shows("next_setup"), "1");
}

TEST_F(Rtc360, ProposesALinkWhenVisKeptTheWay) {
  ready();
  scanOnce();
  EXPECT_FALSE(d->takeOrder()) << "there is nothing to link to yet";
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.dialog(), "link_proposed");
  EXPECT_EQ(d.phase(), "idle");
  ASSERT_TRUE(d.press({"ok"}));
  scanOnce();
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
  EXPECT_EQ(std::get<LinkOrder>(*order).to_file, "scans/Training/Setup 001.e57");
  d->linkDone({true, 0.002, 0.6, 0.001, 0.01});
  EXPECT_EQ(d.dialog(), "link_joined");
  EXPECT_EQ(d.fact("link"), "joined");
}

TEST_F(Rtc360, ProposesNoLinkInAJobWithNothingInIt) {
  ready();
  scanOnce();
  ASSERT_TRUE(d.press({"home", "job", "new_job", "name=Annexe", "create"}));
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.dialog(), "");
  EXPECT_EQ(d.phase(), "idle");
}

TEST_F(Rtc360, StoresWithoutALinkWhenTheWayWasLost) {
  ready();
  scanOnce();
  ASSERT_TRUE(d->trouble("tracking_lost"));
  EXPECT_EQ(d.dialog(), "tracking_lost");
  ASSERT_TRUE(d.press({"ok"}));
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.dialog(), "link_lost");
  ASSERT_TRUE(d.press({"ok"}));
  scanOnce();
  EXPECT_FALSE(d->takeOrder());
  EXPECT_EQ(d.fact("link"), "none");
  ASSERT_TRUE(d.press({"home", "tools", "link", "link_now"}));
  EXPECT_TRUE(std::holds_alternative<LinkOrder>(*d->takeOrder())) << "it is joined by hand";
}

TEST_F(Rtc360, WithVisOffGoesStraightToIdleWithoutALink) {
  ready();
  ASSERT_TRUE(d.press({"settings", "vis=off", "back"}));
  scanOnce();
  EXPECT_EQ(d.phase(), "idle");
}

TEST_F(Rtc360, TellsThatItWasPushedAndKeepsOrDiscardsTheScan) {
  ready();
  ASSERT_TRUE(d.press({"settings", "resolution=12mm", "images=off", "back", "scan"}));
  ASSERT_TRUE(d->takeOrder());
  d->tick(13);
  ASSERT_TRUE(d->trouble("tripod_moved"));
  EXPECT_EQ(d.phase(), "error");
  EXPECT_TRUE(d->takeCancel());
  const auto order = d->takeOrder();
  ASSERT_TRUE(order);
  EXPECT_NEAR(std::get<ScanOrder>(*order).tripod_moved_at_fraction.value_or(0), 0.5, 0.01)
      << "the rest stands elsewhere";
  TestDevice other = d;
  ASSERT_TRUE(d.press({"ok", "keep"}));
  d.finish(std::get<ScanOrder>(*order));
  d.settle();
  EXPECT_EQ(d.fact("newest.tripod_moved"), "yes");
  ASSERT_TRUE(other.press({"ok", "discard"}));
  EXPECT_EQ(other.phase(), "idle");
  EXPECT_EQ(other.fact("setups"), "0");
}

TEST_F(Rtc360, LosesTheRunningScanWithItsStick) {
  ready();
  ASSERT_TRUE(d.press({"scan"}));
  d->tick(5);
  ASSERT_TRUE(d->hand("remove_card"));
  EXPECT_EQ(d.dialog(), "card_lost");
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_TRUE(d->takeCancel());
}

TEST_F(Rtc360, GoesOutWhenTheBatteryIsEmptyAndKeepsWhatIsStored) {
  ready();
  scanOnce();
  d->tick(4 * 3600);
  EXPECT_EQ(d.phase(), "off");
  EXPECT_TRUE(d.happened("trouble", "battery_low"));
  ASSERT_TRUE(d->hand("change_battery"));
  start();
  EXPECT_EQ(d.fact("setups.all"), "1");
}

TEST_F(Rtc360, ScansNoisierWithDustAndBeforeItIsWarm) {
  ready();
  ASSERT_TRUE(d->trouble("dust"));
  ASSERT_TRUE(d.press({"scan"}));
  EXPECT_EQ(std::get<ScanOrder>(*d->takeOrder()).noise_factor, 2);
}

TEST_F(Rtc360, HandsOverByCableAndOnlyThenFormatsWithoutLoss) {
  ready();
  scanOnce();
  ASSERT_TRUE(d.press({"home", "tools", "transfer", "by_cable"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<TransferOrder>(*order));
  d->transferDone(std::get<TransferOrder>(*order).files);
  EXPECT_EQ(d.dialog(), "transferred");
  ASSERT_TRUE(d.press({"ok", "back", "format", "yes"}));
  EXPECT_TRUE(d.happened("card_formatted", "0"));
  EXPECT_EQ(d.fact("setups.all"), "0");
}

TEST_F(Rtc360, ShowsWhatTheProjectAlreadyHolds) {
  StoredSetup a, b, c;
  a.project = b.project = "House";
  a.number = 1;
  b.number = 4;
  c.project = "Yard";
  c.number = 1;
  d->load({a, b, c});
  start();
  ASSERT_TRUE(d.press({"job", "job_list=0"}));
  EXPECT_EQ(d.shows("next_setup"), "5");
}

TEST_F(Rtc360, SpeaksTheLanguageThatIsChosen) {
  start();
  ASSERT_TRUE(d.press({"options", "language=de"}));
  EXPECT_EQ(d->screen().title, "Einstellungen");
  ASSERT_TRUE(d.press({"language=uk"}));
  EXPECT_EQ(d->screen().title, "Параметри");
}

TEST_F(Rtc360, ExplainsEachWidgetWithWhatItCostsAndWhereItIs) {
  ready();
  ASSERT_TRUE(d.press({"settings"}));
  const auto help = d->help("resolution");
  EXPECT_NE(help.find("High (3 mm @ 10 m): 2:42"), std::string::npos) << help;
  EXPECT_NE(help.find("169.4 M"), std::string::npos) << help;
  EXPECT_NE(help.find("Home › Scan settings"), std::string::npos) << help;
}

TEST_F(Rtc360, CarriedAwayWhileItPhotographsIsTheSameTroubleAsWhileItScans) {
  ready();
  ASSERT_TRUE(d.press({"settings", "images=on", "back", "scan"}));
  d.scanned();
  d->tick(d->fact("expected.scan")->number.value());
  ASSERT_EQ(d.phase(), "photographing");
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.phase(), "error");
  EXPECT_EQ(d.dialog(), "tripod_moved");
  ASSERT_TRUE(d.press({"ok", "discard"}));
  EXPECT_EQ(d.fact("setups"), "0");
}

}  // namespace
}  // namespace standpoint
