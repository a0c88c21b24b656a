// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

constexpr const char* kG1 = "leica-blk360-g1";
constexpr const char* kG2 = "leica-blk360-g2";

TestDevice started(const char* instrument) {
  TestDevice d("leica-blk360", instrument);
  EXPECT_TRUE(d.press({"key"}));
  d->tick(60);
  EXPECT_TRUE(d->hand("stand_at", "S1"));
  return d;
}
TestDevice ready(const char* instrument) {
  TestDevice d = started(instrument);
  EXPECT_TRUE(d.press({"connect_now", "job", "new_job", "name=House", "create"}));
  return d;
}

TEST(Blk360, StartsWithItsKeyWithoutTheAppAndSwitchesOffWhenItIsHeld) {
  TestDevice d = started(kG1);
  EXPECT_EQ(d.phase(), "ready");
  EXPECT_EQ(d.screen(), "connect");
  EXPECT_EQ(d.fact("value.connection"), "Disconnected");
  EXPECT_EQ(d.shows("lamp"), "green");
  EXPECT_EQ(d.fact("device.state"), "Idle");
  ASSERT_TRUE(d->act("key", "", Gesture::hold));
  EXPECT_EQ(d.fact("device.state"), "ShuttingDown");
  d->tick(10);
  EXPECT_EQ(d.phase(), "off");
}

TEST(Blk360, TheKeyScansAloneAfterTheSelfTimerWithTheStoredConfiguration) {
  TestDevice d = started(kG1);
  ASSERT_TRUE(
      d.press({"connect_now", "settings", "resolution=low", "images=off", "back", "button", "timer=20", "store_button",
               "settings", "resolution=high", "images=hdr", "back", "back", "options", "disconnect"}));
  ASSERT_TRUE(d.press({"key"}));
  EXPECT_EQ(d.phase(), "self_timer");
  EXPECT_EQ(d.fact("operation"), "Standalone");
  EXPECT_FALSE(d->takeOrder()) << "the timer runs";
  d->tick(19);
  EXPECT_EQ(d.phase(), "self_timer");
  d->tick(2);
  EXPECT_EQ(d.phase(), "scanning");
  EXPECT_EQ(d.fact("device.state"), "Busy");
  EXPECT_EQ(d.shows("lamp"), "yellow spinning");
  const auto order = d.scanned();
  EXPECT_EQ(order.settings[0].second, "low");
  EXPECT_FALSE(order.panorama);
  EXPECT_EQ(order.project, "Standalone");
  EXPECT_FALSE(order.operator_in_view) << "20 s are enough to leave";
  d->tick(20);
  EXPECT_EQ(d.phase(), "ready");
  EXPECT_EQ(d.fact("data.state"), "Complete");
  EXPECT_EQ(d.fact("setups"), "1");
}

// 0.6 m of the first generation, 0.5 m of the second: section 1.1.
TEST(Blk360, AsksNearerThanItsGenerationMeasures) {
  for (const auto& [generation, asks] : {std::pair{kG1, true}, std::pair{kG2, false}}) {
    TestDevice d = ready(generation);
    d->change().around.nearest_m = 0.55;
    ASSERT_TRUE(d.press({"scan"}));
    EXPECT_EQ(d.dialog() == "near_question", asks) << generation;
  }
}

TEST(Blk360, WhoPressesTheKeyWithoutATimerIsInTheScan) {
  TestDevice d = started(kG2);
  ASSERT_TRUE(d.press({"connect_now", "button", "timer=0", "store_button", "back", "options", "disconnect", "key"}));
  EXPECT_EQ(d.phase(), "shooting");
  EXPECT_TRUE(d.scanned().operator_in_view);
}

TEST(Blk360, TheAppShootsThePanoramaThenScansThePoints) {
  TestDevice d = ready(kG1);
  EXPECT_EQ(d.phase(), "connected");
  ASSERT_TRUE(d.press({"scan"}));
  EXPECT_EQ(d.fact("operation"), "PanoramaShoot");
  EXPECT_EQ(d.fact("data.state"), "InProgress");
  const auto order = d.scanned();
  EXPECT_TRUE(order.panorama);
  EXPECT_EQ(order.project, "House");
  d->tick(121);
  EXPECT_EQ(d.fact("operation"), "PointCloudScan");
  d->tick(55);
  EXPECT_EQ(d.phase(), "storing");
  d->tick(3);
  EXPECT_EQ(d.phase(), "connected");
  EXPECT_EQ(d.screen(), "setup");
  EXPECT_EQ(d.shows("data_state"), "Complete");
}

TEST(Blk360, TheGenerationsDifferByTheirSheetAndSettings) {
  TestDevice one = ready(kG1), two = ready(kG2);
  ASSERT_TRUE(one.press({"settings", "resolution=high", "images=off"}));
  EXPECT_EQ(one.shows("expected_points"), "65.8 M (12566 × 5236)");
  EXPECT_EQ(one.shows("expected_time"), "3:39");
  EXPECT_EQ(one.shows("density"), "(not there)");
  EXPECT_EQ(one.shows("vis"), "(not there)");
  EXPECT_EQ(one.shows("position_tracking"), "on");
  ASSERT_TRUE(two.press({"settings", "density=dense+", "images=off"}));
  EXPECT_EQ(two.shows("expected_points"), "41.1 M (10472 × 3927)");
  EXPECT_EQ(two.shows("expected_time"), "1:21");
  EXPECT_EQ(two.shows("flash"), "(not there)");
  EXPECT_EQ(two.shows("vis"), "on");
}

TEST(Blk360, EachImageSettingChangesTheOrderOrTheTime) {
  TestDevice d = ready(kG1);
  ASSERT_TRUE(d.press({"settings"}));
  EXPECT_EQ(d.shows("expected_time"), "2:55");
  EXPECT_TRUE(d.refuses("flash", "on")) << "with LDR only";
  ASSERT_TRUE(d.press({"images=ldr", "flash=on", "exposure_correction=3"}));
  EXPECT_EQ(d.shows("expected_time"), "1:55");
  EXPECT_EQ(d->expected().camera.flash, 1);
  EXPECT_EQ(d->expected().camera.stops, 1);
  EXPECT_FALSE(d->expected().camera.hdr);
  ASSERT_TRUE(d.press({"thermal=on"}));
  EXPECT_EQ(d.shows("expected_time"), "2:10");
  ASSERT_TRUE(d.press({"auto_exposure=off", "images=hdr"}));
  EXPECT_FALSE(d->expected().camera.metered);
  EXPECT_EQ(d->expected().camera.flash, 0) << "brackets go without flash";
  ASSERT_TRUE(d.press({"images=off"}));
  EXPECT_TRUE(d.refuses("thermal", "off"));
}

TEST(Blk360, MovedWhileItMeasuresIsAnErrorAndTheFirstGenerationKeepsAPart) {
  TestDevice d = ready(kG1);
  ASSERT_TRUE(d.press({"settings", "images=off", "back", "scan"}));
  ASSERT_TRUE(d->takeOrder());
  d->tick(27.5);
  ASSERT_TRUE(d->hand("tripod_moved"));
  EXPECT_EQ(d.fact("device.state"), "Error");
  EXPECT_EQ(d.shows("error_name"), "Device_Moved");
  EXPECT_EQ(d.fact("data.state"), "Partial");
  EXPECT_EQ(d.shows("lamp"), "red blinking");
  EXPECT_NEAR(d.scanned().until_fraction, 0.5, 0.01);
  ASSERT_TRUE(d.press({"acknowledge"}));
  d->tick(5);
  EXPECT_EQ(d.fact("device.state"), "Idle");
  EXPECT_EQ(d.fact("newest.partial"), "yes");
}

TEST(Blk360, MovedWhileItMeasuresAbortsTheSecondGenerationsCapture) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d.press({"scan"}));
  d->tick(22);
  ASSERT_TRUE(d->trouble("tripod_moved"));
  EXPECT_EQ(d.fact("capture"), "Aborted");
  EXPECT_EQ(d.shows("error_action"), "Acknowledge");
  EXPECT_TRUE(d->takeCancel());
  ASSERT_TRUE(d.press({"acknowledge"}));
  EXPECT_EQ(d.phase(), "connected");
  EXPECT_EQ(d.fact("setups"), "0");
}

TEST(Blk360, BlockedIsAnErrorWithItsName) {
  for (const auto& [instrument, name] : {std::pair{kG1, "Device_Blocked"}, {kG2, "MotorizationAzTimeout"}}) {
    TestDevice d = ready(instrument);
    ASSERT_TRUE(d.press({"scan"}));
    ASSERT_TRUE(d->trouble("blocked"));
    EXPECT_EQ(d.fact("error"), name);
    ASSERT_TRUE(d.press({"key"})) << "the key acknowledges, too";
    EXPECT_EQ(d.phase(), "ready");
  }
}

TEST(Blk360, LowBatteryIsAnErrorOfTheFirstGenerationIdleOrBusy) {
  TestDevice d = ready(kG1);
  ASSERT_TRUE(d->trouble("battery_low"));
  EXPECT_EQ(d.fact("error"), "Low_Battery");
  ASSERT_TRUE(d.press({"acknowledge", "scan"}));
  ASSERT_TRUE(d->trouble("battery_low"));
  EXPECT_EQ(d.fact("error"), "Low_Battery");
  TestDevice two = ready(kG2);
  ASSERT_TRUE(two->trouble("battery_low"));
  EXPECT_EQ(two.phase(), "connected");
  EXPECT_EQ(two.dialog(), "battery_low");
  ASSERT_TRUE(two->trouble("battery_critical"));
  EXPECT_EQ(two.fact("error"), "BatteryCrit");
  ASSERT_TRUE(two.press({"acknowledge", "scan"}));
  EXPECT_EQ(two.fact("error"), "BatteryCrit") << "no capture with a critical battery";
  EXPECT_FALSE(two->takeOrder());
}

TEST(Blk360, AFullStorageIsAnErrorAtTheStartByKeyOrApp) {
  for (const auto& [instrument, name] : {std::pair{kG1, "Storage_Exceeded"}, {kG2, "StorageNoSpace"}})
    for (const char* how : {"key", "scan"}) {
      TestDevice d = ready(instrument);
      ASSERT_TRUE(d->trouble("card_full"));
      EXPECT_EQ(d.fact("storage.state"), "Crit");
      ASSERT_TRUE(d.press({how}));
      EXPECT_EQ(d.phase(), "error");
      EXPECT_EQ(d.fact("error"), name);
      EXPECT_FALSE(d->takeOrder());
    }
}

TEST(Blk360, TemperatureIsAnErrorAndFatalFarBeyondTheLimit) {
  TestDevice cold = ready(kG1);
  ASSERT_TRUE(cold->trouble("too_cold"));
  EXPECT_EQ(cold.fact("error"), "Temp_Low");
  TestDevice hot = ready(kG1);
  ASSERT_TRUE(hot.press({"scan"}));
  ASSERT_TRUE(hot->trouble("too_hot"));
  EXPECT_EQ(hot.fact("error"), "Temp_High");
  for (const auto& [instrument, name] : {std::pair{kG1, "Temp_Critical"}, {kG2, "CritHigh"}}) {
    TestDevice d = ready(instrument);
    ASSERT_TRUE(d->trouble("overheated"));
    EXPECT_EQ(d.fact("device.state"), "FatalError");
    EXPECT_EQ(d.fact("error"), name);
    EXPECT_EQ(d.fact("error.action"), "Reboot");
    EXPECT_TRUE(d.refuses("acknowledge")) << "a fatal one is not acknowledged";
    ASSERT_TRUE(d.press({"reboot"}));
    EXPECT_EQ(d.phase(), "starting");
  }
  TestDevice warm = ready(kG2);
  ASSERT_TRUE(warm->trouble("too_hot"));
  ASSERT_TRUE(warm.press({"ok", "scan"}));
  EXPECT_EQ(warm.dialog(), "temperature_question");
  ASSERT_TRUE(warm.press({"continue"}));
  EXPECT_EQ(warm.phase(), "shooting");
}

TEST(Blk360, ACancelledCaptureLeavesNothing) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d.press({"scan", "stop", "no"}));
  EXPECT_EQ(d.fact("capture"), "InProgress");
  ASSERT_TRUE(d.press({"stop", "yes"}));
  EXPECT_EQ(d.fact("capture"), "Cancelled");
  EXPECT_TRUE(d->takeCancel());
  ASSERT_TRUE(d.press({"key"}));
  EXPECT_EQ(d.phase(), "self_timer");
  ASSERT_TRUE(d->act("key", "", Gesture::hold)) << "held, the key cancels";
  EXPECT_EQ(d.fact("capture"), "Cancelled");
}

TEST(Blk360, LinksTheNextSetupWhenVisKeptTheWay) {
  TestDevice d = ready(kG2);
  const auto scan = [&] {
    ASSERT_TRUE(d.press({"home", "scan"}));
    d.scanned();
    d->tick(60);
  };
  ASSERT_TRUE(d.press({"scan"}));
  d.scanned();
  d->tick(60);
  EXPECT_EQ(d.fact("capture"), "Completed");
  EXPECT_FALSE(d->takeOrder());
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.dialog(), "link_proposed");
  ASSERT_TRUE(d.press({"ok"}));
  scan();
  EXPECT_TRUE(std::holds_alternative<LinkOrder>(*d->takeOrder()));
  EXPECT_EQ(d.fact("vis.accuracy"), "Unset");
  d->linkDone({true, 0.002, 0.62, 0, 0});
  EXPECT_EQ(d.fact("vis.accuracy"), "Accurate");
  EXPECT_EQ(d->shown("vis.quality"), "62 %");
  ASSERT_TRUE(d.press({"ok", "home", "links", "optimise"}));
  EXPECT_EQ(d.fact("bundle"), "yes");
  d->linkDone({true, 0.03, 0.62, 0, 0});
  EXPECT_EQ(d.fact("vis.accuracy"), "Inaccurate");
}

TEST(Blk360, WithoutVisTheSetupComesWithoutALinkAndTheBundleIsRefused) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d.press({"settings", "vis=off", "back", "scan"}));
  d.scanned();
  d->tick(60);
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.dialog(), "link_lost");
  ASSERT_TRUE(d.press({"ok", "home", "scan"}));
  d.scanned();
  d->tick(60);
  EXPECT_FALSE(d->takeOrder());
  ASSERT_TRUE(d.press({"home", "links", "optimise"}));
  EXPECT_EQ(d.dialog(), "refused");
  ASSERT_TRUE(d.press({"ok", "link_now"}));
  EXPECT_TRUE(std::holds_alternative<LinkOrder>(*d->takeOrder())) << "it is joined by hand";
}

TEST(Blk360, GoesOnAloneWhenTheConnectionIsLostAndStoresTheScan) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d.press({"scan"}));
  d.scanned();
  ASSERT_TRUE(d->trouble("wlan_lost"));
  EXPECT_EQ(d.fact("value.connection"), "Lost");
  EXPECT_EQ(d.dialog(), "wlan_lost_scanning");
  ASSERT_TRUE(d.press({"ok"}));
  EXPECT_EQ(d.shows("progress"), "(not there)") << "the tablet knows nothing";
  d->tick(60);
  EXPECT_EQ(d.phase(), "ready");
  EXPECT_EQ(d.fact("setups"), "1");
  ASSERT_TRUE(d.press({"connect_now", "ok"}));
  EXPECT_EQ(d.phase(), "ready") << "still too far";
  ASSERT_TRUE(d->hand("go_near"));
  ASSERT_TRUE(d.press({"connect_now"}));
  EXPECT_EQ(d.phase(), "connected");
  EXPECT_EQ(d.fact("value.connection"), "OK");
}

TEST(Blk360, SwitchingOffDisconnectsTheApp) {
  TestDevice d = ready(kG1);
  ASSERT_TRUE(d->act("key", "", Gesture::hold));
  EXPECT_EQ(d.fact("value.connection"), "ForceDisconnected");
}

TEST(Blk360, FallsAsleepOnlyWithStandbyOnAndTheKeyWakesIt) {
  TestDevice d = ready(kG1);
  d->tick(700);
  EXPECT_EQ(d.phase(), "connected");
  EXPECT_FALSE(d->busy());
  ASSERT_TRUE(d.press({"options", "standby=on", "standby_after=60"}));
  ASSERT_TRUE(d.press({"disconnect"}));
  d->tick(61);
  EXPECT_EQ(d.phase(), "standby");
  EXPECT_EQ(d.shows("lamp"), "off");
  ASSERT_TRUE(d.press({"key"}));
  EXPECT_EQ(d.phase(), "ready");
}

TEST(Blk360, SendsToTheServerBlueAndFormats) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d.press({"scan"}));
  d.scanned();
  d->tick(60);
  ASSERT_TRUE(d.press({"home", "transfer", "server=", "send"}));
  EXPECT_EQ(d.dialog(), "refused") << "there is no address";
  ASSERT_TRUE(d.press({"ok", "server=10.0.0.2", "send"}));
  EXPECT_EQ(d.dialog(), "refused") << "there the office does not listen";
  ASSERT_TRUE(d.press({"ok", "server=192.168.1.10", "port=81", "send"}));
  EXPECT_EQ(d.dialog(), "refused");
  ASSERT_TRUE(d.press({"ok", "port=8080", "send"}));
  EXPECT_EQ(d.shows("lamp"), "blue");
  const auto order = d->takeOrder();
  d->transferDone(std::get<TransferOrder>(*order).files);
  EXPECT_EQ(d.dialog(), "transferred");
  ASSERT_TRUE(d.press({"ok", "status", "format", "yes"}));
  EXPECT_EQ(d.fact("operation"), "FormattingStorage");
  d->tick(11);
  EXPECT_EQ(d.phase(), "connected");
  EXPECT_EQ(d.fact("setups.all"), "0");
}

TEST(Blk360, TellsAfterwardsThatThePowerFailedInAScan) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d.press({"scan"}));
  ASSERT_TRUE(d->hand("change_battery"));
  EXPECT_EQ(d.phase(), "off");
  ASSERT_TRUE(d.press({"key"}));
  d->tick(60);
  EXPECT_EQ(d.fact("error"), "SystemSuddenShutdown");
}

TEST(Blk360, SaysThatItsOpticsAreDustyInTheSecondGeneration) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d->trouble("dust"));
  ASSERT_TRUE(d.press({"scan"}));
  EXPECT_EQ(d.dialog(), "dust_question");
  ASSERT_TRUE(d.press({"continue"}));
  EXPECT_EQ(d.scanned().noise_factor, 2);
}

TEST(Blk360, KeepsTagsAtASetup) {
  TestDevice d = ready(kG2);
  ASSERT_TRUE(d.press({"scan"}));
  d.scanned();
  d->tick(60);
  ASSERT_TRUE(d.press({"tags", "add_tag"}));
  EXPECT_EQ(d.dialog(), "refused");
  ASSERT_TRUE(d.press({"ok", "tag=crack", "add_tag"}));
  const auto screen = d->screen();
  EXPECT_EQ(findWidget(screen, "tag_list")->options.at(0).value, "crack");
}

}  // namespace
}  // namespace standpoint
