// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/format.h"
#include "tests/emulated-ui/support.h"

namespace standpoint {
namespace {

class Display : public testing::Test {
 protected:
  Display() : d("faro-focus") {
    EXPECT_TRUE(d.press({"power"}));
    d->tick(125);
    EXPECT_EQ(d.screen(), "home");
  }
  TestDevice d;
};

TEST_F(Display, ShowsLengthsAndTemperaturesInFeetAndFahrenheit) {
  ASSERT_TRUE(d.press({"manage", "general", "units=feet", "back", "back", "parameters", "sensors"}));
  EXPECT_EQ(d.shows("temperature"), "68 °F");
  ASSERT_TRUE(d.press({"back"}));
  EXPECT_EQ(d.shows("point_distance"), "0.242 in") << "6.14 mm";
  ASSERT_TRUE(d.press({"advanced", "nearest_m=10"}));
  EXPECT_EQ(d.fact("setting.nearest_m"), "3.048") << "the scan is in metres";
  EXPECT_EQ(d.shows("nearest_m"), "10");
  EXPECT_EQ(findWidget(d->screen(), "nearest_m")->unit, "ft");
  EXPECT_TRUE(d.refuses("nearest_m", "3300")) << "1000 m are 3281 ft";
  EXPECT_EQ(lengthText(12.5, false), "12.50 m");
  EXPECT_EQ(lengthText(12.5, true), "41.01 ft");
  EXPECT_EQ(smallLengthText(0.0061, false), "6.1 mm");
}

TEST_F(Display, OfAPSeriesTakesTheAirsTemperatureInFahrenheit) {
  TestDevice p("leica-p-series");
  p->change().values["units"] = "feet";
  p->change().phase = "idle";
  p->change().screen = "station_setup";
  ASSERT_TRUE(p.press({"air_temperature=50"}));
  EXPECT_EQ(p->value("air_temperature"), "10");
}

TEST_F(Display, IsAsBrightAsItIsSet) {
  EXPECT_NEAR(d->screen().light, 0.8, 1e-9);
  ASSERT_TRUE(d.press({"manage", "general", "brightness=25"}));
  EXPECT_NEAR(d->screen().light, 0.25, 1e-9);
}

TEST_F(Display, GoesDarkAtRestSavesTheBatteryAndIsWokenByTheFirstTap) {
  ASSERT_TRUE(d.press({"manage", "general", "sleep=5min"}));
  d->tick(299);
  EXPECT_EQ(d.screen(), "general");
  const double awake = d->state().around.battery;
  d->tick(1);
  EXPECT_EQ(d.fact("asleep"), "yes");
  EXPECT_TRUE(d.screen().empty());
  const double asleep = d->state().around.battery;
  d->tick(100);
  EXPECT_NEAR(asleep - d->state().around.battery, 50 * (awake - asleep), 1e-9);
  ASSERT_TRUE(d.press({"sleep=never"}));
  EXPECT_EQ(d.screen(), "general");
  EXPECT_EQ(d.fact("value.sleep"), "5min") << "the tap only woke it";
  ASSERT_TRUE(d.press({"sleep=never"}));
  d->tick(10000);
  EXPECT_EQ(d.screen(), "general");
}

TEST_F(Display, StaysLitWhileTheInstrumentWorksAndWhenItHasSomethingToSay) {
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(
      d.press({"manage", "general", "sleep=5min", "back", "scan_projects", "new_project", "name=A", "create",
               "parameters", "resolution_quality", "resolution=1/1", "quality=4x", "back", "back", "start_scan"}));
  d.scanned();
  d->tick(3000);
  EXPECT_EQ(d.screen(), "scanning");
  d.settle();
  ASSERT_EQ(d.phase(), "idle");
  d->tick(400);
  ASSERT_TRUE(d.screen().empty());
  ASSERT_TRUE(d->trouble("battery_low"));
  EXPECT_EQ(d.dialog(), "battery_low");
  EXPECT_FALSE(d.screen().empty());
}

}  // namespace
}  // namespace standpoint
