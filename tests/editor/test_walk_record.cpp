// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "core/motion/walked_path.h"
#include "editor/trajectories/walk_record.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

constexpr double kBetween_s = 1.0 / 60;

// Along straight legs at 1.2 m/s, with a stop of 3 s where `stop` says, sixty frames a second.
WalkRecord walked(const std::vector<Vector3d>& corners, std::size_t stop = 0) {
  WalkRecord record;
  record.begin();
  double now = 100;
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const double length = (corners[k] - corners[k - 1]).norm();
    for (double at = 0; at < length; at += 1.2 * kBetween_s, now += kBetween_s)
      EXPECT_TRUE(record.follow(now, corners[k - 1] + (corners[k] - corners[k - 1]) * (at / length)));
    EXPECT_TRUE(record.follow(now, corners[k]));
    if (k == stop)
      for (double stood = 0; stood < 3; stood += kBetween_s) EXPECT_TRUE(record.follow(now += kBetween_s, corners[k]));
  }
  return record;
}

TEST(WalkRecord, IsAPathThatStraysByCentimetres) {
  const std::vector<Vector3d> corners = {{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {2, 4, 0.7}, {2, 9, 0.7}};
  const auto record = walked(corners);
  EXPECT_NEAR(record.length_m(), 19.06, 0.05);
  EXPECT_NEAR(record.speed_mps(), 1.2, 0.02);
  const auto waypoints = record.waypoints();
  EXPECT_EQ(waypoints.size(), corners.size());
  PathLimits limits;
  limits.height_m = 0;
  const auto path = walkPath(waypoints, limits);
  ASSERT_TRUE(path) << path.error().message;
  double worst = 0;
  for (double time_s = 0; time_s < path->poses.last_s(); time_s += 0.05) {
    const Vector3d place = path->poses.pose(time_s).translation;
    double nearest = 1e9;
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const Vector3d leg = corners[k] - corners[k - 1];
      const double along = std::clamp((place - corners[k - 1]).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (place - corners[k - 1] - along * leg).norm());
    }
    worst = std::max(worst, nearest);
  }
  EXPECT_LT(worst, 0.15);
}

TEST(WalkRecord, StopsWhereSomebodyStood) {
  const auto waypoints = walked({{0, 0, 0}, {2, 0, 0}, {5, 0, 0}}, 1).waypoints();
  double stopped = 0;
  for (const auto& waypoint : waypoints)
    if (waypoint.stop_s > 0) {
      stopped += waypoint.stop_s;
      EXPECT_NEAR((waypoint.floor_m - Vector3d(2, 0, 0)).norm(), 0, 0.03);
    }
  EXPECT_NEAR(stopped, 3, 0.15);
}

TEST(WalkRecord, EndsWhereSomebodyJumps) {
  auto record = walked({{0, 0, 0}, {2, 0, 0}});
  EXPECT_FALSE(record.follow(200, {10, 0, 0}));
  EXPECT_FALSE(record.active());
  EXPECT_NEAR(record.length_m(), 2, 0.03);
}

TEST(WalkRecord, OfNobodyWhoWalkedHasNoWaypoints) {
  WalkRecord record;
  record.begin();
  EXPECT_TRUE(record.waypoints().empty());
  EXPECT_TRUE(record.follow(1, {0, 0, 0}));
  EXPECT_TRUE(record.waypoints().empty());
  EXPECT_EQ(record.speed_mps(), 0);
}

}  // namespace
}  // namespace standpoint
