// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/lean.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/motion/carriers.h"
#include "core/motion/gait.h"
#include "core/motion/rotation_vector.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;

// Round and round at an even speed for 30 s, to the left or to the right, nose ahead.
class Circle final : public PoseFunction {
 public:
  Circle(double speed_mps, double radius_m, bool left) : speed_(speed_mps), radius_(radius_m), side_(left ? 1 : -1) {}
  Pose pose(double time_s) const override {
    const double angle = speed_ / radius_ * time_s;
    return {unitRotation(rotationOf({0, 0, side_ * angle})),
            {radius_ * std::sin(angle), side_ * radius_ * (1 - std::cos(angle)), 20}};
  }
  double first_s() const override { return 0; }
  double last_s() const override { return 30; }

 private:
  double speed_, radius_, side_;
};

// From standing, ever faster.
class Dash final : public PoseFunction {
 public:
  explicit Dash(double acceleration_mps2) : acceleration_(acceleration_mps2) {}
  Pose pose(double time_s) const override {
    return {Eigen::Quaterniond::Identity(), {0.5 * acceleration_ * time_s * time_s, 0, 0}};
  }
  double first_s() const override { return 0; }
  double last_s() const override { return 10; }

 private:
  double acceleration_;
};

EulerAngles anglesAt(const PoseFunctionPtr& path, const Lean& lean, double time_s) {
  return eulerAngles(LeaningPose(path, lean).pose(time_s).rotation);
}

TEST(Lean, OfAUavInABendIsThatOfACoordinatedTurn) {
  const Lean& lean = carrierOf("uav")->lean;
  const double expected = std::atan(8.0 * 8.0 / (30 * kGravity));  // 12.3°
  EXPECT_NEAR(expected / kRadPerDeg, 12.3, 0.05);
  for (const bool left : {true, false}) {
    const auto path = std::make_shared<Circle>(8, 30, left);
    const EulerAngles angles = anglesAt(path, lean, 15);
    EXPECT_NEAR(angles.roll_rad, left ? -expected : expected, 1e-4);  // right side down is to the right
    EXPECT_NEAR(angles.pitch_rad, 0, 1e-3);
    // What hangs in it hangs along its own axis: gravity and the way's acceleration together.
    const Pose upright = path->pose(15);
    const Vector3d inwards = upright.rotation * Vector3d(0, left ? 1 : -1, 0);
    const Vector3d up = LeaningPose(path, lean).pose(15).rotation * Vector3d::UnitZ();
    EXPECT_NEAR(up.dot((inwards * 64 / 30 + Vector3d(0, 0, kGravity)).normalized()), 1, 1e-7);
    EXPECT_LT((LeaningPose(path, lean).pose(15).translation - upright.translation).norm(), 1e-12);
  }
}

TEST(Lean, HasAMost) {
  const auto path = std::make_shared<Circle>(25, 30, true);
  EXPECT_NEAR(anglesAt(path, carrierOf("uav")->lean, 15).roll_rad, -30 * kRadPerDeg, 1e-9);
}

TEST(Lean, OfAUavIsNoseDownWhereItGoesFaster) {
  const auto path = std::make_shared<Dash>(1.5);
  EXPECT_NEAR(anglesAt(path, carrierOf("uav")->lean, 5).pitch_rad, std::atan(1.5 / kGravity), 1e-6);
  const auto back = std::make_shared<Dash>(-1.5);
  EXPECT_NEAR(anglesAt(back, carrierOf("uav")->lean, 5).pitch_rad, -std::atan(1.5 / kGravity), 1e-6);
}

TEST(Lean, OfAVehicleIsSmallAndOutOfTheBendAboutAnAxisBelow) {
  const Lean& lean = carrierOf("vehicle")->lean;
  const auto path = std::make_shared<Circle>(6, 20, true);  // 1.8 m/s² to the left
  const EulerAngles angles = anglesAt(path, lean, 15);
  const double expected = 0.09 * std::atan(1.8 / kGravity);
  EXPECT_NEAR(angles.roll_rad, expected, 1e-4);
  EXPECT_LT(angles.roll_rad, 1.5 * kRadPerDeg);
  const Pose upright = path->pose(15);
  const Vector3d moved =
      upright.rotation.conjugate() * (LeaningPose(path, lean).pose(15).translation - upright.translation);
  EXPECT_NEAR(moved.y(), -1.7 * std::sin(expected), 1e-4);  // to the right
  EXPECT_LT(anglesAt(std::make_shared<Dash>(1.5), lean, 5).pitch_rad, 0) << "it sits back";
}

TEST(Lean, IsThereAlongAPathThroughWaypoints) {
  Carrier uav = *carrierOf("uav");
  uav.shakes = {};
  uav.limits.speed_mps = 8, uav.limits.lateral_mps2 = 3;
  std::vector<Waypoint> round;
  for (int k = 0; k <= 48; ++k) {
    const double angle = 2 * std::numbers::pi * k / 48;
    round.push_back({{30 * std::sin(angle), 30 * (1 - std::cos(angle)), 0}});
  }
  const auto walked = walkPath(round, uav.limits);
  ASSERT_TRUE(walked);
  const auto path = std::make_shared<PoseSpline>(walked->poses);
  const CarriedPose pose(path, uav, 1, 0);
  double sum = 0, speed = 0;
  int count = 0;
  for (double t = 10; t < path->last_s() - 10; t += 0.05, ++count) {
    sum += eulerAngles(pose.pose(t).rotation).roll_rad;
    speed += velocity(*path, t).linear_mps.norm();
  }
  speed /= count;
  EXPECT_NEAR(sum / count, -std::atan(speed * speed / (30 * kGravity)), 0.3 * kRadPerDeg);
  EXPECT_LT(std::abs(eulerAngles(pose.pose(path->last_s()).rotation).pitch_rad), 1 * kRadPerDeg) << "it stands";
}

TEST(Lean, IsNothingOfWhoWalks) {
  for (const char* id : {"hand", "backpack", "trolley"}) EXPECT_EQ(carrierOf(id)->lean.most_rad, 0) << id;
}

}  // namespace
}  // namespace standpoint
