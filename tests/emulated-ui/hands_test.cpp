// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/effects.h"
#include "tests/emulated-ui/working.h"

namespace standpoint {
namespace {

// At rest with a project of two scans, on each device.
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

TEST_P(Hands, ARegistrationThatFailsBeginsWhereNothingIsAndOnlyOnce) {
  Device d = atRest();
  ASSERT_TRUE(d.trouble("registration_fails"));
  EXPECT_GT(link(d).shift_x_m, 100);
  EXPECT_EQ(link(d).shift_x_m, 0);
}

INSTANTIATE_TEST_SUITE_P(Devices, Hands, testing::ValuesIn(everyDevice()), deviceName);

}  // namespace
}  // namespace standpoint
