// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/gait.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "core/motion/rotation_vector.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

const Carrier& carrier(std::string_view id) {
  for (const auto& one : kCarriers)
    if (one.id == id) return one;
  throw std::runtime_error("no such carrier");
}

Carrier steady(std::string_view id) {  // a gait alone
  Carrier one = carrier(id);
  one.shakes = {};
  return one;
}

PoseFunctionPtr line(double metres, double speed) {
  const std::vector<Waypoint> ends = {{{0, 0, 0}, 3, {}}, {{metres, 0, 0}, 3, {}}};
  PathLimits limits;
  limits.speed_mps = speed;
  return std::make_shared<PoseSpline>(walkPath(ends, limits)->poses);
}

TEST(CarriedPose, StepsAtTheFrequencyOfItsSpeed) {
  for (const auto& [speed, hertz] : {std::pair{1.4, 1.91}, std::pair{1.3, 1.84}, std::pair{0.7, 1.35}}) {
    const auto path = line(100, speed);
    const CarriedPose gait(path, steady("hand"), 7, 0);
    // Steps by the sideways crossings: two of them are two steps.
    int crossings = 0;
    const double from = 10, to = path->last_s() - 10;
    for (double t = from; t < to; t += 0.01)
      crossings += gait.pose(t).translation.y() * gait.pose(t + 0.01).translation.y() < 0 ? 1 : 0;
    EXPECT_NEAR(crossings / (to - from), hertz, 0.04 * hertz) << speed;
  }
}

TEST(CarriedPose, GoesUpAndDownAndSidewaysAsFarAsATrunk) {
  const auto path = line(100, 1.4);
  const CarriedPose gait(path, steady("hand"), 7, 0);
  double low = 9, high = -9, left = -9, right = 9;
  for (double t = 10; t < path->last_s() - 10; t += 0.003) {
    const Vector3d p = gait.pose(t).translation;
    low = std::min(low, p.z()), high = std::max(high, p.z());
    right = std::min(right, p.y()), left = std::max(left, p.y());
  }
  EXPECT_NEAR(left - right, 0.0462, 0.001);
  EXPECT_GT(high - low, 0.0431);  // and a quarter of it at twice the frequency
  EXPECT_LT(high - low, 0.0431 * 1.25);
}

TEST(CarriedPose, StandsStillAtAStopWhateverItsGait) {
  const auto path = line(10, 1);
  const CarriedPose gait(path, steady("hand"), 7, 0);
  const Pose a = gait.pose(0.5), b = gait.pose(2.5);
  EXPECT_LT((a.translation - b.translation).norm(), 1e-6);
  EXPECT_LT((gait.pose(-5).translation - gait.pose(0).translation).norm(), 1e-12);
}

TEST(CarriedPose, TurnsItsShakingWithTheBody) {
  Carrier up_only = steady("vehicle");
  up_only.shakes[0] = {1, 2, {0.01, 0, 0}, {0, 0, 0}};
  const Pose rolled{rotationOf({0, 0, std::numbers::pi / 2}), {1, 2, 3}};
  const CarriedPose function(std::make_shared<ConstantPose>(rolled), up_only, 7, 0);
  double squares = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d moved = function.pose(0.1 * i).translation - rolled.translation;
    EXPECT_NEAR(moved.x(), 0, 1e-12);
    squares += moved.y() * moved.y() / 4000;
  }
  EXPECT_NEAR(std::sqrt(squares), 0.01, 0.0005);
}

TEST(CarriedPose, OfAHandShakesAsWasMeasured) {
  const CarriedPose hand(std::make_shared<ConstantPose>(Pose{}), carrier("hand"), 11, 2);
  double x = 0, z = 0, yaw = 0;
  constexpr int kCount = 6000;
  for (int i = 0; i < kCount; ++i) {
    const Pose pose = hand.pose(0.0537 * i);
    x += pose.translation.x() * pose.translation.x() / kCount;
    z += pose.translation.z() * pose.translation.z() / kCount;
    yaw += std::pow(eulerAngles(pose.rotation).yaw_rad, 2) / kCount;
  }
  EXPECT_NEAR(std::sqrt(x), 0.015, 0.002);
  EXPECT_NEAR(std::sqrt(z), 0.0072, 0.001);
  EXPECT_NEAR(std::sqrt(yaw), 1.53 * kRadPerDeg, 0.2 * kRadPerDeg);
}

TEST(CarriedPose, IsTheSplineThroughItsSamples) {
  const auto path = line(10, 1);
  const CarriedPose hand(path, carrier("hand"), 7, 0);
  const auto spline = sampled(hand, 200);
  ASSERT_TRUE(spline);
  double metres = 0, radians = 0;
  for (double t = 0; t < path->last_s(); t += 0.0037) {
    const Pose a = hand.pose(t), b = spline->pose(t);
    metres = std::max(metres, (a.translation - b.translation).norm());
    radians = std::max(radians, rotationVector(a.rotation * b.rotation.conjugate()).norm());
  }
  EXPECT_LT(metres, 3e-6);
  EXPECT_LT(radians, 3e-5);
  EXPECT_FALSE(sampled(ConstantPose({}), 200));
}

TEST(Carriers, HaveNamesOfTheirOwnAndSayWhereTheirFiguresAreFrom) {
  std::set<std::string_view> ids;
  for (const auto& one : kCarriers) {
    EXPECT_TRUE(ids.insert(one.id).second);
    EXPECT_FALSE(one.source.empty());
  }
}

}  // namespace
}  // namespace standpoint
