// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/paced_way.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/motion/carriers.h"
#include "core/motion/gait.h"
#include "core/motion/rotation_vector.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

double headingAt(const PoseFunction& path, double time_s) { return eulerAngles(path.pose(time_s).rotation).yaw_rad; }

// 1 m/s along x, then 3 s at the corner, then along y.
std::vector<Vector3d> roundTheCorner() {
  std::vector<Vector3d> places;
  for (int i = 0; i <= 20; ++i) places.emplace_back(0.2 * i, 0, 1);
  for (int i = 0; i < 15; ++i) places.emplace_back(4, 0, 1);
  for (int i = 1; i <= 20; ++i) places.emplace_back(4, 0.2 * i, 1);
  return places;
}

TEST(PacedWay, IsAtEachPlaceAtItsTime) {
  const auto places = roundTheCorner();
  const auto path = pacedWay(places, 0.2, false);
  ASSERT_TRUE(path);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_LT((path->pose(0.2 * static_cast<double>(i)).translation - places[i]).norm(), 1e-12);
  EXPECT_NEAR(path->last_s(), 11, 1e-9);
}

TEST(PacedWay, LooksWhereItGoesAndTurnsWhileItStands) {
  const auto path = pacedWay(roundTheCorner(), 0.2, false);
  ASSERT_TRUE(path);
  EXPECT_NEAR(headingAt(*path, 2), 0, 1e-3);
  EXPECT_NEAR(headingAt(*path, 5.5), std::numbers::pi / 4, 0.05);
  EXPECT_NEAR(headingAt(*path, 9), std::numbers::pi / 2, 1e-3);
}

TEST(PacedWay, ComesBackPlaceByPlaceAfterATurnOfASecond) {
  const auto path = pacedWay(roundTheCorner(), 0.2, true);
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->last_s(), 2 * 11 + 1.2, 1e-9);  // from place to place, in steps of 0.2 s
  for (double t = 0; t < 11; t += 0.4)
    EXPECT_LT((path->pose(t).translation - path->pose(path->last_s() - t).translation).norm(), 1e-9);
  EXPECT_NEAR(headingAt(*path, 14), -std::numbers::pi / 2, 1e-3);
  for (double t = 0; t < path->last_s(); t += 0.01)
    EXPECT_LT(velocity(*path, t).angular_radps.norm(), 1.5 * std::numbers::pi) << t;
}

TEST(PacedWay, NeedsTwoPlaces) { EXPECT_FALSE(pacedWay(std::vector<Vector3d>{{1, 2, 3}}, 0.2, false)); }

TEST(PacedWay, OfWhoCarriesSomethingHasNeitherItsStepsNorItsAttitude) {
  const std::vector<Waypoint> ends = {{{0, 0, 0}}, {{20, 0, 0}}};
  const auto walked = walkPath(ends, {.height_m = 1.3});
  ASSERT_TRUE(walked);
  const auto path = std::make_shared<PoseSpline>(walked->poses);
  const CarriedPose hand(path, kCarriers[0], 7, 0);
  // As a file has it: by another clock, and the device on its side.
  Trajectory samples;
  for (double t = 0; t < path->last_s(); t += 0.01) {
    samples.time_s.push_back(1000 + t);
    samples.pose.push_back(hand.pose(t) * Pose{rotationOf({1.5, 0, 2}), Vector3d::Zero()});
  }
  const auto file = PoseSpline::through(samples);
  ASSERT_TRUE(file);
  const auto way = wayOnFoot(*file);
  ASSERT_TRUE(way);
  EXPECT_EQ((*way)->first_s(), 1000);
  for (double t = 2; t < path->last_s() - 2; t += 0.05) {
    const Pose pose = (*way)->pose(1000 + t);
    EXPECT_LT((pose.translation - path->pose(t).translation).norm(), 0.05);
    EXPECT_NEAR(eulerAngles(pose.rotation).yaw_rad, 0, 0.1);
    EXPECT_LT((pose.rotation * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 1e-9);
  }
  EXPECT_FALSE(wayOnFoot(ConstantPose({})));
}

}  // namespace
}  // namespace standpoint
