// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/sensors.h"

#include <cmath>
#include <cstdlib>

#include "core/units.h"
#include "survey/stations/levelling.h"
#include "tests/emulated-ui/support.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

const std::vector<SensorRow> kAll = {{"compass", "", 5, ""}, {"altimeter", "", 1, ""}, {"gps", "", 10, ""}};

std::string reading(const SettingValues& readings, const std::string& key) {
  for (const auto& [name, text] : readings)
    if (name == key) return text;
  return "";
}

Station at(const Eigen::Vector3d& place, double yaw_deg) {
  Station station;
  station.name = "S1";
  station.true_pose = {rotationOf(yaw_deg * kRadPerDeg, {}), place};
  return station;
}

TEST(Sensors, ReadTheTruthWithTheErrorThatTheyState) {
  const Document document = twoStoreyDocument();
  const Eigen::Vector3d place(2, 2, 30);  // above everything
  const auto station = at(place, 30);
  double square = 0, height_square = 0;
  const int n = 400;
  for (int number = 1; number <= n; ++number) {
    const auto readings = sensorReadings(document, station, kAll, {"compass", "altimeter", "gps"}, 1, number);
    const double azimuth = std::strtod(reading(readings, "compass").c_str(), nullptr) - 60;  // clockwise from Y
    square += azimuth * azimuth;
    const double height =
        std::strtod(reading(readings, "altimeter").c_str(), nullptr) - place.z() - document.georeference->shift_m.z();
    height_square += height * height;
  }
  EXPECT_NEAR(std::sqrt(square / n), 5, 0.6);
  EXPECT_NEAR(std::sqrt(height_square / n), 1, 0.12);
  const auto readings = sensorReadings(document, station, kAll, {"compass", "altimeter", "gps"}, 1, 1);
  EXPECT_TRUE(reading(readings, "compass").ends_with("± 5°")) << reading(readings, "compass");
  EXPECT_TRUE(reading(readings, "gps").ends_with("m ± 10 m")) << reading(readings, "gps");
  EXPECT_EQ(readings, sensorReadings(document, station, kAll, {"gps", "altimeter", "compass"}, 1, 1))
      << "the same scan, the same readings";
}

TEST(Sensors, ThatAreOffLeaveNothing) {
  const Document document = twoStoreyDocument();
  EXPECT_TRUE(sensorReadings(document, at({2, 2, 30}, 0), kAll, {}, 1, 1).empty());
  const auto one = sensorReadings(document, at({2, 2, 30}, 0), kAll, {"altimeter"}, 1, 1);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].first, "altimeter");
}

TEST(Sensors, ReceiveNoPlaceUnderARoof) {
  const Document document = twoStoreyDocument();
  const auto& environment = *document.environment();
  EXPECT_TRUE(isUnderARoof(environment, {2, 2, 1.6}));
  EXPECT_FALSE(isUnderARoof(environment, {2, 2, 30}));
  EXPECT_FALSE(isUnderARoof(environment, {-20, 2, 1.6}));
  EXPECT_EQ(reading(sensorReadings(document, at({2, 2, 1.6}, 0), kAll, {"gps"}, 1, 1), "gps"), "–");
}

TEST(Sensors, OfTheFocusAreSwitchedOneByOneAndThoseOfTheRtc360AreAlwaysOn) {
  TestDevice d("faro-focus");
  ASSERT_TRUE(d.press({"power"}));
  d->tick(150);
  ASSERT_TRUE(d->hand("stand_at", "S1"));
  ASSERT_TRUE(d.press({"manage", "operators", "operator=Ada", "back", "scan_projects", "new_project", "name=House",
                       "customer=Town", "create"}));
  ASSERT_TRUE(d.press({"parameters", "sensors", "compass=off", "back", "back", "start_scan"}));
  const auto order = d.scanned();
  EXPECT_EQ(order.sensors, (std::vector<std::string>{"altimeter", "gps"}));
  EXPECT_EQ(order.notes, (SettingValues{{"operator", "Ada"}, {"project", "Town"}}));
  TestDevice r("leica-rtc360");
  ASSERT_TRUE(r.press({"power"}));
  r->tick(60);
  ASSERT_TRUE(r->hand("stand_at", "S1"));
  ASSERT_TRUE(r.press({"job", "new_job", "name=A", "create", "scan"}));
  EXPECT_EQ(r.scanned().sensors.size(), 3U);
}

// A room that looks the same from both sides: only who knows the direction begins the right way round.
TEST(Sensors, ACompassKeepsALinkFromBeginningTheWrongWayRound) {
  for (const bool compass : {true, false}) {
    TestDevice d("faro-focus");
    ASSERT_TRUE(d.press({"power"}));
    d->tick(150);
    ASSERT_TRUE(d.press({"manage", "scan_projects", "new_project", "name=House", "create"}));
    for (const char* file : {"a.e57", "b.e57"}) {
      StoredSetup setup;
      setup.file = file;
      if (compass) setup.notes = {{"compass", "10° ± 5°"}};
      d->project()->setups.push_back(setup);
    }
    ASSERT_TRUE(d->trouble("symmetrical_room"));
    d->change().shown = 1;
    d->show("targets");
    ASSERT_TRUE(d.press({"link_now"}));
    const auto order = d->takeOrder();
    ASSERT_TRUE(order);
    EXPECT_EQ(std::get<LinkOrder>(*order).turn_deg, compass ? 0 : 180);
  }
}

}  // namespace
}  // namespace standpoint
