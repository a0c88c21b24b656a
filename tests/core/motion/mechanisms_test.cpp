// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/mechanisms.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/motion/limbs.h"
#include "core/motion/walked_path.h"
#include "core/units.h"

namespace standpoint {
namespace {

TEST(Mechanisms, TurnForEverAtTheirRate) {
  const DrivenPose rotor(DrivenPose::Way::turning, {100, 0, 60}, Eigen::Vector3d::UnitX(), {.rate = 1.2});
  const Eigen::Vector3d tip(100, 58, 60);
  for (const double time_s : {0.0, 1.0, 100.0, 86400.0}) {
    const Eigen::Vector3d exact =
        Eigen::Vector3d(100, 0, 60) +
        Eigen::AngleAxisd(std::fmod(1.2 * time_s, kRadPerTurn), Eigen::Vector3d::UnitX()) * Eigen::Vector3d(0, 58, 0);
    EXPECT_LT((rotor.pose(time_s) * tip - exact).norm(), 1e-7) << time_s;
  }
}

TEST(Mechanisms, OpenSmoothlyAndStayOpen) {
  const Drive drive{.rate = 0.5, .extent = 1.5, .begins_s = 2};
  EXPECT_EQ(drive.at(1.9), 0);
  EXPECT_EQ(drive.at(100), 1.5);
  double fastest = 0;
  for (double t = 0; t < 8; t += 0.001) fastest = std::max(fastest, (drive.at(t + 0.001) - drive.at(t)) / 0.001);
  EXPECT_NEAR(fastest, 0.5, 1e-3);
  const Drive back{.rate = 0.5, .extent = -1.5, .repeats = true};
  EXPECT_NEAR(back.at(4.5), -1.5, 1e-12);
  EXPECT_NEAR(back.at(9), 0, 1e-12);
  EXPECT_NEAR(back.at(13.5), -1.5, 1e-12);
}

TEST(Mechanisms, WalkersKeepTheirFeetOnTheFloorAndAStepApart) {
  const std::vector<Waypoint> way = {{{0, 0, 0}}, {{12, 0, 0}}};
  auto walked = walkPath(way, {.height_m = 0, .speed_mps = 1.34});
  ASSERT_TRUE(walked);
  const auto path = std::make_shared<const PoseSpline>(std::move(walked->poses));
  const auto stride = std::make_shared<const Stride>(*path, MotionKey{1, 2, MotionProcess::gait});
  const LimbPose left(path, stride, Limb::left_shank), right(path, stride, Limb::right_shank);
  double widest = 0, lowest = 1, highest = 0;
  for (double t = 3; t < 7; t += 0.01) {
    const Eigen::Vector3d l = left.pose(t) * Eigen::Vector3d(0, kHipAside_m, 0),
                          r = right.pose(t) * Eigen::Vector3d(0, -kHipAside_m, 0);
    widest = std::max(widest, std::abs(l.x() - r.x()));
    lowest = std::min(lowest, std::min(l.z(), r.z())), highest = std::max(highest, std::min(l.z(), r.z()));
  }
  EXPECT_NEAR(widest, Stride::stepLength_m(1.34), 0.15);
  EXPECT_GT(lowest, -0.03);
  EXPECT_LT(highest, 0.06);
  const LimbPose standing(path, stride, Limb::left_shank);
  EXPECT_LT((standing.pose(0) * Eigen::Vector3d(0, kHipAside_m, 0) - Eigen::Vector3d(0, kHipAside_m, 0)).norm(), 1e-9);
}

TEST(Mechanisms, RepeatWithoutAJump) {
  const std::vector<Waypoint> way = {{{0, 0, 0}}, {{3, 0, 0}, 1}, {{0, 0, 0}}};
  auto walked = walkPath(way, {.height_m = 0});
  ASSERT_TRUE(walked);
  const auto path = std::make_shared<const PoseSpline>(std::move(walked->poses));
  const TimedPose again(path, 5, true);
  EXPECT_LT(again.pose(2).translation.norm(), 1e-9);
  for (double t = 0; t < 60; t += 0.01) {
    const Pose here = again.pose(t), next = again.pose(t + 0.01);
    ASSERT_LT((here.translation - next.translation).norm(), 0.02) << t;
    ASSERT_LT(here.rotation.angularDistance(next.rotation), 0.1) << t;
  }
}

}  // namespace
}  // namespace standpoint
