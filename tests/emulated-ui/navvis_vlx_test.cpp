// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/on_foot.h"

namespace standpoint {
namespace {

TestDevice onShoulders() { return withWalker("navvis-vlx"); }

TEST(NavVisVlx, LightsItsIndicatorByWhatItDoes) {
  TestDevice d("navvis-vlx");
  EXPECT_EQ(d.fact("carried.light"), "off");
  ASSERT_TRUE(d.press({"key"}));
  EXPECT_EQ(d.fact("carried.light"), "yellow flashing");
  d->tick(70);
  EXPECT_EQ(d.fact("carried.light"), "green");
  EXPECT_EQ(d.screen(), "home");
}

TEST(NavVisVlx, DrivesBothItsModels) {
  for (const char* model : {"navvis-vlx3", "navvis-vlx2"}) {
    auto d = withWalker("navvis-vlx", model);
    EXPECT_EQ(d->type().instrument.id, model);
    EXPECT_EQ(d->type().instrument.moving->mount, "body");
    beginToRecord(d);
  }
}

TEST(NavVisVlx, StartsWithAProjectAndOnSomebodysShouldersOnly) {
  TestDevice d("navvis-vlx");
  ASSERT_TRUE(d.press({"key"}));
  d->tick(70);
  ASSERT_TRUE(d.press({"start"}));
  EXPECT_EQ(d.dialog(), "no_project");
  d->change().dialog.clear();
  ASSERT_TRUE(d.press({"project", "new_project", "create", "start"}));
  EXPECT_EQ(d.dialog(), "not_placed");
}

TEST(NavVisVlx, AsksBeforeItSwitchesOff) {
  auto d = onShoulders();
  ASSERT_TRUE(d.press({"key"}));
  EXPECT_EQ(d.dialog(), "shut_down");
  ASSERT_TRUE(d.press({"no"}));
  EXPECT_EQ(d.phase(), "ready");
  ASSERT_TRUE(d.press({"key", "yes"}));
  d->tick(20);
  EXPECT_EQ(d.phase(), "off");
}

TEST(NavVisVlx, InitialisesAgainWhereSomebodyWalksMeanwhile) {
  auto d = onShoulders();
  ASSERT_TRUE(d.press({"start"}));
  d->sceneDone();
  d->tick(8);
  ASSERT_TRUE(d->hand("walk_to", "1,0,0.5"));
  EXPECT_EQ(d.dialog(), "hold_still");
  d->change().dialog.clear();
  d->tick(3);
  EXPECT_EQ(d.phase(), "initialising");
  d->tick(9);
  EXPECT_EQ(d.phase(), "recording");
}

TEST(NavVisVlx, TurnsRedWhileSomebodyWalksOrTurnsTooFast) {
  auto d = onShoulders();
  beginToRecord(d);
  EXPECT_EQ(d.fact("carried.light"), "green");
  ASSERT_TRUE(d->hand("walk_to", "0,15,1.5"));
  d->tick(0.5);
  EXPECT_EQ(d.fact("carried.speed"), "0") << "they turn on the spot";
  EXPECT_EQ(d.fact("carried.light"), "red flashing");
  d->tick(2);
  EXPECT_EQ(d.fact("carried.speed"), "1.5");
  EXPECT_EQ(d.fact("carried.light"), "red flashing");
  d->tick(20);
  EXPECT_EQ(d.fact("carried.light"), "green");
}

// 1.2 m/s of this instrument, 1.05 m/s of the BLK2GO.
TEST(NavVisVlx, TurnsRedAtThePaceThatTheInstrumentsFileHas) {
  for (const auto& [device, pace, red] : {std::tuple{"navvis-vlx", "1.15", false},
                                          {"navvis-vlx", "1.25", true},
                                          {"leica-blk2go", "1.0", false},
                                          {"leica-blk2go", "1.15", true}}) {
    auto d = withWalker(device);
    beginToRecord(d);
    ASSERT_TRUE(d->hand("walk_to", std::string("15,0,") + pace));
    d->tick(2);
    EXPECT_EQ(d.fact("carried.hurried"), red ? "yes" : "no") << device << " at " << pace;
    EXPECT_EQ(d.fact("carried.light") == "red flashing", red) << device << " at " << pace;
  }
}

TEST(NavVisVlx, KeepsItsWayAndNoPointsInAPause) {
  auto d = onShoulders();
  beginToRecord(d);
  const double begun_s = d->number("carried.time");
  d->tick(3);
  ASSERT_TRUE(d.press({"pause"}));
  EXPECT_EQ(d.fact("carried.light"), "yellow");
  ASSERT_TRUE(d->hand("walk_to", "3,0,1"));
  d->tick(5);
  ASSERT_TRUE(d.press({"resume"}));
  d->tick(2);
  ASSERT_TRUE(d.press({"stop"}));
  const auto& walk = d->state().walk;
  ASSERT_EQ(walk.pauses.size(), 1U);
  EXPECT_NEAR(walk.pauses[0][0] - begun_s, 3, 1e-9);
  EXPECT_NEAR(walk.pauses[0][1] - begun_s, 8, 1e-9);
  EXPECT_NEAR(walk.way.back()[0], 3, 1e-9) << "it knew where it was";
}

TEST(NavVisVlx, RemindsAfterThreeQuartersOfAnHourAndAfterAnHour) {
  auto d = onShoulders();
  beginToRecord(d);
  d->tick(2690 - d->number("carried.time"));
  EXPECT_EQ(d.dialog(), "");
  d->tick(20);
  EXPECT_EQ(d.dialog(), "reminder_45");
  ASSERT_TRUE(d.press({"ok"}));
  d->tick(880);
  EXPECT_EQ(d.dialog(), "");
  d->tick(20);
  EXPECT_EQ(d.dialog(), "reminder_60");
  EXPECT_EQ(d.phase(), "recording") << "it only says so";
}

TEST(NavVisVlx, MeasuresAControlPointOnlyWhereThereIsOneAndOnlyAtRest) {
  auto d = onShoulders();
  d->change().control.targets.push_back({"P1", {2.2, 0, 0}});
  beginToRecord(d);
  EXPECT_TRUE(d.refuses("point")) << "too far away";
  ASSERT_TRUE(d->hand("walk_to", "2,0,1"));
  d->tick(1.8);
  ASSERT_TRUE(d.press({"point"}));
  EXPECT_EQ(d.dialog(), "hold_still");
  d->change().dialog.clear();
  d->tick(5);
  ASSERT_TRUE(d.press({"point"}));
  d->tick(6);
  EXPECT_EQ(d.phase(), "recording");
  ASSERT_EQ(d->state().walk.fixes.size(), 1U);
  EXPECT_EQ(d->state().walk.fixes[0].point, "P1");
}

TEST(NavVisVlx, WantsThreeControlPointsThatAreMoreThanFiveMetresApart) {
  auto d = onShoulders();
  for (const auto& [name, x] : std::map<std::string, double>{{"P1", 0}, {"P2", 3}, {"P3", 9}, {"P4", 15}})
    d->change().control.targets.push_back({name, {x, 0, 0}});
  beginToRecord(d);
  ASSERT_TRUE(d.press({"point"}));
  d->tick(6);
  ASSERT_TRUE(d.press({"point"}));
  EXPECT_EQ(d.dialog(), "") << "the same point once more";
  d->tick(6);
  ASSERT_TRUE(d->hand("walk_to", "3,0,1"));
  d->tick(4);
  EXPECT_NEAR(d->number("carried.nearest_fix"), 3, 1e-9);
  ASSERT_TRUE(d.press({"point"}));
  EXPECT_EQ(d.dialog(), "point_near");
  ASSERT_TRUE(d.press({"cancel"}));
  for (const char* place : {"9,0,1", "15,0,1"}) {
    ASSERT_TRUE(d.press({"stop"}));
    EXPECT_EQ(d.dialog(), "few_points_question") << place;
    ASSERT_TRUE(d.press({"cancel"}));
    ASSERT_TRUE(d->hand("walk_to", place));
    d->tick(10);
    ASSERT_TRUE(d.press({"point"}));
    d->tick(6);
  }
  EXPECT_EQ(d.fact("carried.fixes"), "3");
  ASSERT_TRUE(d.press({"stop"}));
  EXPECT_EQ(d.phase(), "stopping");
}

TEST(NavVisVlx, EndsWithoutControlPointsAndWithFewWhereThatIsWanted) {
  auto none = onShoulders(), few = onShoulders();
  beginToRecord(none);
  ASSERT_TRUE(none.press({"stop"}));
  EXPECT_EQ(none.phase(), "stopping");
  few->change().control.targets.push_back({"P1", {0, 0, 0}});
  beginToRecord(few);
  ASSERT_TRUE(few.press({"point"}));
  few->tick(6);
  ASSERT_TRUE(few.press({"stop", "continue"}));
  EXPECT_EQ(few.phase(), "stopping");
}

TEST(NavVisVlx, RecordsAWalkAndGivesItToTheOffice) {
  auto d = onShoulders();
  beginToRecord(d);
  ASSERT_TRUE(d->hand("walk_to", "4,0,0.8"));
  d->tick(10);
  ASSERT_TRUE(d.press({"stop"}));
  d->tick(20);
  EXPECT_EQ(d.screen(), "walk");
  ASSERT_TRUE(d.press({"home", "waiting_walk", "closures=off", "static_scans=on", "process"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order);
  const auto& scan = std::get<ScanOrder>(*order);
  ASSERT_TRUE(scan.walk);
  EXPECT_EQ(scan.instrument, "navvis-vlx3");
  EXPECT_EQ(scan.walk->way.size(), 4U) << "beginning, set off, arrived, end";
  EXPECT_FALSE(scan.walk->closures);
  EXPECT_TRUE(scan.walk->stations);
  d.finish(scan);
  d->tick(1000);
  EXPECT_EQ(d.screen(), "result");
  EXPECT_EQ(d.fact("setups"), "1");
  EXPECT_EQ(d.fact("carried.unprocessed"), "no");
}

TEST(NavVisVlx, AWalkThatIsDiscardedIsGone) {
  auto d = onShoulders();
  beginToRecord(d);
  d->tick(10);
  ASSERT_TRUE(d.press({"stop"}));
  d->tick(20);
  ASSERT_TRUE(d.press({"home", "start"}));
  EXPECT_EQ(d.dialog(), "unprocessed_question");
  ASSERT_TRUE(d.press({"cancel", "waiting_walk", "discard", "yes"}));
  EXPECT_EQ(d.fact("carried.unprocessed"), "no");
  EXPECT_EQ(d.screen(), "home");
}

}  // namespace
}  // namespace standpoint
