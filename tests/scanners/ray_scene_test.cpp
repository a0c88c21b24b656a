// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <gtest/gtest.h>

#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using testing::SceneBuilder;

TEST(RayScene, MeetsTheNearestFaceFromBothSides) {
  SceneBuilder scene;
  scene.quad({5, -1, -1}, {0, 2, 0}, {0, 0, 2});
  const auto wall = scene.quad({3, -1, -1}, {0, 2, 0}, {0, 0, 2});
  const auto rays = scene.build();
  const auto hit = rays->intersect({0, 0, 0.2}, {1, 0, 0}, 100);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range_m, 3, 1e-9);
  EXPECT_EQ(hit->product, wall);
  EXPECT_NEAR((hit->normal - Eigen::Vector3d(-1, 0, 0)).norm(), 0, 1e-12);
  const auto behind = rays->intersect({10, 0, 0.2}, {-1, 0, 0}, 100);
  ASSERT_TRUE(behind);
  EXPECT_NEAR(behind->range_m, 5, 1e-9);
  EXPECT_FALSE(rays->intersect({0, 0, 0}, {-1, 0, 0}, 100));
  EXPECT_FALSE(rays->intersect({0, 0, 0}, {1, 0, 0}, 2.9));
}

TEST(RayScene, LeavesOutWhatIsNotTangible) {
  SceneBuilder scene;
  scene.hide(scene.quad({3, -1, -1}, {0, 2, 0}, {0, 0, 2}));
  const auto wall = scene.quad({5, -1, -1}, {0, 2, 0}, {0, 0, 2});
  EXPECT_EQ(scene.build()->intersect({0, 0, 0}, {1, 0, 0}, 100)->product, wall);
}

TEST(RayScene, PlacesSharedMeshesWhereTheyStand) {
  SceneBuilder scene;
  const auto first = scene.sphere({0, 0, 0}, 0.5, 40);  // 6,400 triangles: too large to be copied
  Eigen::Affine3d moved = Eigen::Affine3d::Identity();
  moved.translate(Eigen::Vector3d(8, 0, 0)).rotate(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()));
  const auto second = scene.again(first, moved);
  moved.translation() = Eigen::Vector3d(0, 6, 0);
  const auto mirrored = scene.again(first, moved * Eigen::Scaling(-1.0, 1.0, 2.0));
  const auto rays = scene.build();
  const auto along = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return rays->intersect(from, (to - from).normalized(), 100);
  };
  EXPECT_EQ(along({4, 0, 0}, {0, 0, 0})->product, first);
  EXPECT_EQ(along({4, 0, 0}, {8, 0, 0})->product, second);
  const auto hit = along({0, 6, 9}, {0, 6, 0});
  EXPECT_EQ(hit->product, mirrored);
  EXPECT_NEAR(hit->range_m, 8, 1e-3);  // stretched to a height of 1 m; 40 rings
  EXPECT_GT(hit->normal.z(), 0.9);
}

TEST(RayScene, MeetsASphereAtItsRadius) {
  SceneBuilder scene;
  scene.sphere({6, 1, 2}, 0.0725, 90);
  const auto rays = scene.build();
  const auto hit = rays->intersect({0, 0, 0}, Eigen::Vector3d(6, 1, 2).normalized(), 100);
  ASSERT_TRUE(hit);
  // A chord of 2° stays inside by at most r (1 - cos 1°)·2.
  EXPECT_NEAR(hit->range_m, std::sqrt(41.0) - 0.0725, 0.0725 * 3.1e-4);
}

TEST(RayScene, LosesNoRayInTheSeamsOfARoom) {
  SceneBuilder scene;
  scene.box({-4, -3, 0}, {5, 6, 3}, true);
  const auto rays = scene.build();
  for (int k = 0; k < 20000; ++k) {  // towards the edges, where two faces meet
    const double fraction = k / 20000.0;
    for (const Eigen::Vector3d& edge : {Eigen::Vector3d(5, -3 + 9 * fraction, 3),
                                        Eigen::Vector3d(-4 + 9 * fraction, 6, 0), Eigen::Vector3d(5, 6, 3 * fraction)})
      ASSERT_TRUE(rays->intersect({0.3, 0.2, 1.7}, (edge - Eigen::Vector3d(0.3, 0.2, 1.7)).normalized(), 100))
          << edge.transpose();
  }
}

TEST(RayScene, OfNothingMeetsNothing) {
  SceneBuilder scene;
  EXPECT_FALSE(scene.build()->intersect({0, 0, 0}, {1, 0, 0}, 100));
}

TEST(RayScene, RefusesABrokenEnvironmentAndStopsWhenCancelled) {
  auto broken = std::make_shared<Environment>();
  broken->instances.emplace_back();
  Progress progress;
  EXPECT_EQ(RayScene::build(broken, progress).error().kind, ErrorKind::unusable);
  SceneBuilder scene;
  scene.box({0, 0, 0}, {1, 1, 1}, false);
  progress.cancel();
  EXPECT_EQ(RayScene::build(scene.environment(), progress).error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace standpoint
