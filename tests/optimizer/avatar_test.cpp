// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/avatar.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

CollisionShape obstacleBox(const Vector3d& low, const Vector3d& size) {
  CollisionShape shape{CollisionShapeKind::box, 0, {}};
  models::append(shape.mesh, models::box(size, 1), Eigen::Affine3d(Eigen::Translation3d(low)));
  return shape;
}

// A room of 4 x 5 m with a doorway of 0.9 x 2.1 m in its wall at x = 4, and floor behind it.
std::vector<CollisionShape> room() {
  return {obstacleBox({-1, -1, -0.2}, {10, 7, 0.2}),   obstacleBox({-0.2, -0.2, 0}, {0.2, 5.4, 2.8}),
          obstacleBox({0, -0.2, 0}, {4.2, 0.2, 2.8}),  obstacleBox({0, 5, 0}, {4.2, 0.2, 2.8}),
          obstacleBox({4, 0, 0}, {0.2, 2.05, 2.8}),    obstacleBox({4, 2.95, 0}, {0.2, 2.05, 2.8}),
          obstacleBox({4, 2.05, 2.1}, {0.2, 0.9, 0.7})};
}

TEST(Avatar, StopsAtAWallAndSlidesAlongIt) {
  const Obstacles obstacles(room());
  Avatar avatar(obstacles);
  ASSERT_TRUE(avatar.stand({2, 1, 1}));
  EXPECT_NEAR(avatar.feet().z(), 0, 1e-6);
  avatar.walk({0, -3});
  EXPECT_NEAR((avatar.feet() - Vector3d(2, 0.3, 0)).norm(), 0, 1e-4);
  avatar.walk({1, -1});
  EXPECT_NEAR((avatar.feet() - Vector3d(3, 0.3, 0)).norm(), 0, 1e-3);
  avatar.walk({5, -5});
  EXPECT_NEAR((avatar.feet() - Vector3d(3.7, 0.3, 0)).norm(), 0, 1e-3) << "into the corner";
}

TEST(Avatar, GoesThroughTheDoorwayThatIsWideEnough) {
  const Obstacles obstacles(room());
  Avatar slim(obstacles, {0.44, 1.8}), wide(obstacles, {0.46, 1.8}), tall(obstacles, {0.3, 2.15});
  for (auto* avatar : {&slim, &wide, &tall}) {
    ASSERT_TRUE(avatar->stand({2, 2.5, 0}));
    avatar->walk({4, 0});
  }
  EXPECT_NEAR(slim.feet().x(), 6, 1e-6);
  EXPECT_LT(wide.feet().x(), 4);
  EXPECT_LT(tall.feet().x(), 4);
}

TEST(Avatar, NeverLeavesAClosedRoom) {
  auto shapes = room();
  shapes.push_back(obstacleBox({4.07, 2.05, 0}, {0.06, 0.9, 2.1}));  // the door is closed
  const Obstacles obstacles(shapes);
  Avatar avatar(obstacles);
  ASSERT_TRUE(avatar.stand({2, 2.5, 0}));
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const auto r = philox({3, 0}, i, 0, 0);
    const double angle = 6.283185307 * uniform(r[0]);
    avatar.walk(Vector2d(std::cos(angle), std::sin(angle)) * 2 * uniform(r[1]));
    const Vector3d& feet = avatar.feet();
    ASSERT_TRUE(feet.x() > 0.2999 && feet.x() < 4.0701 - 0.3 + 1e-4 && feet.y() > 0.2999 && feet.y() < 4.7001)
        << feet.transpose();
    ASSERT_NEAR(feet.z(), 0, 1e-6);
  }
}

TEST(Avatar, ClimbsAStairUpAndDownWithItsFeetOnTheTreads) {
  std::vector<CollisionShape> shapes{obstacleBox({-3, 0, -0.2}, {3, 1.2, 0.2})};
  for (int i = 0; i < 16; ++i) shapes.push_back(obstacleBox({0.28 * i, 0, 0}, {0.28, 1.2, 0.17 * (i + 1)}));
  shapes.push_back(obstacleBox({0.28 * 16, 0, 0}, {3, 1.2, 0.17 * 16}));
  const Obstacles obstacles(shapes);
  Avatar avatar(obstacles);
  ASSERT_TRUE(avatar.stand({-1.003, 0.6, 0}));
  const auto height = [](double x) { return x < 0 ? 0 : 0.17 * std::min(16.0, std::floor(x / 0.28 + 1e-9) + 1); };
  for (int i = 0; i < 700; ++i) {
    avatar.walk({0.01, 0});
    ASSERT_NEAR(avatar.feet().z(), height(avatar.feet().x()), 0.02) << avatar.feet().x();
  }
  EXPECT_NEAR(avatar.feet().x(), 5.997, 1e-6);
  EXPECT_NEAR(avatar.feet().z(), 2.72, 1e-5);
  avatar.walk({-7, 0});
  EXPECT_NEAR((avatar.feet() - Vector3d(-1.003, 0.6, 0)).norm(), 0, 1e-5);
}

TEST(Avatar, StaysOffWhatIsTooHighTooDeepOrTooSteep) {
  Mesh ramp;  // 46 degrees, and one of 44
  for (const double rise : {std::tan(46 * 0.017453292519943295), std::tan(44 * 0.017453292519943295)})
    for (const auto& p : {Vector3d(0, 0, 0), Vector3d(2, 0, 2 * rise), Vector3d(2, 2, 2 * rise), Vector3d(0, 2, 0)})
      ramp.positions.push_back(p.cast<float>());
  for (std::size_t i = 4; i < 8; ++i) ramp.positions[i].y() += 2;
  ramp.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  ramp.surface_of_triangle.assign(4, 0);
  std::vector<CollisionShape> shapes{obstacleBox({-4, 0, -0.2}, {4, 4, 0.2}), obstacleBox({-3, 0, 0}, {1, 1, 0.31}),
                                     obstacleBox({-3, 3, 0}, {1, 1, 0.29})};
  shapes.push_back({CollisionShapeKind::mesh, 1, ramp});
  const Obstacles obstacles(shapes);
  const auto after = [&](const Vector3d& from, const Vector2d& way) {
    Avatar avatar(obstacles);
    EXPECT_TRUE(avatar.stand(from));
    avatar.walk(way);
    return avatar.feet();
  };
  EXPECT_LT(after({-1, 1, 0}, {2, 0}).x(), 0.001) << "46 degrees";
  EXPECT_NEAR(after({-1, 3, 0}, {2, 0}).z(), std::tan(44 * 0.017453292519943295), 1e-4);
  EXPECT_GT(after({-1, 0.5, 0}, {-1.5, 0}).x(), -2) << "31 cm";
  EXPECT_NEAR(after({-1, 3.5, 0}, {-1.5, 0}).z(), 0.29, 1e-5);
  EXPECT_GT(after({-1, 2, 0}, {-9, 0}).x(), -4.0001) << "where the floor ends";
  EXPECT_LT(after({-1, 2, 0}, {-9, 0}).x(), -3.9);
}

TEST(Avatar, StepsOverACrackAndStandsNowhereElse) {
  const Obstacles obstacles(
      std::vector{obstacleBox({0, 0, -0.2}, {2, 2, 0.2}), obstacleBox({2.03, 0, -0.2}, {2, 2, 0.2})});
  Avatar avatar(obstacles);
  ASSERT_TRUE(avatar.stand({1, 1, 0}));
  EXPECT_FALSE(avatar.stand({9, 9, 0}));
  EXPECT_EQ(avatar.feet().x(), 1);
  avatar.walk({2, 0});
  EXPECT_NEAR((avatar.feet() - Vector3d(3.04, 1, 0)).norm(), 0, 1e-6) << "over the crack in one stride";
  avatar.walk({std::nan(""), 0});
  EXPECT_NEAR((avatar.feet() - Vector3d(3.04, 1, 0)).norm(), 0, 1e-6);
  const Obstacles gap(std::vector{obstacleBox({0, 0, -0.2}, {2, 2, 0.2}), obstacleBox({2.1, 0, -0.2}, {2, 2, 0.2})});
  Avatar careful(gap);
  ASSERT_TRUE(careful.stand({1, 1, 0}));
  careful.walk({2, 0});
  EXPECT_LE(careful.feet().x(), 2);
}

}  // namespace
}  // namespace standpoint
