// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/on_foot.h"

namespace standpoint {
namespace {

// On a flat surface at (0, 0), with somebody beside it.
TestDevice onTheFloor() {
  auto d = withWalker("geoslam-zeb-horizon");
  EXPECT_TRUE(d->hand("put_down"));
  return d;
}

TEST(ZebHorizon, LightsItsLampByWhatItDoes) {
  TestDevice d("geoslam-zeb-horizon");
  const auto lamp = [&] { return findPhase(d->type().definition, d.phase())->lamp; };
  EXPECT_EQ(lamp(), "off");
  ASSERT_TRUE(d.press({"key"}));
  EXPECT_EQ(lamp(), "yellow flashing");
  d->tick(40);
  EXPECT_EQ(lamp(), "green");
  EXPECT_EQ(d.screen(), "home");
}

TEST(ZebHorizon, StartsOnAFlatSurfaceOnly) {
  auto d = withWalker("geoslam-zeb-horizon");
  for (const char* start : {"start", "key"}) {
    ASSERT_TRUE(d.press({start}));
    EXPECT_EQ(d.dialog(), "put_down_first") << start;
    ASSERT_TRUE(d.press({"ok"}));
  }
  ASSERT_TRUE(d->hand("put_down"));
  ASSERT_TRUE(d.press({"start"}));
  EXPECT_EQ(d.phase(), "initialising");
}

TEST(ZebHorizon, DoesNotStartWhileSomebodyTakesItUp) {
  auto d = onTheFloor();
  ASSERT_TRUE(d.press({"start"}));
  d->sceneDone();
  d->tick(10);
  ASSERT_TRUE(d->hand("walk_to", "1,0,0.5"));
  EXPECT_EQ(d.dialog(), "hold_still");
  EXPECT_EQ(d.phase(), "ready");
  ASSERT_TRUE(d.press({"ok"}));
  d->tick(10);
  ASSERT_TRUE(d.press({"start"}));
  EXPECT_EQ(d.dialog(), "put_down_first") << "it was taken up";
}

TEST(ZebHorizon, IsTakenUpOnceItRecords) {
  auto d = onTheFloor();
  beginToRecord(d);
  EXPECT_EQ(d.fact("carried.put_down"), "yes");
  ASSERT_TRUE(d->hand("walk_to", "4,0,0.8"));
  d->tick(10);
  EXPECT_EQ(d.fact("carried.put_down"), "no");
  EXPECT_EQ(d.phase(), "recording");
  EXPECT_NEAR(d->number("carried.length"), 4, 1e-9);
}

TEST(ZebHorizon, TakesAKnownPointForAReferenceWhereSomebodyStandsStill) {
  auto d = onTheFloor();
  d->change().control.targets = {{"P1", {3, 0, 0}}, {"P2", {6, 0, 0}}};
  beginToRecord(d);
  ASSERT_TRUE(d->hand("walk_to", "3,0,1"));
  d->tick(3 + 9);
  EXPECT_EQ(d.fact("carried.fixes"), "0") << "nine seconds are too short";
  d->tick(2);
  EXPECT_EQ(d.fact("carried.fixes"), "1");
  ASSERT_TRUE(d->hand("walk_to", "4.5,0,1"));
  d->tick(30);
  EXPECT_EQ(d.fact("carried.fixes"), "1") << "there is no known point";
  ASSERT_TRUE(d->hand("walk_to", "6,0,1"));
  d->tick(20);
  ASSERT_EQ(d->state().walk.fixes.size(), 2U);
  EXPECT_EQ(d->state().walk.fixes[1].point, "P2");
}

TEST(ZebHorizon, RemindsOfItsHalfAnHour) {
  auto d = onTheFloor();
  beginToRecord(d);
  d->tick(1490 - d->number("carried.time"));
  EXPECT_EQ(d.dialog(), "");
  d->tick(20);
  EXPECT_EQ(d.dialog(), "reminder_25");
  ASSERT_TRUE(d.press({"ok"}));
  d->tick(300);
  EXPECT_EQ(d.dialog(), "reminder_30");
  EXPECT_EQ(d.phase(), "recording") << "it only says so";
}

TEST(ZebHorizon, AsksBeforeALoopIsLeftOpen) {
  for (const char* end : {"stop", "key"}) {
    auto d = onTheFloor();
    beginToRecord(d);
    ASSERT_TRUE(d->hand("walk_to", "4,0,0.8"));
    d->tick(10);
    ASSERT_TRUE(d.press({end}));
    EXPECT_EQ(d.dialog(), "open_loop_question") << end;
    ASSERT_TRUE(d.press({"cancel"}));
    ASSERT_TRUE(d->hand("walk_to", "0.5,0,0.8"));
    d->tick(20);
    ASSERT_TRUE(d.press({end}));
    EXPECT_EQ(d.phase(), "stopping") << end;
  }
  auto open = onTheFloor();
  beginToRecord(open);
  ASSERT_TRUE(open->hand("walk_to", "4,0,0.8"));
  open->tick(10);
  ASSERT_TRUE(open.press({"stop", "continue"}));
  EXPECT_EQ(open.phase(), "stopping");
}

TEST(ZebHorizon, RecordsAWalkAndGivesItToTheOffice) {
  auto d = onTheFloor();
  beginToRecord(d);
  for (const char* place : {"4,0,0.8", "0,0,0.8"}) ASSERT_TRUE(d->hand("walk_to", place));
  d->tick(30);
  ASSERT_TRUE(d.press({"stop"}));
  d->tick(20);
  EXPECT_EQ(d.screen(), "walk");
  ASSERT_TRUE(d.press({"home", "waiting_walk", "closures=off", "static_scans=on", "process"}));
  const auto order = d->takeOrder();
  ASSERT_TRUE(order);
  const auto& scan = std::get<ScanOrder>(*order);
  ASSERT_TRUE(scan.walk);
  EXPECT_EQ(scan.instrument, "geoslam-zeb-horizon");
  EXPECT_FALSE(scan.walk->closures);
  EXPECT_TRUE(scan.walk->stations);
  d.finish(scan);
  d->tick(1000);
  EXPECT_EQ(d.screen(), "result");
  EXPECT_EQ(d.fact("setups"), "1");
  EXPECT_EQ(d.fact("carried.unprocessed"), "no");
}

TEST(ZebHorizon, AWalkThatIsDiscardedIsGone) {
  auto d = onTheFloor();
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
