// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "tests/emulated-ui/x7.h"

namespace standpoint {
namespace {

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
  EXPECT_FALSE(d->newestSetup()->link->joined) << "neither the map nor what is handed over goes by it";
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
  ASSERT_TRUE(d.press({"registration", "turn=-170", "refine"}));  // laid back by hand, ten degrees short
  const auto refined = d->takeOrder();
  ASSERT_TRUE(refined && std::holds_alternative<LinkOrder>(*refined));
  EXPECT_EQ(std::get<LinkOrder>(*refined).turn_deg, 10);
}

TEST_F(X7, RefinesAllLinksOneAfterTheOther) {
  threeLinked();
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

}  // namespace
}  // namespace standpoint
