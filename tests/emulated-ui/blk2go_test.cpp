// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include "core/data_folder.h"
#include "emulated-ui/host.h"
#include "emulated-ui/walk_motion.h"
#include "emulated-ui/walk_scan.h"
#include "project/verb.h"
#include "tests/emulated-ui/on_foot.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

TestDevice inHand() { return withWalker("leica-blk2go"); }

TEST(Blk2go, LightsItsRingByWhatItDoes) {
  TestDevice d("leica-blk2go");
  EXPECT_EQ(d.fact("carried.light"), "off");
  ASSERT_TRUE(d.press({"key"}));
  EXPECT_EQ(d.fact("carried.light"), "yellow flashing");
  d->tick(30);
  EXPECT_EQ(d.fact("carried.light"), "green");
  EXPECT_EQ(d.screen(), "home");
}

TEST(Blk2go, StartsWithAProjectAndInSomebodysHandsOnly) {
  TestDevice d("leica-blk2go");
  ASSERT_TRUE(d.press({"key"}));
  d->tick(30);
  ASSERT_TRUE(d.press({"start"}));
  EXPECT_EQ(d.dialog(), "no_project");
  d->change().dialog.clear();
  ASSERT_TRUE(d.press({"project", "new_project", "create", "start"}));
  EXPECT_EQ(d.dialog(), "not_placed");
}

TEST(Blk2go, InitialisesAgainWhereSomebodyWalksMeanwhile) {
  auto d = inHand();
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

TEST(Blk2go, WalksStraightAndTurnsOnTheSpot) {
  auto d = inHand();
  beginToRecord(d);
  ASSERT_TRUE(d->hand("walk_to", "4,0,0.8"));
  ASSERT_TRUE(d->hand("walk_to", "4,2,0.5"));
  d->tick(5);
  EXPECT_NEAR(d->state().walk.at->front(), 4, 1e-9);
  d->tick(100);
  const auto& way = d->state().walk.way;
  ASSERT_EQ(way.size(), 5U) << "beginning, set off, first corner, turned, end";
  EXPECT_NEAR(way[3][2] - way[2][2], std::numbers::pi / 2 / (kTurn_rad_per_m * 0.5), 1e-9);
  EXPECT_NEAR(way[4][2] - way[3][2], 4, 1e-9) << "2 m at 0.5 m/s";
  EXPECT_EQ(d.fact("carried.walking"), "no");
  EXPECT_NEAR(d->number("carried.length"), 6, 1e-9);
  EXPECT_NEAR(d->number("carried.gap"), std::hypot(4, 2), 1e-9);
}

TEST(Blk2go, IsWhereItWouldBeHoweverLongTheStepsOfItsClockAre) {
  auto a = inHand(), b = inHand();
  for (auto* d : {&a, &b}) {
    beginToRecord(*d);
    ASSERT_TRUE((*d)->hand("walk_to", "4,0,0.8"));
    ASSERT_TRUE((*d)->hand("walk_to", "1,3,0.5"));
  }
  a->tick(60);
  for (int i = 0; i < 600; ++i) b->tick(0.1);
  const auto &one = a->state().walk.way, &many = b->state().walk.way;
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(one[i][k], many[i][k], 1e-6);
}

TEST(Blk2go, TurnsRedWhileSomebodyIsTooFast) {
  auto d = inHand();
  beginToRecord(d);
  EXPECT_EQ(d.fact("carried.light"), "green spinning");
  ASSERT_TRUE(d->hand("walk_to", "15,0,1.5"));
  d->tick(2);
  EXPECT_EQ(d.fact("carried.light"), "red flashing");
  EXPECT_EQ(d.fact("carried.hurried"), "yes");
  d->tick(20);
  EXPECT_EQ(d.fact("carried.light"), "green spinning");
  EXPECT_NEAR(d->number("carried.hurried_for"), 10, 0.01);
}

TEST(Blk2go, KeepsItsWayAndNoPointsInAPause) {
  auto d = inHand();
  beginToRecord(d);
  const double begun_s = d->number("carried.time");
  d->tick(3);
  ASSERT_TRUE(d.press({"pause"}));
  ASSERT_TRUE(d->hand("walk_to", "3,0,1"));
  d->tick(5);
  ASSERT_TRUE(d.press({"resume"}));
  d->tick(2);
  ASSERT_TRUE(d.press({"stop"}));
  const auto& walk = d->state().walk;
  ASSERT_EQ(walk.pauses.size(), 1U);
  EXPECT_NEAR(walk.pauses[0][0] - begun_s, 3, 1e-9);
  EXPECT_NEAR(walk.pauses[0][1] - begun_s, 8, 1e-9);
  EXPECT_NEAR(walk.way.back()[0], 3, 1e-9);
}

TEST(Blk2go, MeasuresAControlPointOnlyWhereThereIsOneAndOnlyAtRest) {
  auto d = inHand();
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

TEST(Blk2go, RecordsAWalkAndGivesItToTheOffice) {
  auto d = inHand();
  beginToRecord(d);
  ASSERT_TRUE(d->hand("walk_to", "4,0,0.8"));
  d->tick(10);
  ASSERT_TRUE(d.press({"stop"}));
  d->tick(10);
  EXPECT_EQ(d.screen(), "walk");
  EXPECT_NE(d.shows("walk_length"), "");
  ASSERT_TRUE(d.press({"home", "waiting_walk", "closures=off", "static_scans=on", "process"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order);
  const auto& scan = std::get<ScanOrder>(*order);
  ASSERT_TRUE(scan.walk);
  EXPECT_EQ(scan.walk->way.size(), 4U) << "beginning, set off, arrived, end";
  EXPECT_FALSE(scan.walk->closures);
  EXPECT_TRUE(scan.walk->stations);
  d.finish(scan);
  d->tick(1000);
  EXPECT_EQ(d.screen(), "result");
  EXPECT_EQ(d.fact("setups"), "1");
  EXPECT_EQ(d.fact("carried.unprocessed"), "no");
}

TEST(Blk2go, AWalkThatIsDiscardedIsGone) {
  auto d = inHand();
  beginToRecord(d);
  d->tick(10);
  ASSERT_TRUE(d.press({"stop"}));
  d->tick(10);
  ASSERT_TRUE(d.press({"home", "start"}));
  EXPECT_EQ(d.dialog(), "unprocessed_question");
  ASSERT_TRUE(d.press({"cancel", "waiting_walk", "discard", "yes"}));
  EXPECT_EQ(d.fact("carried.unprocessed"), "no");
  EXPECT_EQ(d.screen(), "home");
}

TEST(Blk2go, DoorsAreOpenedBeforeOrOnTheWay) {
  auto d = inHand();
  EXPECT_EQ(d.fact("carried.doors"), "closed");
  ASSERT_TRUE(d->hand("open_doors"));
  EXPECT_EQ(d.fact("carried.doors"), "open");
  auto late = inHand();
  beginToRecord(late);
  EXPECT_FALSE(late->hand("open_doors"));
}

TEST(OnFoot, ATripodIsNotCarriedAbout) {
  TestDevice d("leica-rtc360");
  for (const char* hand : {"walk_to", "stand_still", "open_doors"}) EXPECT_FALSE(d->hand(hand, "1,1")) << hand;
}

TEST(OnFoot, WhereTheyGoIsTyped) {
  auto d = inHand();
  for (const char* wrong : {"", "1", "1,2,0", "1,2,9", "a,b", "1,2,0.5,4"})
    EXPECT_FALSE(d->hand("walk_to", wrong)) << wrong;
  ASSERT_TRUE(d->hand("walk_to", "1,2"));
  ASSERT_TRUE(d->hand("stand_still"));
  EXPECT_TRUE(d->state().walk.legs.empty());
}

TEST(OnFoot, WhatIsPutDownIsTakenUpByWhoWalks) {
  auto d = inHand();
  EXPECT_EQ(d.fact("carried.put_down"), "no");
  ASSERT_TRUE(d->hand("walk_to", "5,0,1"));
  d->tick(2);
  ASSERT_TRUE(d->hand("put_down"));
  d->tick(2);
  EXPECT_EQ(d.fact("carried.put_down"), "yes");
  EXPECT_NEAR(d->state().walk.at->front(), 2, 1e-9) << "it is not carried on";
  ASSERT_TRUE(d->hand("walk_to", "3,0,1"));
  EXPECT_EQ(d.fact("carried.put_down"), "no");
}

TEST(OnFoot, AnyDeviceMayRemindOfTimeAndNoticeRest) {
  auto definition = loadDevice(*findDevice("leica-blk2go")).value()->definition;
  definition.walk = {.reminders_min = {1}, .rest_s = 20};
  definition.transitions.insert(definition.transitions.begin(),
                                {{.from = {PhaseId{"recording"}}, .event = EngineEvent::reminder, .ask = "battery_low"},
                                 {.from = {PhaseId{"recording"}}, .event = EngineEvent::rested, .ask = "hold_still"}});
  const auto whole = loadDevice(*findDevice("leica-blk2go")).value();
  const auto type = makeDeviceType(definition, {}, whole->instrument, whole->words);
  ASSERT_TRUE(type) << describe(type.error());
  for (const double step_s : {0.5, 7.0, 30.0}) {
    TestDevice d(*type);
    ASSERT_TRUE(d.press({"key"}));
    d->tick(30);
    ASSERT_TRUE(d.press({"project", "new_project", "create"}));
    ASSERT_TRUE(d->hand("walk_to", "0,0"));
    beginToRecord(d);
    const double begun_s = d->number("carried.time");
    int rests = 0, reminders = 0;
    ASSERT_TRUE(d->hand("walk_to", "10,0,1"));
    for (double t = begun_s; t < 90; t += step_s) {
      d->tick(step_s);
      rests += d.dialog() == "hold_still" ? 1 : 0;
      reminders += d.dialog() == "battery_low" ? 1 : 0;
      if (!d.dialog().empty()) d->change().dialog.clear();
    }
    EXPECT_EQ(rests, 1) << step_s << ": once for each rest";
    EXPECT_EQ(reminders, 1) << step_s;
  }
}

TEST(OnFoot, TheMapCountsFloorsCeilingsAndWhereBothWereSeen) {
  SeenMap map;
  map.columns = 4, map.rows = 2;
  map.cells = {SeenMap::kFloor,
               SeenMap::kFloor | SeenMap::kCeiling,
               SeenMap::kCeiling,
               0,
               SeenMap::kWall,
               SeenMap::kFloor | SeenMap::kWall,
               0,
               0};
  EXPECT_DOUBLE_EQ(map.floor_m2(), 3 * 0.0625);
  EXPECT_DOUBLE_EQ(map.ceiling_m2(), 2 * 0.0625);
  EXPECT_DOUBLE_EQ(map.bothShare(), 0.25);
  EXPECT_DOUBLE_EQ(SeenMap().bothShare(), 0);
}

// The sample house, and a walk of 11 s in its living room.
class OnFootInTheHouse : public testing::Test {
 protected:
  static const Document& house() {
    static const Document document = [] {
      Progress quiet;
      auto outcome =
          runVerb(*findVerb(verbs(), "import"), {}, {{"files", {(samplesFolder() / "house.ifc").string()}}}, quiet);
      EXPECT_TRUE(outcome) << describe(outcome.error());
      return outcome->document;
    }();
    return document;
  }
  static const std::shared_ptr<const RayScene>& scene() {
    static const auto built = [] {
      Progress quiet;
      return *RayScene::build(house().environment(), quiet);
    }();
    return built;
  }
  static WalkedWay shortWalk() { return {{4, 1.6, 0}, {4, 1.6, 1}, {5.5, 1.6, 4}, {5.5, 1.6, 6}, {5.5, 3.2, 10}}; }
  static ScanOrder order(WalkOrder walk) {
    ScanOrder order;
    order.instrument = "leica-blk2go";
    order.project = "House";
    order.name = "Walk 001";
    order.walk = std::move(walk);
    return order;
  }
};

TEST_F(OnFootInTheHouse, ABodyIsNearTheStraightWayAndAtTheHeightOfAHand) {
  const Carrier& hand = carrierOfMount("hand");
  const double height_m = hand.limits.height_m;
  const auto carried = motionOf(shortWalk(), *scene(), *house().georeference, hand, "w", 1);
  ASSERT_TRUE(carried) << describe(carried.error());
  EXPECT_NEAR(carried->seconds(), 10, 1e-6);
  const Eigen::Vector3d shift = house().georeference->shift_m;
  const auto at = [&](double t) { return Eigen::Vector3d(carried->path->pose(t).translation + shift); };
  EXPECT_LT((at(0) - Eigen::Vector3d(4, 1.6, height_m)).norm(), 0.05);
  EXPECT_LT((at(2.5) - Eigen::Vector3d(4.75, 1.6, height_m)).norm(), 0.05);
  EXPECT_LT((at(10) - Eigen::Vector3d(5.5, 3.2, height_m)).norm(), 0.2);
  const Eigen::Vector3d ahead = carried->path->pose(9).rotation * Eigen::Vector3d::UnitX();
  EXPECT_GT(ahead.y(), 0.99) << "it looks where it goes";
  EXPECT_FALSE(motionOf({{4, 1.6, 0}, {500, 500, 9}}, *scene(), *house().georeference, hand, "w", 1))
      << "no floor there";
}

TEST_F(OnFootInTheHouse, TheMapGrowsByTheWayAlone) {
  WalkState walk;
  walk.recording = true;
  const auto grown = [&](int steps) {
    WalkMap map;
    map.begin(scene(), *house().georeference, carrierOfMount("hand").limits.height_m);
    std::shared_ptr<const SeenMap> seen;
    for (int i = 0; i <= steps; ++i) {
      walk.way = {{4, 1.6, 0}};
      walk.at = {4 + 1.5 * i / steps, 1.6};
      walk.recorded_s = 2.0 * i / steps;
      if (auto more = map.grow(walk)) seen = more;
    }
    return seen;
  };
  const auto few = grown(2), many = grown(30);
  ASSERT_TRUE(few && many);
  EXPECT_EQ(few->cells, many->cells);
  EXPECT_GT(few->floor_m2(), 5);
  EXPECT_LT(few->floor_m2(), 60) << "of a room with open doors and windows";
}

TEST_F(OnFootInTheHouse, ARoomHasACeilingAndTheStreetHasNone) {
  const auto seenFrom = [&](double x_m, double y_m) {
    WalkState walk;
    walk.recording = true;
    walk.way = {{x_m, y_m, 0}};
    walk.at = {x_m, y_m};
    WalkMap map;
    map.begin(scene(), *house().georeference, carrierOfMount("body").limits.height_m);
    return map.grow(walk);
  };
  const auto room = seenFrom(4, 1.6), street = seenFrom(7.5, -12);
  ASSERT_TRUE(room && street);
  EXPECT_GT(room->ceiling_m2(), 3);
  EXPECT_LT(street->ceiling_m2(), 0.1 * street->floor_m2());
  EXPECT_GT(room->bothShare(), 5 * street->bothShare());
}

TEST_F(OnFootInTheHouse, WhatIsWornIsHigherAndSteadierThanWhatIsHeld) {
  const Carrier &hand = carrierOfMount("hand"), &back = carrierOfMount("body");
  const auto held = motionOf(shortWalk(), *scene(), *house().georeference, hand, "w", 1);
  const auto worn = motionOf(shortWalk(), *scene(), *house().georeference, back, "w", 1);
  ASSERT_TRUE(held && worn);
  const auto turns = [](const CarriedMotion& motion) {
    double sum = 0;
    for (double t = 0.5; t < 9.5; t += 0.05)
      sum += motion.truth->pose(t).rotation.angularDistance(motion.path->pose(t).rotation);
    return sum;
  };
  EXPECT_NEAR((worn->path->pose(5).translation - held->path->pose(5).translation).z(),
              back.limits.height_m - hand.limits.height_m, 1e-6);
  EXPECT_LT(turns(*worn), turns(*held));
}

TEST_F(OnFootInTheHouse, AWallIsInTheWayAndADoorIsNot) {
  WalkState walk;
  walk.recording = true;
  walk.way = {{4, 1.6, 0}};
  walk.at = {4, 1.6};
  WalkMap map;
  map.begin(scene(), *house().georeference, carrierOfMount("hand").limits.height_m);
  EXPECT_EQ(map.between({4, 1.6}, {4, 6}), "") << "nothing is known before the first look";
  ASSERT_TRUE(map.grow(walk));
  EXPECT_EQ(map.between({4, 1.6}, {5.5, 1.6}), "");
  EXPECT_EQ(map.between({4, 1.6}, {3, 6}), "Kitchen wall");
  EXPECT_EQ(map.between({5.5, 3.45}, {7.2, 3.45}), "") << "the living room door";
}

TEST_F(OnFootInTheHouse, TheOfficeMakesTheRealScanOfAWalkAndPausesLeaveNoPoints) {
  TemporaryFolder folder;
  Progress quiet;
  const auto whole = scanWalk(house(), order({.way = shortWalk()}), {folder.path() / "Walk 001.e57", 1, false}, quiet);
  ASSERT_TRUE(whole) << describe(whole.error());
  const auto& scan = whole->trajectory.scans.back();
  EXPECT_GT(scan.points, 100'000U);
  EXPECT_NEAR(static_cast<double>(scan.pulses), 10 * 420'000.0 / 16, 0.02 * 10 * 420'000.0 / 16);
  EXPECT_TRUE(std::filesystem::exists(whole->trajectory.file));
  EXPECT_EQ(whole->result.errors.size(), 41U) << "each quarter of a second";
  EXPECT_LT(std::abs(whole->result.errors.back()[2]), 0.05);
  const auto half = scanWalk(house(), order({.way = shortWalk(), .pauses = {{2, 7}}}),
                             {folder.path() / "Walk 002.e57", 1, false}, quiet);
  ASSERT_TRUE(half) << describe(half.error());
  EXPECT_NEAR(static_cast<double>(half->trajectory.scans.back().pulses), 0.5 * static_cast<double>(scan.pulses),
              0.01 * static_cast<double>(scan.pulses));
}

}  // namespace
}  // namespace standpoint
