// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

// A station at (100, 200, 51.7), 1.7 m over its mark, that looks along the axes: a target's place is what it measures.
class PSeries : public testing::Test {
 protected:
  PSeries() : d("leica-p-series") {
    ControlList control;
    for (const auto& [name, place] : kPlaces) control.targets.push_back({name, kStation + place});
    control.stations = {{"S1", kStation - Vector3d(0, 0, 1.7)}};
    d->know(control);
  }

  void start() {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(70);
    ASSERT_EQ(d.screen(), "main_menu");
  }
  void ready() {
    start();
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d.press({"manage", "new_project", "name=House", "create"}));
  }
  void inSetup(const std::string& method) {
    ready();
    ASSERT_TRUE(d.press({"scan_menu", "method=" + method}));
    ASSERT_EQ(d.screen(), "station_setup");
  }
  // Picks the target on the page that is shown and lets the instrument measure it. `id` is what is typed.
  void measure(const std::string& target, const std::string& id = {}) {
    ASSERT_TRUE(d.press({"measure_target", "view_list=" + target}));
    if (!id.empty()) {
      ASSERT_TRUE(d.press({"target_id=" + id}));
    }
    ASSERT_TRUE(d.press({"pick"}));
    EXPECT_EQ(d.phase(), "searching_target");
    answerSight();
    d->tick(31);
    EXPECT_EQ(d.screen(), "target_result");
    ASSERT_TRUE(d.press({"to_setup"}));
  }
  SightOrder answerSight(bool found = true) {
    const auto order = d->takeOrder();
    const auto* sight = order ? std::get_if<SightOrder>(&*order) : nullptr;
    EXPECT_NE(sight, nullptr);
    if (sight == nullptr) return {};
    FittedTarget target{sight->target, "checkerboard", 80, 10, 0.0005, 0, found, ""};
    for (const auto& [name, place] : kPlaces)
      if (sight->target == name) target.levelled_m = place;
    d->sightDone(target);
    return *sight;
  }
  void scanWithoutSetup() { ASSERT_TRUE(d.press({"scan_page", "scan", "continue"})); }

  static inline const Vector3d kStation{100, 200, 51.7};
  static inline const std::pair<const char*, Vector3d> kPlaces[] = {
      {"T1", {10, 0, 0.3}}, {"T2", {-5, 15, -1}}, {"T3", {-10, -10, 3}}, {"T4", {20, 20, -0.5}}};
  TestDevice d;
};

TEST_F(PSeries, TheStationSetupNeedsAProject) {
  start();
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(d.press({"scan_menu"}));
  EXPECT_EQ(d.dialog(), "no_project");
}

TEST_F(PSeries, StandardSetupHasLocalCoordinatesAtOnce) {
  inSetup("standard");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.dialog(), "station_local");
  EXPECT_EQ(d.fact("orientation.accepted"), "yes");
  EXPECT_EQ(d.fact("orientation.local"), "yes");
  EXPECT_FALSE(d->takeOriented()) << "the document's station gets no pose from it";
}

TEST_F(PSeries, ResectionWithSixParametersNeedsThreeTargetsAndGivesCoordinates) {
  inSetup("resection_6");
  measure("T1");
  measure("T2");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.dialog(), "needs_three");
  ASSERT_TRUE(d.press({"ok"}));
  measure("T3");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.screen(), "station_result");
  EXPECT_EQ(d.fact("orientation.targets"), "3");
  EXPECT_EQ(d.shows("coordinates"), "100.000  200.000  51.700");
  EXPECT_EQ(d.shows("residual_rms"), "0.0 mm");
  EXPECT_EQ(d.fact("orientation.accepted"), "no");
  ASSERT_TRUE(d.press({"accept"}));
  EXPECT_EQ(d.dialog(), "station_accepted");
  const auto oriented = d->takeOriented();
  ASSERT_TRUE(oriented);
  EXPECT_EQ(oriented->method, "resection_6");
  EXPECT_LT((oriented->pose.translation - kStation).norm(), 1e-9);
  EXPECT_FALSE(d->takeOriented()) << "once";
}

TEST_F(PSeries, WithTheCompensatorOffFourTargetsAreAskedFor) {
  inSetup("resection_6");
  ASSERT_TRUE(d.press({"level_plummet", "compensator=off", "back"}));
  for (const char* t : {"T1", "T2", "T3"}) measure(t);
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.dialog(), "needs_four");
  ASSERT_TRUE(d.press({"ok"}));
  measure("T4");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.screen(), "station_result");
}

TEST_F(PSeries, ResectionWithFourParametersNeedsTwoTargetsAndTheCompensator) {
  inSetup("resection_4");
  measure("T1");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.dialog(), "needs_two");
  ASSERT_TRUE(d.press({"ok"}));
  measure("T2");
  ASSERT_TRUE(d.press({"level_plummet", "compensator=off", "back", "solve"}));
  EXPECT_EQ(d.dialog(), "needs_compensator");
  ASSERT_TRUE(d.press({"ok", "level_plummet", "compensator=on", "back", "solve", "accept"}));
  EXPECT_EQ(d.fact("orientation.accepted"), "yes");
}

TEST_F(PSeries, AutoResectionNeedsNoTargetNames) {
  inSetup("auto");
  measure("T1", "a");
  measure("T2", "b");
  measure("T3", "c");
  measure("T4", "e");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.shows("coordinates"), "100.000  200.000  51.700");
  ASSERT_TRUE(d.press({"again", "method=resection_6", "solve"}));
  EXPECT_EQ(d.dialog(), "needs_three") << "with names none of them is known";
}

TEST_F(PSeries, OverAKnownMarkTheAzimuthOrTheBacksightTurnsTheStation) {
  inSetup("azimuth");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.dialog(), "needs_one");
  ASSERT_TRUE(d.press({"ok"}));
  measure("T1");
  ASSERT_TRUE(d.press({"azimuth=90", "instrument_height=1.7", "solve"}));
  EXPECT_EQ(d.shows("coordinates"), "100.000  200.000  51.700");
  EXPECT_EQ(d.shows("residual_rms"), "0.0 mm");
  ASSERT_TRUE(d.press({"again", "instrument_height=1.6", "solve"}));
  EXPECT_EQ(d.shows("residual_rms"), "100.0 mm") << "a wrong height is in the coordinates";
  ASSERT_TRUE(d.press({"again", "instrument_height=1.7", "method=backsight", "solve", "accept"}));
  EXPECT_LT(d->takeOriented()->pose.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
  ASSERT_TRUE(d.press({"ok", "scan_menu", "method=quick", "azimuth=90", "solve", "accept"}));
  EXPECT_LT(d->takeOriented()->pose.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
}

TEST_F(PSeries, ATraverseGoesOnFromTheTargetsOfTheStationBefore) {
  inSetup("resection_4");
  measure("T1");
  measure("T2");
  ASSERT_TRUE(d.press({"solve", "accept", "ok"}));
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  EXPECT_EQ(d.fact("orientation.solved"), "no") << "the tripod stands elsewhere";
  EXPECT_EQ(d.fact("targets.sighted"), "0");
  ASSERT_TRUE(d.press({"scan_menu", "method=traverse"}));
  measure("T1");
  measure("T3");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_EQ(d.dialog(), "needs_two") << "T3 was not measured from the station before";
  ASSERT_TRUE(d.press({"ok"}));
  measure("T2");
  ASSERT_TRUE(d.press({"solve", "accept"}));
  EXPECT_EQ(d.fact("orientation.targets"), "2");
}

TEST_F(PSeries, SwappedTargetsShowInTheResidualsAndOneCanBeLeftOut) {
  inSetup("resection_6");
  measure("T1", "T2");
  measure("T3");
  measure("T4");
  measure("T2", "T1");
  ASSERT_TRUE(d.press({"solve"}));
  EXPECT_GT(d->fact("orientation.rms")->number.value(), 1000);
  const auto screen = d->screen();
  EXPECT_FALSE(findWidget(screen, "residual_rms")->why_not.empty()) << "it warns above 5 mm";
  ASSERT_TRUE(d.press({"again", "sighting_list=T1"}));
  EXPECT_EQ(d.fact("targets.usable"), "3");
  EXPECT_EQ(d.fact("orientation.solved"), "no");
}

TEST_F(PSeries, TheTypedAirScalesTheRangesToTargets) {
  inSetup("resection_4");
  measure("T1");
  measure("T2");
  ASSERT_TRUE(d.press({"air_temperature=60", "solve"}));
  EXPECT_GT(d->fact("orientation.rms")->number.value(), 0.2) << "40 ppm of 10 to 16 m";
}

TEST_F(PSeries, ATargetIsPickedTypedAndMeasuredOrNotFound) {
  ready();
  ASSERT_TRUE(d.press({"targets", "measure_target", "pick"}));
  EXPECT_EQ(d.dialog(), "no_target_picked");
  ASSERT_TRUE(d.press({"ok", "target_type=sphere", "view_list=T1", "target_id=P7", "target_height=0.2", "pick"}));
  const auto order = answerSight();
  EXPECT_EQ(order.kind, "sphere");
  EXPECT_EQ(order.target, "T1");
  EXPECT_TRUE(order.compensator);
  d->tick(31);
  EXPECT_EQ(d.screen(), "target_result");
  EXPECT_EQ(d.shows("sight_name"), "P7");
  EXPECT_EQ(d.shows("sight_residual"), "0.5 mm");
  EXPECT_EQ(d->state().sighted[0].height_m, 0.2);
  ASSERT_TRUE(d.press({"measure_target", "view_list=T2", "pick"}));
  answerSight(false);
  d->tick(31);
  EXPECT_EQ(d.dialog(), "target_not_found");
  ASSERT_TRUE(d.press({"ok", "pick", "cancel_sight"}));
  EXPECT_EQ(d.screen(), "pick_target");
  ASSERT_TRUE(d->trouble("target_hidden"));
  ASSERT_TRUE(d.press({"pick"}));
  EXPECT_EQ(d.dialog(), "target_not_found");
}

TEST_F(PSeries, TargetAllMeasuresOneAfterTheOther) {
  ready();
  ASSERT_TRUE(d.press({"scan_page", "fov_page", "fov_choice=target_all", "pick_all"}));
  for (int i = 0; i < 4; ++i) {
    answerSight();
    d->tick(31);
  }
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.fact("targets.sighted"), "4");
}

TEST_F(PSeries, ScansThenTakesPicturesAndListsTheScanUnderItsStation) {
  ready();
  ASSERT_TRUE(d.press({"scan_page", "scan"}));
  EXPECT_EQ(d.dialog(), "no_setup_question");
  ASSERT_TRUE(d.press({"continue"}));
  EXPECT_EQ(d.phase(), "scanning");
  EXPECT_TRUE(d.scanned().compensator);
  d->tick(110);
  EXPECT_EQ(d.phase(), "imaging");
  d->tick(440);
  EXPECT_EQ(d.phase(), "storing");
  d->tick(3);
  EXPECT_EQ(d.phase(), "idle");
  EXPECT_EQ(d.shows("setup_station"), "S1");
}

// Times: instrument facts, section 1.4; the factor of High is a choice.
TEST_F(PSeries, EachSettingActsOnTimePointsOrTheOrder) {
  ready();
  ASSERT_TRUE(d.press({"scan_page", "image_page", "images=off", "back", "resolution_page"}));
  EXPECT_EQ(d.shows("expected_time"), "1:49");
  ASSERT_TRUE(d.press({"sensitivity=high"}));
  EXPECT_EQ(d.shows("expected_time"), "3:30");
  EXPECT_NEAR(d->expected().noise_factor, 0.7071, 1e-4);
  ASSERT_TRUE(d.press({"sensitivity=normal", "resolution=1.6mm", "back", "fov_page", "fov_choice=custom",
                       "horizontal_from=0", "horizontal_to=90"}));
  EXPECT_NEAR(d->expected().columns, 9818, 1);
  ASSERT_TRUE(d.press({"fov_choice=full"}));
  EXPECT_EQ(d->expected().columns, 39270U);
  ASSERT_TRUE(d.press({"fov_choice=rectangle", "rectangle=10,50,-10,20"}));
  EXPECT_NEAR(d->expected().columns, 4363, 1);
  ASSERT_TRUE(d.press({"fov_choice=full", "back", "image_page", "images=on", "image_resolution=960", "hdr=on",
                       "exposure=manual+2", "white_balance=warm"}));
  EXPECT_EQ(d->expected().imaging_seconds, 440 * 0.75 * 2);
  EXPECT_EQ(d->expected().camera.columns, 4096U);
  EXPECT_TRUE(d->expected().camera.hdr);
  EXPECT_EQ(d->expected().camera.stops, 2);
  EXPECT_FALSE(d->expected().camera.metered);
  EXPECT_LT(d->expected().camera.warmth, 0);
  ASSERT_TRUE(d.press({"back", "filter_page", "min_range=1", "max_range=50", "min_intensity=20", "back", "main_menu"}));
  scanWithoutSetup();
  EXPECT_EQ(d.scanned().filters, (std::vector<std::string>{"intensity:from=0.2"}));
  EXPECT_EQ(d.fact("setting.nearest_m"), "1") << "the gates are settings of the scan, and nothing else cuts the range";
  EXPECT_EQ(d.fact("setting.farthest_m"), "50");
}

TEST_F(PSeries, DoesNotScanWithItsCoverOpen) {
  ready();
  ASSERT_TRUE(d->trouble("cover_open"));
  ASSERT_TRUE(d.press({"scan_page", "scan"}));
  EXPECT_EQ(d.dialog(), "cover_open");
  ASSERT_TRUE(d->hand("close_cover"));
  ASSERT_TRUE(d.press({"ok", "scan"}));
  EXPECT_EQ(d.dialog(), "no_setup_question");
}

TEST_F(PSeries, ImageOnlyLeavesTheLaserOff) {
  ready();
  ASSERT_TRUE(d.press({"scan_page", "image_page", "images=only", "back", "main_menu"}));
  EXPECT_EQ(d->shown("expected.seconds"), "7:20");
  scanWithoutSetup();
  EXPECT_EQ(d.phase(), "imaging");
}

TEST_F(PSeries, P50HasRangeModes) {
  TestDevice far("leica-p-series", "leica-p50");
  ASSERT_TRUE(far.press({"power"}));
  far->tick(70);
  EXPECT_EQ(far.fact("setting.range"), "120m") << "the standard of the reference [P]";
  ASSERT_TRUE(far.press({"scan_page", "resolution_page"}));
  for (const char* range : {"270", "570", "1000", "120"}) {
    ASSERT_TRUE(far.press({std::string("range_mode=") + range + "m"}));
    EXPECT_EQ(far.fact("expected.range"), range);
  }
  start();
  ASSERT_TRUE(d.press({"scan_page", "resolution_page"}));
  EXPECT_EQ(d.shows("range_mode"), "(not there)");
}

TEST_F(PSeries, BeyondFiveArcMinutesItStopsAndAsks) {
  ready();
  ASSERT_TRUE(d->hand("tilt", "0.08,0"));
  EXPECT_EQ(d.fact("level"), "good");
  ASSERT_TRUE(d->hand("tilt", "0.09,0"));
  ASSERT_TRUE(d.press({"scan_page", "scan"}));
  EXPECT_EQ(d.dialog(), "level_question");
  TestDevice off = d;
  ASSERT_TRUE(d.press({"level_now"}));
  EXPECT_EQ(d.screen(), "level_plummet");
  EXPECT_FALSE(d->takeOrder());
  ASSERT_TRUE(off.press({"without_compensator"}));
  EXPECT_EQ(off.phase(), "scanning");
  EXPECT_EQ(off.fact("value.compensator"), "off");
  EXPECT_FALSE(off.scanned().compensator);
}

TEST_F(PSeries, PausesWhenTheCompensatorLeavesItsRangeAndFlagsTheLines) {
  ready();
  ASSERT_TRUE(d.press({"scan_page", "image_page", "images=off", "back", "main_menu"}));
  scanWithoutSetup();
  ASSERT_TRUE(d->takeOrder());
  d->tick(50);
  ASSERT_TRUE(d->trouble("tilted"));
  EXPECT_EQ(d.phase(), "paused");
  EXPECT_EQ(d.dialog(), "compensator_question");
  TestDevice stopped = d;
  ASSERT_TRUE(stopped.press({"stop_scan"}));
  EXPECT_EQ(stopped.phase(), "idle");
  EXPECT_EQ(stopped.fact("setups"), "0");
  d->tick(1000);
  ASSERT_TRUE(d.press({"without_compensator"}));
  EXPECT_EQ(d.phase(), "scanning");
  EXPECT_NEAR(d->state().elapsed_s, 50, 1e-9) << "it goes on where it was";
  EXPECT_FALSE(d.scanned().compensator);
  d->tick(62);
  EXPECT_EQ(d.fact("newest.unlevelled"), "yes");
  ASSERT_TRUE(d.press({"main_menu", "tools", "transfer"}));
  EXPECT_EQ(d.dialog(), "import_question");
  TestDevice left = d;
  ASSERT_TRUE(d.press({"import_marked"}));
  EXPECT_EQ(std::get<TransferOrder>(*d->takeOrder()).files.size(), 1U);
  ASSERT_TRUE(left.press({"leave_out"}));
  EXPECT_FALSE(left->takeOrder());
}

TEST_F(PSeries, PausesInTheImagesToo) {
  ready();
  scanWithoutSetup();
  d.scanned();
  d->tick(120);
  ASSERT_EQ(d.phase(), "imaging");
  const double done = d->state().elapsed_s;
  ASSERT_TRUE(d->trouble("tilted"));
  ASSERT_TRUE(d.press({"without_compensator"}));
  EXPECT_EQ(d.phase(), "imaging");
  EXPECT_NEAR(d->state().elapsed_s, done, 1e-9);
}

TEST_F(PSeries, RefusesToScanAndSaysWhy) {
  ready();
  ASSERT_TRUE(d.press({"scan_page"}));
  for (const auto& [trouble, dialog] : {std::pair{"card_full", "card_full"},
                                        {"card_locked", "card_locked"},
                                        {"battery_critical", "battery_critical"}}) {
    TestDevice one = d;
    ASSERT_TRUE(one->trouble(trouble));
    if (!one.dialog().empty()) {
      ASSERT_TRUE(one.press({"ok"}));
    }
    ASSERT_TRUE(one.press({"scan"}));
    EXPECT_EQ(one.dialog(), dialog);
    EXPECT_FALSE(one->takeOrder());
  }
  for (const char* trouble : {"too_cold", "not_warm", "too_near"}) {
    TestDevice one = d;
    ASSERT_TRUE(one->trouble(trouble));
    if (!one.dialog().empty()) {
      ASSERT_TRUE(one.press({"ok"}));
    }
    ASSERT_TRUE(one.press({"scan"}));
    EXPECT_TRUE(one.dialog().ends_with("_question")) << trouble;
  }
}

TEST_F(PSeries, AStoppedScanIsDiscardedOrKeptInPart) {
  ready();
  ASSERT_TRUE(d.press({"scan_page", "image_page", "images=off", "back", "main_menu"}));
  scanWithoutSetup();
  ASSERT_TRUE(d->takeOrder());
  d->tick(54.5);
  TestDevice dropped = d;
  ASSERT_TRUE(d.press({"stop", "keep_partial"}));
  EXPECT_NEAR(d.scanned().until_fraction, 0.5, 0.01);
  d->tick(5);
  EXPECT_EQ(d.fact("newest.partial"), "yes");
  ASSERT_TRUE(dropped.press({"stop", "discard"}));
  EXPECT_EQ(dropped.fact("setups"), "0");
}

TEST_F(PSeries, APushWhileItMeasuresATargetSpoilsThatTarget) {
  ready();
  ASSERT_TRUE(d.press({"targets", "measure_target", "view_list=T1", "pick"}));
  ASSERT_TRUE(d->takeOrder());
  ASSERT_TRUE(d->hand("tripod_moved"));
  EXPECT_EQ(d.dialog(), "tripod_moved");
  EXPECT_EQ(d.screen(), "pick_target");
  EXPECT_TRUE(d->takeCancel());
  EXPECT_EQ(d.fact("targets.sighted"), "0");
}

TEST_F(PSeries, TellsThatItWasPushedAndKeepsOrDiscardsTheScan) {
  ready();
  scanWithoutSetup();
  ASSERT_TRUE(d->takeOrder());
  d->tick(54.5);
  ASSERT_TRUE(d->trouble("tripod_moved"));
  EXPECT_EQ(d.phase(), "error");
  TestDevice other = d;
  ASSERT_TRUE(d.press({"ok", "keep"}));
  EXPECT_NEAR(d.scanned().tripod_moved_at_fraction.value_or(0), 0.5, 0.01);
  d->tick(5);
  EXPECT_EQ(d.fact("newest.tripod_moved"), "yes");
  ASSERT_TRUE(other.press({"ok", "discard"}));
  EXPECT_EQ(other.fact("setups"), "0");
}

TEST_F(PSeries, ChecksItselfOnlyWhenItIsLevelAndLeftAlone) {
  start();
  ASSERT_TRUE(d->hand("tilt", "1,0"));
  ASSERT_TRUE(d.press({"tools", "check_adjust"}));
  EXPECT_EQ(d.dialog(), "adjust_refused");
  ASSERT_TRUE(d->hand("level"));
  ASSERT_TRUE(d.press({"ok", "check_adjust"}));
  EXPECT_EQ(d.phase(), "adjusting");
  d->tick(301);
  EXPECT_EQ(d.dialog(), "adjusted");
}

}  // namespace
}  // namespace standpoint
