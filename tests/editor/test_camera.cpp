// SPDX-License-Identifier: GPL-3.0-or-later
#include <numbers>

#include <gtest/gtest.h>

#include "editor/camera/camera.h"

namespace standpoint {
namespace {

const Eigen::Vector2d kSize(800, 600);

Camera someCamera() {
  Camera camera;
  camera.target = {3, -2, 1};
  camera.distance_m = 12;
  camera.azimuth_rad = 0.9;
  camera.elevation_rad = 0.4;
  return camera;
}

TEST(Camera, FromTheFrontLooksAlongYWithXToTheRightAndZUp) {
  Camera camera;
  look(camera, StandardView::front);
  EXPECT_TRUE(camera.forward().isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_TRUE(camera.right().isApprox(Eigen::Vector3d::UnitX(), 1e-12));
  EXPECT_TRUE(camera.up().isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(Camera, FromAboveHasNorthUp) {
  Camera camera;
  look(camera, StandardView::top);
  EXPECT_TRUE(camera.forward().isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_TRUE(camera.up().isApprox(Eigen::Vector3d::UnitY(), 1e-12));
}

TEST(Camera, ARayThroughTheProjectionOfAPointMeetsThePoint) {
  for (const bool orthographic : {false, true}) {
    Camera camera = someCamera();
    camera.orthographic = orthographic;
    const Eigen::Vector3d point(4.5, 0.3, 2.2);
    const auto pixel = project(camera, point, kSize);
    ASSERT_TRUE(pixel);
    const auto ray = rayThrough(camera, *pixel, kSize);
    const double miss = (point - ray.origin).cross(ray.direction).norm();
    EXPECT_LT(miss, 1e-9) << "orthographic " << orthographic;
  }
}

TEST(Camera, DoesNotProjectWhatIsBehindTheEye) {
  const Camera camera = someCamera();
  EXPECT_FALSE(project(camera, camera.eye() - camera.forward(), kSize));
}

TEST(Camera, OrbitsAroundThePivotWithoutMovingItInThePicture) {
  Camera camera = someCamera();
  const Eigen::Vector3d pivot(2, 1, 0.5);
  const auto before = project(camera, pivot, kSize);
  orbit(camera, {83, -40}, pivot);
  const auto after = project(camera, pivot, kSize);
  ASSERT_TRUE(before && after);
  EXPECT_LT((*before - *after).norm(), 1e-6);
  EXPECT_NE(camera.azimuth_rad, someCamera().azimuth_rad);
}

TEST(Camera, NeverTurnsUpsideDown) {
  Camera camera = someCamera();
  orbit(camera, {0, 1e6}, camera.target);
  EXPECT_LE(camera.elevation_rad, std::numbers::pi / 2);
  orbit(camera, {0, -1e7}, camera.target);
  EXPECT_GE(camera.elevation_rad, -std::numbers::pi / 2);
}

TEST(Camera, PansThePointUnderThePointerWithThePointer) {
  Camera camera = someCamera();
  const Eigen::Vector3d point(3.5, -1, 1);
  const double depth = (point - camera.eye()).dot(camera.forward());
  const auto before = project(camera, point, kSize);
  pan(camera, {25, 14}, kSize, depth);
  const auto after = project(camera, point, kSize);
  EXPECT_LT((*after - *before - Eigen::Vector2d(25, 14)).norm(), 1e-6);
}

TEST(Camera, ZoomsTowardsTheAnchorWhichStaysUnderThePointer) {
  Camera camera = someCamera();
  const Eigen::Vector3d anchor(4, -3, 0);
  const auto before = project(camera, anchor, kSize);
  zoom(camera, 3, anchor);
  EXPECT_LT(camera.distance_m, someCamera().distance_m);
  EXPECT_LT((*project(camera, anchor, kSize) - *before).norm(), 1e-6);
}

TEST(Camera, FramesABoxSoThatEveryCornerIsInThePicture) {
  Bounds box;
  box.extend(Eigen::Vector3d(-7, 2, 0));
  box.extend(Eigen::Vector3d(30, 4, 9));
  for (const bool orthographic : {false, true})
    for (const auto view : {StandardView::front, StandardView::top, StandardView::corner, StandardView::left}) {
      Camera camera;
      camera.orthographic = orthographic;
      look(camera, view);
      frame(camera, box, kSize.x() / kSize.y());
      double widest = 0;
      for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d corner(i & 1 ? box.max.x() : box.min.x(), i & 2 ? box.max.y() : box.min.y(),
                                     i & 4 ? box.max.z() : box.min.z());
        const auto pixel = project(camera, corner, kSize);
        ASSERT_TRUE(pixel);
        EXPECT_GE(pixel->x(), 0);
        EXPECT_LE(pixel->x(), kSize.x());
        EXPECT_GE(pixel->y(), 0);
        EXPECT_LE(pixel->y(), kSize.y());
        widest = std::max({widest, std::abs(pixel->x() / kSize.x() - 0.5), std::abs(pixel->y() / kSize.y() - 0.5)});
      }
      EXPECT_GT(widest, 0.35) << "the box is lost in the picture";
    }
}

}  // namespace
}  // namespace standpoint
