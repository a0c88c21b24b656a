// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/effects.h"
#include "tests/emulated-ui/working.h"

namespace standpoint {
namespace {

// At rest with a project of two scans, on each device that stands on a tripod.
class Hands : public testing::TestWithParam<const EmulatedDevice*> {
 protected:
  static Device atRest() {
    const auto type = loadDevice(*GetParam());
    EXPECT_TRUE(type) << describe(type.error());
    for (const char* rest : {"connected", "waiting", "idle"})
      if (const auto* phase = findPhase((*type)->definition, rest)) return working(*type, *phase, phase->screen);
    ADD_FAILURE() << "it never rests";
    return Device(*type);
  }
  static bool isInAScan(Device d) {
    beginScan(d);
    return d.state().running->operator_in_view;
  }
  static LinkOrder link(Device& d) {
    orderLink(d);
    const auto order = d.takeOrder();
    return order ? std::get<LinkOrder>(*order) : LinkOrder{};
  }
};

// M13: who stays in the scanner's view is in the cloud, until he steps behind it.
TEST_P(Hands, WhoStaysInViewIsInEachScan) {
  Device d = atRest();
  EXPECT_FALSE(isInAScan(d));
  ASSERT_TRUE(d.hand("stand_in_view"));
  EXPECT_EQ(d.fact("operator.in_view")->text, "yes");
  EXPECT_TRUE(isInAScan(d));
  EXPECT_TRUE(isInAScan(d)) << "and in the next";
  ASSERT_TRUE(d.hand("step_behind"));
  EXPECT_FALSE(isInAScan(d));
}

TEST_P(Hands, WhereWhoStaysInViewStandsIsTyped) {
  Device d = atRest();
  for (const char* wrong : {"0.1", "99", "2,", "2,900", "near"}) EXPECT_FALSE(d.hand("stand_in_view", wrong)) << wrong;
  EXPECT_EQ(d.fact("operator.in_view")->text, "no");
  ASSERT_TRUE(d.hand("stand_in_view", "2.5,90"));
  beginScan(d);
  EXPECT_EQ(d.state().running->operator_place.away_m, 2.5);
  EXPECT_EQ(d.state().running->operator_place.azimuth_deg, 90);
}

// Walking in and out while the laser turns is in the columns that are measured meanwhile.
TEST_P(Hands, WhoComesAndGoesInAScanIsInThatPartOfIt) {
  const auto type = *loadDevice(*GetParam());
  const auto& phases = type->definition.phases;
  const auto laser = std::find_if(phases.begin(), phases.end(), [](const PhaseRow& p) { return p.laser; });
  ASSERT_NE(laser, phases.end());
  Device d = working(type, *laser, laser->screen);
  beginScan(d);
  (void)d.takeOrder();
  const auto swept = [&](double fraction) { d.change().laser_s = fraction * d.expected().scan_seconds; };
  swept(0.25);
  ASSERT_TRUE(d.hand("stand_in_view", "3"));
  swept(0.75);
  ASSERT_TRUE(d.hand("step_behind"));
  const auto order = d.takeOrder();
  ASSERT_TRUE(order) << "what was simulated so far did not know of it";
  const auto& scan = std::get<ScanOrder>(*order);
  EXPECT_TRUE(scan.operator_in_view);
  EXPECT_NEAR(scan.operator_from_fraction, 0.25, 1e-9);
  EXPECT_NEAR(scan.operator_until_fraction, 0.75, 1e-9);
  swept(0.8);
  ASSERT_TRUE(d.trouble("passer_by"));
  EXPECT_NEAR(std::get<ScanOrder>(*d.takeOrder()).passer_by_at_fraction.value_or(0), 0.82, 1e-9);
}

TEST_P(Hands, ARegistrationThatFailsBeginsWhereNothingIsAndOnlyOnce) {
  Device d = atRest();
  ASSERT_TRUE(d.trouble("registration_fails"));
  EXPECT_GT(link(d).shift_x_m, 100);
  EXPECT_EQ(link(d).shift_x_m, 0);
}

TEST(HandsOnATripod, AreTriedWithEachDeviceThatIsNotCarried) {
  for (const auto& device : emulatedDevices())
    EXPECT_EQ((*loadDevice(device))->instrument.moving.has_value(), isCarried(device)) << device.id;
}

INSTANTIATE_TEST_SUITE_P(Devices, Hands, testing::ValuesIn(everyTripod()), deviceName);

}  // namespace
}  // namespace standpoint
