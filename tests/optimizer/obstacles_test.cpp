// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/obstacles.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

CollisionShape shape(const Mesh& mesh, const Vector3d& place, CollisionShapeKind kind, std::uint32_t product) {
  CollisionShape result{kind, product, {}};
  models::append(result.mesh, mesh, Eigen::Affine3d(Eigen::Translation3d(place)));
  return result;
}

// A cube of a metre with its lower corner at (2, 0, 0), solid or as its triangles.
Obstacles cube(CollisionShapeKind kind) {
  return Obstacles(std::vector{shape(models::box({1, 1, 1}, 1), {2, 0, 0}, kind, 5)});
}

TEST(Sweep, StopsWhereTheBodyTouches) {
  for (const auto kind : {CollisionShapeKind::box, CollisionShapeKind::convex, CollisionShapeKind::mesh}) {
    const auto obstacles = cube(kind);
    const auto hit = obstacles.sweep({0.3, 1.8}, {0, 0.5, 0.1}, {4, 0.5, 0.1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->fraction * 4, 1.7, 1e-4);
    EXPECT_NEAR((hit->normal - Vector3d(-1, 0, 0)).norm(), 0, 1e-4);
    EXPECT_NEAR(hit->point.x(), 2, 1e-4);
    EXPECT_EQ(hit->product, 5);
    // A ball that comes down on an upper edge: it meets it where its middle is a radius away.
    const auto edge = obstacles.sweep({0.5, 1}, {1.7, 0.5, 3}, {1.7, 0.5, -1});
    ASSERT_TRUE(edge);
    EXPECT_NEAR(3 - 4 * edge->fraction, 1 + std::sqrt(0.25 - 0.09) - 0.5, 1e-4);
  }
}

TEST(Sweep, PassesBesideAndSlidesAlong) {
  const auto obstacles = cube(CollisionShapeKind::box);
  EXPECT_TRUE(obstacles.sweep({0.3, 1.8}, {0, -0.299, 0}, {4, -0.299, 0}));
  EXPECT_FALSE(obstacles.sweep({0.3, 1.8}, {0, -0.3001, 0}, {4, -0.3001, 0}));
  EXPECT_FALSE(obstacles.sweep({0.3, 1.8}, {2.5, 0.5, 1}, {2.5, 3, 1})) << "on its top";
  EXPECT_FALSE(obstacles.sweep({0.3, 1.8}, {2.5, 0.5, 1.2}, {2.5, 0.5, 3})) << "away from it";
}

TEST(Sweep, ThatStartsInsideIsStoppedAtOnce) {
  const auto hit = cube(CollisionShapeKind::box).sweep({0.05, 0.1}, {2.5, 0.5, 0.5}, {9, 0.5, 0.5});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->fraction, 0);
}

// Against the triangle that holds it: every way from outside through its inside must be stopped, however thin it is.
TEST(Sweep, NeverPassesAThinTriangle) {
  for (std::uint32_t i = 0; i < 300; ++i) {
    const auto r = philox({1, 0}, i, 0, 0), q = philox({1, 0}, i, 1, 0);
    CollisionShape sliver{CollisionShapeKind::mesh, 0, {}};
    const double height = std::pow(10, -4 + 4 * uniform(r[0]));
    for (const auto& p :
         {Vector3d(0, 0, 0), Vector3d(20 * uniform(r[1]), 0, 0), Vector3d(10 * uniform(r[2]), 0, height)})
      sliver.mesh.positions.push_back(p.cast<float>());
    sliver.mesh.triangles = {{0, 1, 2}};
    const Vector3d inside =
        (sliver.mesh.positions[0] + sliver.mesh.positions[1] + sliver.mesh.positions[2]).cast<double>() / 3;
    const Vector3d way(uniform(q[0]) - 0.5, 0.3 + uniform(q[1]), uniform(q[2]) - 0.5);
    const Vector3d feet = inside - Vector3d(0, 0, 0.05);
    EXPECT_TRUE(Obstacles(std::vector{sliver}).sweep({0.05, 0.1}, feet - way, feet + way)) << i;
  }
}

TEST(Overlap, NamesTheDeepest) {
  const Obstacles obstacles(std::vector{shape(models::box({1, 1, 1}, 1), {0, 0, 0}, CollisionShapeKind::box, 1),
                                        shape(models::box({1, 1, 1}, 1), {1.5, 0, 0}, CollisionShapeKind::convex, 2)});
  EXPECT_EQ(obstacles.overlap({0.3, 1.8}, {1.28, 0.5, 0})->product, 2);
  EXPECT_EQ(obstacles.overlap({0.3, 1.8}, {1.22, 0.5, 0})->product, 1);
  EXPECT_FALSE(obstacles.overlap({0.2, 1.8}, {1.25, 0.5, 0}));
  EXPECT_FALSE(obstacles.overlap({0.3, 1.8}, {1.25, 0.5, 0}, 0.06));
}

TEST(Ray, MeetsTheNearestFace) {
  const auto hit = cube(CollisionShapeKind::box).ray({2.25, 0.5, 3}, {2.25, 0.5, -3});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.z(), 1, 1e-9);
  EXPECT_NEAR(hit->normal.z(), 1, 1e-9);
  EXPECT_FALSE(cube(CollisionShapeKind::box).ray({1, 0.5, 3}, {1, 0.5, -3}));
}

TEST(Obstacles, OfNothingStopNobody) {
  const Obstacles none(std::vector<CollisionShape>{});
  EXPECT_FALSE(none.sweep({0.3, 1.8}, {0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(none.overlap({0.3, 1.8}, {0, 0, 0}));
  EXPECT_FALSE(none.ray({0, 0, 0}, {1, 0, 0}));
}

}  // namespace
}  // namespace standpoint
