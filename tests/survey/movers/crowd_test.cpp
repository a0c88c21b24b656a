// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/movers/crowd.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/motion/mechanisms.h"
#include "core/motion/walked_path.h"
#include "survey/movers/moving_world.h"

namespace standpoint {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Rectangle {
  float x0, y0, x1, y1;
};

Mesh floorWith(const std::vector<Rectangle>& rectangles) {
  Mesh mesh;
  for (const auto& r : rectangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& [x, y] : {std::pair{r.x0, r.y0}, {r.x1, r.y0}, {r.x1, r.y1}, {r.x0, r.y1}})
      mesh.positions.emplace_back(x, y, 0.0F);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

std::vector<Mover> crowdIn(const Mesh& floor, int count, std::span<const CrowdObstacle> obstacles = {},
                           Report* said = nullptr) {
  Progress progress;
  Report report;
  CrowdWish wish{.name = "crowd", .count = count};
  const auto crowd = crowdOn(floor, wish, obstacles, said != nullptr ? *said : report, progress);
  EXPECT_TRUE(crowd);
  return crowd ? *crowd : std::vector<Mover>{};
}

std::vector<PoseFunctionPtr> pathsOf(const std::vector<Mover>& movers) {
  std::vector<PoseFunctionPtr> paths;
  for (const Mover& mover : movers) paths.push_back(*moverPath(mover));
  return paths;
}

// Over the first way there and back.
double nearestPair_m(const std::vector<PoseFunctionPtr>& paths) {
  double nearest = 1e9;
  for (double t = -30; t < 215; t += 0.05) {
    std::vector<Vector2d> at;
    for (const auto& path : paths) at.emplace_back(path->pose(t).translation.head<2>());
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t k = i + 1; k < at.size(); ++k) nearest = std::min(nearest, (at[i] - at[k]).norm());
  }
  return nearest;
}

// Of those who walk, in steps of half a second.
std::vector<double> speedsAlong(const PoseFunction& path) {
  std::vector<double> found;
  for (double t = -25; t < 85; t += 0.5)
    if (const double speed = velocity(path, t).linear_mps.norm(); speed > 0.3) found.push_back(speed);
  std::sort(found.begin(), found.end());
  return found;
}

// Of those who walk on for a second before and after and turn by less than 30° meanwhile: the part of their free speed.
double straightOn(const std::vector<Mover>& movers) {
  double sum = 0;
  std::size_t count = 0;
  for (const Mover& mover : movers) {
    const auto path = *moverPath(mover);
    const auto going = [&](double t) -> Vector2d { return velocity(*path, t).linear_mps.head<2>(); };
    for (double t = -24; t < 84; t += 0.2) {
      bool walks = true;
      for (double off = -1; off < 1.1; off += 0.2) walks = walks && going(t + off).norm() > 0.3;
      if (!walks || going(t - 1).normalized().dot(going(t + 1).normalized()) < 0.866) continue;
      sum += going(t).norm() / mover.speed, ++count;
    }
  }
  EXPECT_GT(count, 200U);
  return sum / static_cast<double>(std::max<std::size_t>(1, count));
}

double meanFreeSpeed(const std::vector<Mover>& movers) {
  double sum = 0;
  for (const Mover& mover : movers) sum += mover.speed / static_cast<double>(movers.size());
  return sum;
}

TEST(Crowd, NeverBringsTwoCentresNearerThanABody) {
  for (const int count : {20, 60}) {
    const auto movers = crowdIn(floorWith({{0, 0, 8, 8}}), count);
    ASSERT_EQ(movers.size(), static_cast<std::size_t>(count));
    const double nearest_m = nearestPair_m(pathsOf(movers));
    RecordProperty("nearest_m_of_" + std::to_string(count), std::to_string(nearest_m));
    EXPECT_GE(nearest_m, kBodyDiameter_m) << count;
  }
}

TEST(Crowd, WalksAtItsOwnSpeedWhereThereIsRoom) {
  const auto movers = crowdIn(floorWith({{0, 0, 40, 40}}), 10);  // 0.006 a square metre
  for (const Mover& mover : movers) {
    const auto sorted = speedsAlong(**moverPath(mover));
    ASSERT_GT(sorted.size(), 50U);
    EXPECT_NEAR(sorted[sorted.size() / 2], mover.speed, 0.05 * mover.speed) << mover.name;
  }
  EXPECT_NEAR(meanFreeSpeed(movers), 1.34, 0.26);
}

TEST(Crowd, WalksStraightOnByTheLawOfItsDensity) {
  EXPECT_NEAR(crowdedSpeed(0.1), 1, 1e-6);
  EXPECT_NEAR(crowdedSpeed(1), 0.79, 0.005);
  EXPECT_NEAR(crowdedSpeed(2), 0.45, 0.005);
  EXPECT_NEAR(crowdedSpeed(5.4), 0, 1e-9);
  for (const auto& [count, density] : {std::pair{6, 0.1}, {32, 0.5}, {64, 1.0}}) {
    const double part = straightOn(crowdIn(floorWith({{0, 0, 8, 8}}), count));
    RecordProperty("part_at_" + std::to_string(count), std::to_string(part));
    EXPECT_NEAR(part, crowdedSpeed(density), 0.1 * crowdedSpeed(density)) << density;
  }
}

// When each begins to walk, and when each walks for the last time before all go back: more than ten seconds apart, and
// no more than a third of them within three seconds.
TEST(Crowd, NeitherSetsOffNorTurnsAsOne) {
  std::vector<double> first, last;
  for (const auto& path : pathsOf(crowdIn(floorWith({{0, 0, 12, 12}}), 30))) {
    std::vector<double> walks;
    for (double t = -30; t < 90; t += 0.1)
      if (velocity(*path, t).linear_mps.norm() > 0.5) walks.push_back(t);
    ASSERT_FALSE(walks.empty());
    first.push_back(walks.front()), last.push_back(walks.back());
  }
  for (auto* times : {&first, &last}) {
    std::sort(times->begin(), times->end());
    EXPECT_GT(times->back() - times->front(), 10);
    for (std::size_t i = 0; i + 10 < times->size(); ++i) EXPECT_GT((*times)[i + 10] - (*times)[i], 3);
  }
}

TEST(Crowd, StaysOnTheSurfaceAndGetsThroughADoor) {
  // Two rooms and, of a door of 0.9 m, what a body leaves of it.
  const auto floor = floorWith({{0, 0, 5, 4}, {5, 1.8F, 5.8F, 2.2F}, {5.8F, 0, 11, 4}});
  const auto movers = crowdIn(floor, 12);
  std::size_t changed_rooms = 0;
  for (const Mover& mover : movers) {
    bool left = false, right = false;
    double way = 0;
    for (std::size_t i = 0; i < mover.way_m.size(); ++i) {
      const Vector3d& p = mover.way_m[i];
      EXPECT_TRUE((p.x() > -0.002 && p.x() < 11.002 && p.y() > -0.002 && p.y() < 4.002)) << p;
      if (p.x() > 5.002 && p.x() < 5.798) {
        EXPECT_TRUE(p.y() > 1.797 && p.y() < 2.203) << p;
      }
      EXPECT_EQ(p.z(), 0);
      left |= p.x()<5, right |= p.x()> 5.8;
      if (i > 0) way += (p - mover.way_m[i - 1]).norm();
    }
    changed_rooms += left && right ? 1 : 0;
    EXPECT_GT(way, 20) << mover.name << " in two minutes";
  }
  EXPECT_GE(changed_rooms, 8U);
}

TEST(Crowd, LeavesRoomForATripodAndMakesWayForWhoCarriesAScanner) {
  const auto tripod = std::make_shared<ConstantPose>(Pose{Eigen::Quaterniond::Identity(), {4, 4, 0}});
  const std::vector<Waypoint> round = {{{1, 2, 0}}, {{7, 2, 0}}, {{7, 6, 0}}, {{1, 6, 0}}, {{1, 2.2, 0}}};
  const auto walked = walkPath(round, {.height_m = 0});
  ASSERT_TRUE(walked);
  const auto walker = std::make_shared<TimedPose>(std::make_shared<PoseSpline>(walked->poses), 0, false);
  const std::vector<CrowdObstacle> obstacles = {{tripod, 0.45}, {walker, 0.4}};
  const auto paths = pathsOf(crowdIn(floorWith({{0, 0, 8, 8}}), 20, obstacles));
  std::size_t moments = 0, near = 0;
  for (double t = -30; t < 90; t += 0.05)
    for (const auto& path : paths) {
      const Vector2d at = path->pose(t).translation.head<2>();
      EXPECT_GE((at - Vector2d(4, 4)).norm(), 0.45 + kBodyDiameter_m / 2);
      if (t < 0 || t > walker->last_s()) continue;
      ++moments;
      near += (at - walker->pose(t).translation.head<2>()).norm() < kBodyDiameter_m ? 1 : 0;
    }
  EXPECT_GT(moments, 1000U);
  EXPECT_LT(static_cast<double>(near), 0.001 * static_cast<double>(moments));
}

TEST(Crowd, GoesTheSameWaysAgain) {
  const auto floor = floorWith({{0, 0, 8, 8}});
  EXPECT_EQ(crowdIn(floor, 30), crowdIn(floor, 30));
  Progress progress;
  Report report;
  const auto other = crowdOn(floor, {.name = "crowd", .count = 30, .seed = 2}, {}, report, progress);
  ASSERT_TRUE(other);
  EXPECT_NE(*other, crowdIn(floor, 30));
}

TEST(Crowd, ComesBackTheWayItWentLookingAhead) {
  const auto movers = crowdIn(floorWith({{0, 0, 20, 20}}), 3);
  for (const auto& path : pathsOf(movers)) {
    std::size_t looks_ahead = 0, walks = 0;
    for (double t = -29; t < 205; t += 0.25) {
      const Vector3d going = velocity(*path, t).linear_mps;
      if (going.norm() < 0.5) continue;
      ++walks, looks_ahead += (path->pose(t).rotation * Vector3d::UnitX()).dot(going.normalized()) > 0.8 ? 1 : 0;
    }
    EXPECT_GT(walks, 300U);
    EXPECT_GT(static_cast<double>(looks_ahead), 0.95 * static_cast<double>(walks));
    // 120 s there, 1 s to turn, and back.
    EXPECT_LT((path->pose(-30 + 20).translation - path->pose(-30 + 241 + 0.2 - 20).translation).norm(), 0.01);
  }
}

TEST(Crowd, WalksForAsLongAsATrajectoryLastsWithinABound) {
  Progress progress;
  Report report;
  CrowdWish wish{.name = "crowd", .count = 2, .until_s = 300};
  const auto longer = crowdOn(floorWith({{0, 0, 8, 8}}), wish, {}, report, progress);
  ASSERT_TRUE(longer);
  EXPECT_EQ((*longer)[0].way_m.size(), 330 / kWayStep_s + 1);
  EXPECT_TRUE(report.issues.empty());
  wish.until_s = 1e6;
  const auto bounded = crowdOn(floorWith({{0, 0, 8, 8}}), wish, {}, report, progress);
  ASSERT_TRUE(bounded);
  EXPECT_EQ((*bounded)[0].way_m.size(), 3600 / kWayStep_s + 1);
  ASSERT_EQ(report.issues.size(), 1U);
  EXPECT_NE(report.issues[0].message.find("until 3570 s"), std::string::npos);
}

TEST(Crowd, SaysWhoFoundNoRoom) {
  Report report;
  const auto movers = crowdIn(floorWith({{0, 0, 2, 1.5F}}), 40, {}, &report);
  EXPECT_LT(movers.size(), 20U);
  ASSERT_EQ(report.issues.size(), 1U);
  EXPECT_NE(report.issues[0].message.find("of 40 people found no room"), std::string::npos);
  Progress progress;
  const auto none = crowdOn(floorWith({{0, 0, 1, 1}}), {.name = "crowd"}, {}, report, progress);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no walkable surface has room"), std::string::npos);
}

}  // namespace
}  // namespace standpoint
