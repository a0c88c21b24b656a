// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/walked_path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/motion/rotation_vector.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

Waypoint to(double x, double y, double z = 0, double stop_s = 0) { return {{x, y, z}, stop_s, {}}; }

WalkedPath walked(const std::vector<Waypoint>& waypoints, const PathLimits& limits = {}) {
  auto path = walkPath(waypoints, limits);
  EXPECT_TRUE(path) << describe(path.error());
  return *std::move(path);
}

// The largest speed, turn rate, acceleration along the path and change of it.
struct Worst {
  double speed = 0, turn = 0, lateral = 0, along = 0, jerk = 0;
};
Worst worstOf(const PoseSpline& poses) {
  Worst worst;
  constexpr double h = 0.02;
  const auto speedAt = [&](double t) { return velocity(poses, t).linear_mps.norm(); };
  for (double t = 3 * h; t < poses.last_s() - 3 * h; t += 0.013) {
    const Velocity v = velocity(poses, t);
    worst.speed = std::max(worst.speed, v.linear_mps.norm());
    worst.turn = std::max(worst.turn, std::abs(v.angular_radps.z()));
    const Vector3d a = (velocity(poses, t + h).linear_mps - velocity(poses, t - h).linear_mps) / (2 * h);
    if (v.linear_mps.norm() > 0.1) worst.lateral = std::max(worst.lateral, a.cross(v.linear_mps.normalized()).norm());
    worst.along = std::max(worst.along, std::abs(speedAt(t + h) - speedAt(t - h)) / (2 * h));
    worst.jerk = std::max(worst.jerk, std::abs(speedAt(t + h) - 2 * speedAt(t) + speedAt(t - h)) / (h * h));
  }
  return worst;
}

TEST(WalkPath, AlongALineTakesTheTimeOfItsSpeedAndItsTwoRamps) {
  const PathLimits limits;
  const WalkedPath path = walked({to(0, 0), to(20, 0)});
  EXPECT_NEAR(path.length_m, 20, 1e-6);
  const double window = 2 * limits.acceleration_mps2 / limits.jerk_mps3;
  EXPECT_NEAR(path.poses.last_s(), 20 / 0.9 + 0.9 / 0.7 + window, 0.02);
  EXPECT_EQ(path.poses.first_s(), 0);
  EXPECT_LT((path.poses.pose(0).translation - Vector3d(0, 0, 1.3)).norm(), 1e-9);
  EXPECT_LT((path.poses.pose(1e3).translation - Vector3d(20, 0, 1.3)).norm(), 1e-6);
  EXPECT_NEAR(velocity(path.poses, 12).linear_mps.x(), 0.9, 1e-6);
}

TEST(WalkPath, KeepsItsLimits) {
  PathLimits limits;
  for (const double speed : {0.5, 0.9, 1.4}) {
    limits.speed_mps = speed;
    const WalkedPath path = walked(
        {to(0, 0), to(8, 0), to(8, 5), to(3, 5, 0, 2), to(3, 5.6), to(9, 9, 1), to(9, 9.8, 1), to(0, 9)}, limits);
    const Worst worst = worstOf(path.poses);
    EXPECT_LT(worst.speed, 1.005 * speed);
    EXPECT_GT(worst.speed, 0.95 * speed);
    EXPECT_LT(worst.turn, 1.03 * limits.turn_radps);
    EXPECT_LT(worst.lateral, 1.1 * limits.lateral_mps2);
    EXPECT_LT(worst.along, 1.03 * limits.acceleration_mps2);
    EXPECT_LT(worst.jerk, 1.15 * limits.jerk_mps3);
  }
}

TEST(WalkPath, PassesItsWaypointsAndStaysBesideItsLegs) {
  const std::vector<Waypoint> waypoints = {to(0, 0), to(5, 0), to(5, 5, 0.5), to(4.4, 5.1, 0.5), to(0, 5)};
  const WalkedPath path = walked(waypoints);
  ASSERT_EQ(path.reached_s.size(), waypoints.size());
  for (std::size_t i = 0; i < waypoints.size(); ++i)
    EXPECT_LT((path.poses.pose(path.reached_s[i]).translation - waypoints[i].floor_m - Vector3d(0, 0, 1.3)).norm(),
              0.002)
        << i;
  double farthest = 0;
  for (double t = 0; t < path.poses.last_s(); t += 0.05) {
    const Vector3d p = path.poses.pose(t).translation - Vector3d(0, 0, 1.3);
    double nearest = 100;
    for (std::size_t i = 1; i < waypoints.size(); ++i) {
      const Vector3d a = waypoints[i - 1].floor_m, leg = waypoints[i].floor_m - a;
      const double along = std::clamp((p - a).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (p - a - along * leg).norm());
    }
    farthest = std::max(farthest, nearest);
  }
  EXPECT_LT(farthest, 0.1);
}

TEST(WalkPath, StandsWhereItIsToldAndAsLong) {
  const WalkedPath path = walked({to(0, 0, 0, 5), to(6, 0, 0, 10), to(6, 6)});
  EXPECT_LT((path.poses.pose(4.9).translation - path.poses.pose(0).translation).norm(), 1e-6);
  const double from = path.reached_s[1];
  const Pose standing = path.poses.pose(from + 1);
  EXPECT_LT((standing.translation - Vector3d(6, 0, 1.3)).norm(), 0.03);
  EXPECT_LT((path.poses.pose(from + 9.5).translation - standing.translation).norm(), 1e-4);
  EXPECT_LT(path.poses.pose(from + 9.5).rotation.angularDistance(standing.rotation), 1e-4);
  EXPECT_GT((path.poses.pose(from + 12.5).translation - standing.translation).norm(), 0.1);
}

TEST(WalkPath, LooksAheadOrWhereItIsTold) {
  std::vector<Waypoint> waypoints = {to(0, 0), to(6, 0), to(6, 6), to(0, 6)};
  waypoints[1].look_rad = std::numbers::pi;
  const WalkedPath path = walked(waypoints);
  const auto yawAt = [&](const Vector3d& place) {
    double nearest = 100, yaw = 0;
    for (double t = 0; t < path.poses.last_s(); t += 0.02) {
      const Pose pose = path.poses.pose(t);
      const double distance = (pose.translation.head<2>() - place.head<2>()).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      yaw = eulerAngles(pose.rotation).yaw_rad;
    }
    return yaw;
  };
  EXPECT_NEAR(yawAt({3, 0, 0}), 0, 0.01);
  EXPECT_NEAR(std::abs(yawAt({6, 3, 0})), std::numbers::pi, 0.01);
  EXPECT_NEAR(std::abs(yawAt({3, 6, 0})), std::numbers::pi, 0.01);
}

TEST(WalkPath, ClimbsStairsAndComesBackTheWayItWent) {
  const WalkedPath path = walked({to(0, 0), to(2, 0), to(6, 0, 2.5), to(8, 0, 2.5), to(2, 0, 0)});
  EXPECT_NEAR(path.poses.pose(path.reached_s[2]).translation.z(), 3.8, 0.002);
  EXPECT_LT(path.poses.last_s(), 60);
  const Worst worst = worstOf(path.poses);
  EXPECT_LT(worst.turn, 1.1 * std::numbers::pi / 3);
}

TEST(WalkPath, NamesTheWaypointThatIsWrong) {
  const auto message = [](const std::vector<Waypoint>& waypoints) {
    const auto path = walkPath(waypoints);
    return path ? std::string("none") : describe(path.error());
  };
  EXPECT_EQ(message({to(0, 0)}), "a path needs at least two waypoints");
  EXPECT_EQ(message({to(0, 0), to(1, 0), to(1, 0.001)}), "waypoint 3: is where waypoint 2 is; delete one of them");
  EXPECT_EQ(message({to(0, 0), to(1, std::nan(""))}), "waypoint 2: is not a number");
  EXPECT_EQ(message({to(0, 0), to(90000, 0)}), "a path of 90 km is too long; the longest is 50 km");
}

}  // namespace
}  // namespace standpoint
