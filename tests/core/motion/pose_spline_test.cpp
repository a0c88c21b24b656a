// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/pose_spline.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/motion/rotation_vector.h"

namespace standpoint {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond yaw(double degrees) { return rotationOf({0, 0, degrees * std::numbers::pi / 180}); }

// A body that goes up and down by 20 mm at 1.9 Hz, and nods and turns with it.
Pose gaitAt(double t) {
  const double wave = std::sin(2 * std::numbers::pi * 1.9 * t);
  return {rotationOf({0, 0.02 * wave, 0.5 * t}), {t, 0, 0.020 * wave}};
}

Trajectory sampled(Pose (*pose)(double), double hertz, double seconds) {
  Trajectory samples;
  for (int i = 0; i <= std::lround(seconds * hertz); ++i) {
    samples.time_s.push_back(i / hertz);
    samples.pose.push_back(pose(i / hertz));
  }
  return samples;
}

Trajectory trackOf(std::vector<double> time_s, std::vector<Pose> pose) { return {std::move(time_s), std::move(pose)}; }
Pose along(double x_m) { return {Quaterniond::Identity(), {x_m, 0, 0}}; }

double worstHeight(const PoseFunction& function) {
  double worst = 0;
  for (double t = 0; t <= 10; t += 0.00037)
    worst = std::max(worst, std::abs(function.pose(t).translation.z() - gaitAt(t).translation.z()));
  return 1000 * worst;
}

// M13 of mobile.md §9.
TEST(PoseSpline, M13_FollowsAGaitFarCloserThanChordsDo) {
  for (const auto& [hertz, expected_mm] : {std::pair{10, 3.46}, std::pair{20, 0.884}, std::pair{100, 0.0356}})
    EXPECT_NEAR(worstHeight(*PoseChords::through(sampled(gaitAt, hertz, 10))), expected_mm, 0.02 * expected_mm);
  EXPECT_LE(worstHeight(*PoseSpline::through(sampled(gaitAt, 100, 10))), 3e-5);
  const auto spline = PoseSpline::through(sampled(gaitAt, 20, 10));
  double inside = 0;
  for (double t = 1; t <= 9; t += 0.00037)
    inside = std::max(inside, std::abs(spline->pose(t).translation.z() - gaitAt(t).translation.z()));
  EXPECT_LE(1000 * inside, 0.01);
}

// M16.
TEST(PoseSpline, M16_YawFrom350To10PassesZeroAndQIsAlikeMinusQ) {
  for (const bool flipped : {false, true}) {
    Trajectory samples{{0, 1, 2, 3}, {{yaw(340), {}}, {yaw(350), {}}, {yaw(10), {}}, {yaw(20), {}}}};
    if (flipped)
      for (std::size_t i = 0; i < 4; i += 2) samples.pose[i].rotation.coeffs() = -samples.pose[i].rotation.coeffs();
    for (const bool chords : {false, true}) {
      const Pose half = chords ? PoseChords::through(samples)->pose(1.5) : PoseSpline::through(samples)->pose(1.5);
      EXPECT_LT(half.rotation.angularDistance(yaw(0)), 1e-12);
      EXPECT_GE(half.rotation.w(), 0);
    }
  }
}

TEST(PoseSpline, MeetsItsSamplesAndIsSmoothToTheSecondDerivative) {
  Trajectory samples;
  for (int i = 0; i < 30; ++i) {
    samples.time_s.push_back(0.1 * i + 0.03 * std::sin(7.0 * i));
    samples.pose.push_back({unitRotation(rotationBy(Vector3d(std::sin(0.9 * i), std::cos(1.3 * i), 0.4 * i))),
                            {std::sin(1.0 * i), std::cos(0.7 * i), 0.1 * i}});
  }
  const auto spline = PoseSpline::through(samples);
  ASSERT_TRUE(spline);
  constexpr double h = 1e-4;
  for (std::size_t i = 0; i < 30; ++i) {
    const Pose at = spline->pose(samples.time_s[i]);
    EXPECT_LT((at.translation - samples.pose[i].translation).norm(), 1e-14);
    EXPECT_LT(at.rotation.angularDistance(samples.pose[i].rotation), 1e-7);
    if (i < 2 || i > 27) continue;
    // Second differences on both sides of the sample: they differ by the third derivative times the distance alone.
    const auto acceleration = [&](double t) {
      const Pose a = spline->pose(t - h), b = spline->pose(t), c = spline->pose(t + h);
      Eigen::Matrix<double, 6, 1> both;
      both << (a.translation - 2 * b.translation + c.translation) / (h * h),
          (rotationVector(c.rotation * b.rotation.conjugate()) - rotationVector(b.rotation * a.rotation.conjugate())) /
              (h * h);
      return both;
    };
    EXPECT_LT((acceleration(samples.time_s[i] + 2 * h) - acceleration(samples.time_s[i] - 2 * h)).norm(),
              0.1 * acceleration(samples.time_s[i]).norm() + 3);
  }
}

TEST(PoseSpline, TurnsWithItsFrame) {
  const Pose frame{unitRotation(rotationBy({0.4, -1, 2})), {100, 200, -3}};
  Trajectory samples = sampled(gaitAt, 5, 3), turned = samples;
  for (auto& pose : turned.pose) pose = frame * pose;
  const auto spline = PoseSpline::through(samples), of_turned = PoseSpline::through(turned);
  for (double t = -0.2; t < 3.2; t += 0.017) {
    const Pose expected = frame * spline->pose(t), is = of_turned->pose(t);
    EXPECT_LT((expected.translation - is.translation).norm(), 1e-12);
    EXPECT_LT(expected.rotation.angularDistance(is.rotation), 1e-7);
  }
}

TEST(PoseSpline, GoesEvenlyThroughABreakAndIsNotDisturbedByIt) {
  Trajectory samples = sampled(gaitAt, 20, 4);
  for (int i = 0; i < 60; ++i) {
    samples.time_s.push_back(104 + i / 20.0);
    samples.pose.push_back(gaitAt(104 + i / 20.0));
  }
  const auto spline = PoseSpline::through(samples, 0.5);
  ASSERT_EQ(spline->breaks().size(), 1U);
  EXPECT_EQ(spline->breaks()[0].from_s, 4);
  EXPECT_EQ(spline->breaks()[0].to_s, 104);
  EXPECT_NEAR(spline->pose(54).translation.x(), 54, 1e-9);
  const double z_from = gaitAt(4).translation.z(), z_to = gaitAt(104).translation.z();
  EXPECT_NEAR(spline->pose(29).translation.z(), z_from + 0.25 * (z_to - z_from), 1e-12);
  EXPECT_NEAR(spline->pose(3.97).translation.z(), gaitAt(3.97).translation.z(), 2e-4);
  EXPECT_EQ(spline->pose(-1).translation.x(), 0);
  EXPECT_EQ(spline->pose(1e9).translation.x(), spline->pose(spline->last_s()).translation.x());
}

TEST(PoseSpline, OfOneTwoOrThreeSamplesIsAPointALineAndAParabola) {
  EXPECT_EQ(PoseSpline::through(trackOf({5}, {along(5)}))->pose(7).translation.x(), 5);
  EXPECT_NEAR(PoseSpline::through(trackOf({5, 9}, {along(5), along(9)}))->pose(6).translation.x(), 6, 1e-14);
  const auto parabola = PoseSpline::through(trackOf({0, 1, 3}, {along(0), along(1), along(9)}));
  for (double t = 0; t < 3; t += 0.1) EXPECT_NEAR(parabola->pose(t).translation.x(), t * t, 1e-13);
}

TEST(PoseSpline, RefusesSamplesThatAreNoTrack) {
  const auto message = [](const Trajectory& samples) {
    const auto spline = PoseSpline::through(samples);
    return spline ? std::string("none") : describe(spline.error());
  };
  EXPECT_EQ(message({}), "a trajectory needs at least one pose, and a time for each");
  EXPECT_EQ(message(trackOf({0, 1, 1}, {along(0), along(1), along(2)})),
            "sample 2: is not later than the sample before it");
  EXPECT_EQ(message(trackOf({0, 1}, {along(0), along(std::nan(""))})), "sample 1: is not a number");
  EXPECT_EQ(message(trackOf({0}, {{Quaterniond(0.9, 0, 0, 0), {0, 0, 0}}})),
            "sample 0: has a quaternion that is not of length 1");
}

TEST(Velocity, IsThatOfBodyAndFrame) {
  const auto spline = PoseSpline::through(sampled(gaitAt, 100, 4));
  const Velocity v = velocity(*spline, 2.003);
  EXPECT_NEAR(v.linear_mps.x(), 1, 1e-8);
  EXPECT_NEAR(v.linear_mps.z(), 0.020 * 2 * std::numbers::pi * 1.9 * std::cos(2 * std::numbers::pi * 1.9 * 2.003),
              1e-5);
  EXPECT_NEAR(v.angular_radps.z(), 0.5, 1e-5);
  EXPECT_EQ(velocity(*spline, 9).linear_mps.norm(), 0);
  EXPECT_EQ(velocity(ConstantPose(gaitAt(1)), 9).angular_radps.norm(), 0);
}

}  // namespace
}  // namespace standpoint
