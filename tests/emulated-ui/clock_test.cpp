// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

// On, with a project, standing at S1, the laser just begun.
void beginScanning(TestDevice& d, const std::vector<std::string>& to_project_and_scan) {
  ASSERT_TRUE(d.press({"power"}));
  d->tick(200);
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(d.press(to_project_and_scan));
}

struct Story {
  const char* device;
  std::vector<std::string> presses;
};
const std::vector<Story> kStories = {
    {"leica-rtc360", {"job", "new_job", "name=A", "create", "scan"}},
    {"faro-focus", {"manage", "scan_projects", "new_project", "name=A", "create", "start_scan"}},
    {"generic", {"project", "new_project", "name=A", "create", "start_scan"}},
};

TEST(Clock, StandsStillAndNoBatteryDrainsWhileOnlyTheSimulationIsWaitedFor) {
  for (const auto& story : kStories) {
    TestDevice d(story.device);
    beginScanning(d, story.presses);
    const auto order = d->takeOrder();
    ASSERT_TRUE(order) << story.device;
    const double begun_s = d->state().clock_s, begun = d->state().around.battery;
    for (int i = 0; i < 2000; ++i) d->tick(1);  // long over
    const double over_s = d->state().clock_s, over = d->state().around.battery;
    EXPECT_LT(over_s - begun_s, d->fact("expected.seconds")->number.value() + 60) << story.device;
    for (int i = 0; i < 2000; ++i) d->tick(1);
    EXPECT_EQ(d->state().clock_s, over_s) << story.device;
    EXPECT_EQ(d->state().around.battery, over) << story.device;
    EXPECT_NEAR(begun - over, (over_s - begun_s) / d->type().definition.body.battery_s, 1e-9) << story.device;
    d.finish(std::get<ScanOrder>(*order));
    d.settle();
    EXPECT_EQ(d.fact("setups"), "1") << story.device;
  }
}

TEST(Clock, GoesOnWhileItWaitsForPeople) {
  TestDevice d("leica-rtc360");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(200);
  const double full = d->state().around.battery;
  d->tick(600);
  EXPECT_NEAR(full - d->state().around.battery, 600 / d->type().definition.body.battery_s, 1e-9);
  EXPECT_NEAR(d->state().clock_s, 800, 1e-9);
  TestDevice b("leica-blk360");  // ready for as long as its standby lets it
  ASSERT_TRUE(b.press({"key"}));
  b->tick(40);
  b->tick(5000);
  EXPECT_NEAR(b->state().clock_s, 5040, 1e-9);
}

TEST(Clock, TellsWhetherAnythingThatTakesTimeGoesOn) {
  TestDevice d("faro-focus");
  EXPECT_TRUE(d->idles());
  ASSERT_TRUE(d.press({"power"}));
  EXPECT_FALSE(d->idles()) << "it starts";
  d->tick(200);
  EXPECT_TRUE(d->idles());
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(d.press(kStories[1].presses));
  ASSERT_TRUE(d->takeOrder());
  d->tick(20);
  EXPECT_FALSE(d->idles()) << "the laser turns";
  ASSERT_TRUE(d.press({"pause"}));
  EXPECT_FALSE(d->idles()) << "a person holds it up, whose time is real";
  ASSERT_TRUE(d.press({"resume"}));
  for (int i = 0; i < 2000; ++i) d->tick(1);
  EXPECT_TRUE(d->idles()) << "its time is over, only the simulation is waited for";
}

TEST(Clock, ADeviceThatIsOffUsesNoBattery) {
  TestDevice d("faro-focus");
  d->tick(10000);
  EXPECT_EQ(d->state().around.battery, 1);
  EXPECT_EQ(d->state().clock_s, 10000);
}

}  // namespace
}  // namespace standpoint
