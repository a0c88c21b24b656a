// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

// Transitions and settings: instrument facts, section 2.6.
class VzI : public testing::Test {
 protected:
  VzI() : d("riegl-vz-i") {}

  void start() {
    ASSERT_TRUE(d.press({"power"}));
    d->tick(90);
    ASSERT_EQ(d.phase(), "waiting");
  }
  void ready(const std::string& project = "House") {
    start();
    ASSERT_TRUE(d->hand("stand_at", "S1"));
    ASSERT_TRUE(d->hand("plug_in"));
    ASSERT_TRUE(d.press({"project", "name=" + project, "load_or_create"}));
  }
  ScanOrder scan() {
    EXPECT_TRUE(d.screen() == "home" || d.press({"home"}));
    EXPECT_TRUE(d.press({"start_scan"}));
    if (d.dialog() == "position_question") {
      EXPECT_TRUE(d.press({"continue"}));
    }
    EXPECT_EQ(d.phase(), "scanning");
    const auto order = d.scanned();
    d->tick(d->fact("expected.seconds")->number.value() + 4);
    return order;
  }
  void linked(double error_m, double overlap, bool joined = true) {
    EXPECT_EQ(d.phase(), "processing");
    EXPECT_TRUE(d->takeOrder());
    d->linkDone({joined, error_m, overlap, 0, 0});
    d->tick(60);
  }

  TestDevice d;
};

TEST_F(VzI, GoesFromUnavailableToWaitingWithItsPower) {
  EXPECT_EQ(d.fact("opstate"), "unavailable");
  EXPECT_TRUE(d.screen().empty());
  start();
  EXPECT_EQ(d.fact("opstate"), "waiting");
  ASSERT_TRUE(d.press({"power", "yes"}));
  d.settle();
  EXPECT_EQ(d.phase(), "unavailable");
}

TEST_F(VzI, ScansOnlyWithAProjectLoaded) {
  start();
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(d.press({"start_scan"}));
  EXPECT_EQ(d.dialog(), "no_project");
  EXPECT_EQ(d.phase(), "waiting");
}

TEST_F(VzI, LoadsAProjectByItsNameOrMakesIt) {
  ready("House");
  scan();
  ASSERT_TRUE(d.press({"home", "project", "name=Yard", "load_or_create"}));
  EXPECT_EQ(d.shows("project"), "Yard");
  EXPECT_EQ(d.shows("scan_position"), "ScanPos001");
  ASSERT_TRUE(d.press({"project", "name=House", "load_or_create"}));
  EXPECT_EQ(d.shows("scan_position"), "ScanPos002") << "it was loaded, not made again";
  ASSERT_TRUE(d.press({"project", "name=a:b", "load_or_create"}));
  EXPECT_EQ(d.dialog(), "refused");
}

TEST_F(VzI, IsWaitingScanningProcessingAndWaitingAgain) {
  ready();
  scan();
  EXPECT_EQ(d.phase(), "waiting") << "a first position has nothing to be registered to";
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  ASSERT_TRUE(d.press({"home", "start_scan"}));
  EXPECT_EQ(d.fact("opstate"), "scanning");
  d.scanned();
  d->tick(192);  // 188 s of Panorama_40, and storing
  EXPECT_EQ(d.fact("opstate"), "processing");
  linked(0.003, 0.7);
  EXPECT_EQ(d.fact("opstate"), "waiting");
  EXPECT_EQ(d.fact("registration.result"), "ok");
  EXPECT_EQ(d.fact("link"), "joined");
}

TEST_F(VzI, CountsThePositionsUp) {
  ready();
  ASSERT_TRUE(d.press({"registration_now", "registration=off", "back"}));
  EXPECT_EQ(scan().name, "ScanPos001");
  EXPECT_EQ(scan().name, "ScanPos002");
  EXPECT_EQ(d.fact("positions.double"), "0");
}

TEST_F(VzI, RefusesATypedNumberWhileItCountsByItself) {
  ready();
  ASSERT_TRUE(d.press({"scan_position"}));
  const auto refused = d->act("position_number", "7");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("numbering off"), std::string::npos) << refused.error().message;
  ASSERT_TRUE(d.press({"auto_number=off", "position_number=7"}));
}

TEST_F(VzI, GivesTheSameNumberTwiceWithTheCountingOff) {
  ready();
  ASSERT_TRUE(d.press({"registration_now", "registration=off", "back", "scan_position", "auto_number=off",
                       "position_number=5", "back"}));
  EXPECT_EQ(scan().name, "ScanPos005");
  ASSERT_TRUE(d->hand("stand_at", "S2"));
  ASSERT_TRUE(d.press({"home", "start_scan"}));
  EXPECT_EQ(d.dialog(), "position_question");
  ASSERT_TRUE(d.press({"cancel"}));
  const auto order = scan();
  EXPECT_EQ(order.name, "Scan2_ScanPos005");
  EXPECT_EQ(order.number, 5);
  EXPECT_EQ(d.fact("positions.double"), "2") << "they cannot be told apart by their number";
  ASSERT_TRUE(d.press({"home", "scan_position", "auto_number=on"}));
  EXPECT_EQ(d.shows("next_name"), "ScanPos006");
}

// A device that joined each position to the one before could not go back to the first room.
TEST_F(VzI, RegistersAgainstTheNearestEarlierPositionOrTheOneOnView) {
  ready();
  ASSERT_TRUE(d.press({"registration_now", "registration=off", "back"}));
  for (int i = 0; i < 4; ++i) scan();
  auto& setups = d->change().projects[0].setups;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    setups[i].file = "pos" + std::to_string(i + 1);
    setups[i].plan_x_m = i == 3 ? 1 : 10.0 * static_cast<double>(i);  // the fourth is beside the first
  }
  const auto against = [&] {
    EXPECT_TRUE(d.press({"home", "registration_now", "register_now"}));
    const auto order = d->takeOrder();
    EXPECT_TRUE(order && std::holds_alternative<LinkOrder>(*order));
    return order ? std::get<LinkOrder>(*order) : LinkOrder{};
  };
  TestDevice other = d;
  EXPECT_EQ(against().to_file, "pos1");
  d = other;
  ASSERT_TRUE(d.press({"home", "positions", "position_list=1"}));
  EXPECT_EQ(against().to_file, "pos2");
  EXPECT_EQ(d->state().linking, "pos4");
}

TEST_F(VzI, NamesPositionsByTheirBase) {
  ready();
  ASSERT_TRUE(d.press({"scan_position", "base=Hall_", "set_base"}));
  EXPECT_EQ(d.shows("next_name"), "Hall_001");
  ASSERT_TRUE(d.press({"base=a|b", "set_base"}));
  EXPECT_EQ(d.dialog(), "refused");
}

// Grids: section 1.4; times of 50 and 30: S32.
TEST_F(VzI, OffersThePatternsByTheirStep) {
  ready();
  ASSERT_TRUE(d.press({"pattern_now"}));
  EXPECT_EQ(d.fact("setting.pattern"), "panorama_40") << "the standard of the maker's package [S31]";
  const std::pair<const char*, const char*> kPatterns[] = {
      {"panorama_100", "3.6 M (3600 × 1000)"},  {"panorama_50", "14.4 M (7200 × 2000)"},
      {"panorama_40", "22.5 M (9000 × 2500)"},  {"panorama_30", "40.0 M (12000 × 3333)"},
      {"panorama_20", "90.0 M (18000 × 5000)"}, {"overview", "0.9 M (1800 × 500)"}};
  for (const auto& [pattern, points] : kPatterns) {
    ASSERT_TRUE(d.press({std::string("pattern=") + pattern}));
    EXPECT_EQ(d.shows("expected_points"), points);
  }
  ASSERT_TRUE(d.press({"pattern=panorama_50"}));
  EXPECT_EQ(d.shows("expected_time"), "2:00");
  ASSERT_TRUE(d.press({"pattern=panorama_30"}));
  EXPECT_EQ(d.shows("expected_time"), "5:00");
}

TEST_F(VzI, TakesAPatternOfSixNumbers) {
  ready();
  ASSERT_TRUE(d.press({"pattern_now"}));
  EXPECT_EQ(d.shows("line_start"), "30");
  EXPECT_EQ(d.shows("line_stop"), "130");
  ASSERT_TRUE(d.press({"line_start=60", "line_stop=110", "line_step=0.05", "frame_start=90", "frame_stop=180",
                       "frame_step=0.02", "take_pattern"}));
  EXPECT_EQ(d.fact("setting.pattern"), "custom");
  EXPECT_EQ(d.fact("setting.vertical_to"), "30") << "lines are counted from the zenith";
  EXPECT_EQ(d.fact("setting.vertical_from"), "-20");
  EXPECT_EQ(d.shows("expected_points"), "4.5 M (4500 × 1000)") << "90 / 0.02 columns, 50 / 0.05 rows";
  EXPECT_EQ(d.shows("expected_time"), "1:15") << "18000 x 2000 points / 120000 per second, a quarter of the turn";
  ASSERT_TRUE(d.press({"pattern=panorama_100"}));
  EXPECT_EQ(d.shows("expected_points"), "3.6 M (3600 × 1000)") << "a pattern with a name has the whole field";
  for (const auto& [widget, value, said] :
       {std::tuple("line_start", "-2", "from 30 to 130"), std::tuple("line_stop", "131", "from 30 to 130"),
        std::tuple("frame_stop", "361", "from 0 to 360")}) {
    const auto refused = d->act(widget, value);
    ASSERT_FALSE(refused) << widget;
    EXPECT_NE(refused.error().message.find(said), std::string::npos) << refused.error().message;
  }
  TestDevice falling = d;
  ASSERT_TRUE(falling.press({"line_start=120", "line_stop=110", "take_pattern"}));
  EXPECT_EQ(falling.dialog(), "refused") << "the lines end before they start";
  ASSERT_TRUE(d.press({"line_step=0.001", "take_pattern"}));
  EXPECT_EQ(d.dialog(), "refused") << "finer than the instrument steps";
}

// Range by programme: section 1.3; rates of 42 and 125 thousand points per second.
TEST_F(VzI, ReachesFurtherAndTakesLongerWithASlowProgramme) {
  ready();
  ASSERT_TRUE(d.press({"pattern_now", "pattern=panorama_50", "programme=1200khz"}));
  EXPECT_EQ(d.shows("expected_range"), "250.00 m");
  EXPECT_EQ(d.shows("expected_time"), "2:00");
  ASSERT_TRUE(d.press({"programme=100khz"}));
  EXPECT_EQ(d.shows("expected_range"), "800.00 m");
  EXPECT_EQ(d.shows("expected_time"), "5:43") << "14.4 M / 42000 per second";
}

TEST_F(VzI, PhotographsDuringTheScanOrAfterIt) {
  ready();
  ASSERT_TRUE(d.press({"camera"}));
  EXPECT_TRUE(d.refuses("image_mode", "during_scan")) << "the camera is disabled";
  ASSERT_TRUE(d.press({"images=on", "image_mode=after_scan"}));
  EXPECT_EQ(d.shows("image_time"), "1:00");
  ASSERT_TRUE(d.press({"image_overlap=50"}));
  EXPECT_EQ(d.shows("image_time"), "1:30") << "0.75 / 0.5 imaging";
  TestDevice after = d;
  ASSERT_TRUE(after.press({"back", "start_scan"}));
  EXPECT_TRUE(after.scanned().panorama);
  after->tick(189);
  EXPECT_EQ(after.phase(), "photographing");
  ASSERT_TRUE(d.press({"images=automatic", "image_mode=during_scan", "back", "start_scan"}));
  EXPECT_TRUE(d.scanned().panorama);
  d->tick(189);
  EXPECT_EQ(d.phase(), "storing");
}

TEST_F(VzI, SaysFastRegFailedWhenNothingMatches) {
  ready();
  scan();
  scan();
  linked(0, 0, false);
  EXPECT_EQ(d.phase(), "waiting");
  EXPECT_EQ(d.dialog(), "fast_reg_failed");
  ASSERT_TRUE(d.press({"ok", "register_now"}));
  linked(0.004, 0.6);
  EXPECT_EQ(d.fact("registration.result"), "ok");
}

TEST_F(VzI, SaysScanRegFailedWhenTheMatchIsNotGoodEnoughForTheMode) {
  struct Case {
    const char* mode;
    double error_m, overlap;
    const char* result;
  };
  const Case kCases[] = {{"AUTO", 0.02, 0.3, "ok"},
                         {"AUTO", 0.021, 0.5, "scan_failed"},
                         {"AUTO", 0.01, 0.29, "scan_failed"},
                         {"INDOOR_SMALL", 0.01, 0.4, "ok"},
                         {"INDOOR_SMALL", 0.011, 0.5, "scan_failed"},
                         {"INDOOR_LARGE", 0.02, 0.3, "ok"},
                         {"OUTDOOR_URBAN", 0.03, 0.25, "ok"},
                         {"OUTDOOR_URBAN", 0.031, 0.5, "scan_failed"},
                         {"OUTDOOR_NON_URBAN", 0.1, 0.2, "ok"},
                         {"MINING_MEDIUM", 0.05, 0.25, "ok"},
                         {"MINING_LARGE", 0.1, 0.2, "ok"},
                         {"MINING_LARGE", 0.11, 0.5, "scan_failed"}};
  ready();
  scan();
  scan();
  ASSERT_TRUE(d->takeOrder());
  const TestDevice waiting = d;
  for (const auto& c : kCases) {
    d = waiting;
    d->change().values["registration_mode"] = c.mode;
    d->linkDone({true, c.error_m, c.overlap, 0, 0});
    d->tick(60);
    EXPECT_EQ(d.fact("registration.result"), c.result) << c.mode << ' ' << c.error_m;
    EXPECT_EQ(d.dialog(), c.result == std::string("ok") ? "" : "scan_reg_failed");
    EXPECT_EQ(d.fact("link"), c.result == std::string("ok") ? "joined" : "failed");
  }
}

TEST_F(VzI, StoresWithoutProcessingWhenRegistrationIsOff) {
  ready();
  ASSERT_TRUE(d.press({"registration_now", "registration=off", "back"}));
  scan();
  scan();
  EXPECT_EQ(d.phase(), "waiting");
  EXPECT_FALSE(d->takeOrder());
}

TEST_F(VzI, SearchesReflectorsAfterTheScanWithinTheLimits) {
  ready();
  ASSERT_TRUE(d.press({"reflectors", "reflector_search=on", "limit_from=3", "limit_to=20", "back"}));
  scan();
  EXPECT_EQ(d.phase(), "searching");
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<TargetOrder>(*order));
  EXPECT_EQ(std::get<TargetOrder>(*order).file, "scans/House/ScanPos001.e57");
  d->targetsDone({fittedSphere("near", 100, 2.5), fittedSphere("good", 100, 10), fittedSphere("far", 100, 21)});
  d->tick(20);
  EXPECT_EQ(d.phase(), "waiting");
  EXPECT_EQ(d.screen(), "reflectors");
  EXPECT_EQ(d.fact("newest.targets"), "1");
}

TEST_F(VzI, SaysInItsLanguageWhyAReflectorIsNotTaken) {
  ready();
  ASSERT_TRUE(d.press({"reflectors", "reflector_search=on", "limit_from=3", "limit_to=20", "back"}));
  scan();
  ASSERT_TRUE(d->takeOrder());
  auto hidden = fittedSphere("hidden", 0, 10);
  hidden.found = false;
  hidden.why_not = "no_fit.hidden";
  d->targetsDone({fittedSphere("near", 100, 2.5), hidden});
  d->tick(20);
  const auto listed = [&](const std::string& language) {
    d->change().language = language;
    std::string text;
    const auto screen = d->screen();
    for (const auto& option : findWidget(screen, "target_list")->options) text += option.label + "\n";
    return text;
  };
  EXPECT_EQ(listed("en"), "near  outside the limits\nhidden  hidden from this station\n");
  EXPECT_EQ(listed("de"), "near  außerhalb der Grenzen\nhidden  von diesem Standpunkt verdeckt\n");
  EXPECT_NE(listed("pl").find("zasłonięta z tego stanowiska"), std::string::npos);
}

// N = A / (s r)^2 with five points: 50 mm, 0.1 degrees: 11.35 m; 100 mm twice that.
TEST_F(VzI, SeesALargerReflectorFurther) {
  ready();
  ASSERT_TRUE(d.press({"pattern_now", "pattern=panorama_100", "back", "reflectors"}));
  EXPECT_EQ(d.shows("model_reach"), "11.35 m");
  ASSERT_TRUE(d.press({"reflector_model=flat_100"}));
  EXPECT_EQ(d.shows("model_reach"), "22.71 m");
}

TEST_F(VzI, SearchesReflectorsBeforeItRegisters) {
  ready();
  scan();
  ASSERT_TRUE(d.press({"home", "reflectors", "reflector_search=on", "home"}));
  scan();
  ASSERT_EQ(d.phase(), "searching");
  ASSERT_TRUE(d->takeOrder());
  d->targetsDone({});
  d->tick(11);
  linked(0.002, 0.7);
  EXPECT_EQ(d.fact("registration.result"), "ok");
}

TEST_F(VzI, NeedsFourControlPointsWithANameAndThreeCoordinates) {
  ready();
  ASSERT_TRUE(d.press({"control_points"}));
  for (const char* wrong : {"control_point=P1", "control_point=P1,1,2", "control_point=P1,1,2,x",
                            "control_point=,1,2,3", "control_point=P1,1,2,3,4"}) {
    TestDevice one = d;
    ASSERT_TRUE(one.press({wrong, "add_point"}));
    EXPECT_EQ(one.dialog(), "refused") << wrong;
  }
  for (const char* point : {"control_point=P1,0,0,0", "control_point=P2;10;0;0.5", "control_point=P3,10,8,0"})
    ASSERT_TRUE(d.press({point, "add_point"}));
  EXPECT_TRUE(d.refuses("georeference")) << "three are too few";
  TestDevice cleared = d;
  ASSERT_TRUE(cleared.press({"clear_points"}));
  EXPECT_EQ(cleared.fact("control_points"), "0");
  ASSERT_TRUE(d.press({"control_point=P4,0,8,1", "add_point", "georeference"}));
  EXPECT_EQ(d.dialog(), "refused") << "none of them was found as a reflector";
  ASSERT_TRUE(d.press({"ok", "back"}));
  scan();
  ASSERT_TRUE(d.press({"reflectors", "measure_targets"}));
  ASSERT_TRUE(d->takeOrder());
  d->targetsDone({fittedSphere("P1", 100, 5), fittedSphere("P2", 100, 6), fittedSphere("P4", 100, 7),
                  fittedSphere("Other", 100, 5)});
  ASSERT_TRUE(d.press({"home", "control_points", "georeference"}));
  EXPECT_EQ(d.shows("georeferenced"), "Yes");
}

TEST_F(VzI, StoresOnTheMediumThatIsChosen) {
  ready();
  ASSERT_TRUE(d.press({"registration_now", "registration=off", "back", "storage_now"}));
  EXPECT_EQ(d.shows("free"), "1.0 TB");
  ASSERT_TRUE(d.press({"storage=usb"}));
  EXPECT_EQ(d.shows("free"), "64.0 GB");
  ASSERT_TRUE(d.press({"back"}));
  scan();  // 1 M points of 23.8 bytes
  ASSERT_TRUE(d.press({"home", "storage_now"}));
  EXPECT_NEAR(d->fact("card.free")->number.value(), 64e9 - 23.8e6, 1);
  ASSERT_TRUE(d.press({"storage=ssd", "back"}));
  scan();
  EXPECT_NEAR(d->fact("card.free")->number.value(), 1e12 - 23.8e6, 1);
  ASSERT_TRUE(d.press({"home", "storage_now", "storage=usb", "format", "yes"}));
  EXPECT_EQ(d.fact("setups.all"), "1") << "what is on the SSD stays";
  EXPECT_EQ(d.fact("newest.name"), "ScanPos002");
}

TEST_F(VzI, RefusesAMissingLockedOrFullMediumButHasItsSsdAlways) {
  ready();
  for (const auto& [trouble, dialog] : {std::pair{"card_missing", "card_absent"},
                                        std::pair{"card_locked", "card_locked"}, std::pair{"card_full", "card_full"}}) {
    TestDevice one = d;
    ASSERT_TRUE(one.press({"storage_now", "storage=sd", "back"}));
    ASSERT_TRUE(one->trouble(trouble));
    ASSERT_TRUE(one.press({"start_scan"}));
    EXPECT_EQ(one.dialog(), dialog);
    ASSERT_TRUE(one.press({"ok", "storage_now", "storage=ssd", "back", "start_scan"}));
    EXPECT_EQ(one.phase(), "scanning");
  }
}

TEST_F(VzI, LosesTheScanWithTheStickButNotFromTheSsd) {
  ready();
  for (const char* medium : {"usb", "ssd"}) {
    TestDevice one = d;
    ASSERT_TRUE(one.press({"storage_now", std::string("storage=") + medium, "back", "start_scan"}));
    one.scanned();
    ASSERT_TRUE(one->hand("remove_card"));
    EXPECT_EQ(one.phase(), medium == std::string("usb") ? "waiting" : "scanning");
    EXPECT_EQ(one.dialog(), medium == std::string("usb") ? "card_lost" : "");
  }
}

TEST_F(VzI, AsksWhenLevelTemperatureOrDistanceAreOutsideItsLimits) {
  ready();
  for (const char* trouble : {"too_hot", "not_warm", "tilted", "too_near"}) {
    TestDevice one = d;
    ASSERT_TRUE(one->trouble(trouble));
    if (!one.dialog().empty()) {
      ASSERT_TRUE(one.press({"ok"}));
    }
    ASSERT_TRUE(one.press({"start_scan"}));
    EXPECT_TRUE(one.dialog().ends_with("_question")) << trouble;
    ASSERT_TRUE(one.press({"continue"}));
    EXPECT_EQ(one.phase(), "scanning") << trouble;
  }
}

TEST_F(VzI, TellsThatItWasPushedAndStopsWhenAsked) {
  ready();
  ASSERT_TRUE(d.press({"start_scan"}));
  d.scanned();
  TestDevice other = d;
  ASSERT_TRUE(d->trouble("tripod_moved"));
  EXPECT_EQ(d.phase(), "error");
  d.scanned();
  ASSERT_TRUE(d.press({"ok", "keep"}));
  d->tick(10);
  EXPECT_EQ(d.fact("newest.tripod_moved"), "yes");
  ASSERT_TRUE(other.press({"stop", "yes"}));
  EXPECT_EQ(other.phase(), "waiting");
  EXPECT_EQ(other.fact("setups"), "0");
}

TEST_F(VzI, TransfersByCableOrWlan) {
  ready();
  scan();
  ASSERT_TRUE(d.press({"home", "storage_now", "by_cable"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order && std::holds_alternative<TransferOrder>(*order));
  d->transferDone(std::get<TransferOrder>(*order).files);
  EXPECT_EQ(d.dialog(), "transferred");
}

}  // namespace
}  // namespace standpoint
