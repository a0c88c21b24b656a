// SPDX-License-Identifier: GPL-3.0-or-later
#include <numeric>

#include <gtest/gtest.h>

#include "core/environment.h"

namespace standpoint {
namespace {

Mesh cube(float size) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.positions.emplace_back(size * static_cast<float>(i & 1), size * static_cast<float>(i >> 1 & 1),
                             size * static_cast<float>(i >> 2));
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  m.surface_of_triangle.assign(12, 0);
  return m;
}

TEST(Mesh, OfACubeHasItsAreaAndVolumeAndIsClosed) {
  const Mesh m = cube(2);
  EXPECT_DOUBLE_EQ(area(m), 24);
  EXPECT_DOUBLE_EQ(volume(m), 8);
  EXPECT_TRUE(isClosed(m));
}

TEST(Mesh, WithAMissingTriangleIsOpen) {
  Mesh m = cube(1);
  m.triangles.pop_back();
  m.surface_of_triangle.pop_back();
  EXPECT_FALSE(isClosed(m));
}

TEST(Mesh, IsClosedEvenWhenEachTriangleHasItsOwnCorners) {
  const Mesh shared = cube(1);
  Mesh soup;
  for (const auto& t : shared.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const auto i : t) soup.positions.push_back(shared.positions[i]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(isClosed(soup));
}

TEST(Mesh, IsSortedBySurfaceWithoutChangingTheOrderWithinOne) {
  Mesh m = cube(1);
  std::iota(m.surface_of_triangle.begin(), m.surface_of_triangle.end(), 0U);
  for (auto& s : m.surface_of_triangle) s %= 3;
  const auto original = m.triangles;
  sortBySurface(m);
  EXPECT_EQ(m.surface_of_triangle, (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(m.triangles[1], original[3]);
  EXPECT_EQ(m.triangles[4], original[1]);
  EXPECT_EQ(validate(m, 3), "");
}

TEST(Mesh, WithAnIndexOutOfRangeIsRefused) {
  Mesh m = cube(1);
  m.triangles[3][1] = 8;
  EXPECT_NE(validate(m, 1), "");
  EXPECT_NE(validate(cube(1), 0), "");
}

TEST(Bounds, CountOnlyTheCornersThatTrianglesUse) {
  Mesh m = cube(1);
  m.positions.emplace_back(100, 100, 100);
  const Bounds b = bounds(m, Eigen::Affine3d(Eigen::Translation3d(5000000, 0, 0)));
  EXPECT_EQ(b.min.x(), 5000000);
  EXPECT_EQ(b.max.x(), 5000001);
}

TEST(Environment, RefusesInstancesOutOfOrder) {
  Environment e;
  e.surfaces.resize(1);
  e.products.resize(2);
  e.meshes.push_back(std::make_shared<const Mesh>(cube(1)));
  e.instances = {{0, 1, Eigen::Affine3d::Identity()}, {0, 0, Eigen::Affine3d::Identity()}};
  EXPECT_NE(validate(e), "");
  std::swap(e.instances[0], e.instances[1]);
  EXPECT_EQ(validate(e), "");
  EXPECT_EQ(triangleCount(e), 24U);
}

TEST(Bounds, AreThoseOfEveryUsedCornerHoweverTheMeshStands) {
  Mesh mesh;
  mesh.positions = {{1, 2, 3}, {-4, 5, 0.5F}, {2, -1, 7}, {100, 100, 100}};  // nothing uses the last
  mesh.triangles = {{0, 1, 2}};
  mesh.surface_of_triangle = {0};
  Eigen::Matrix3d y_up, mirrored;
  y_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  mirrored << 0, -2, 0, 0.5, 0, 0, 0, 0, 3;
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  for (const Eigen::Matrix3d& linear : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), y_up, mirrored, turned}) {
    const Eigen::Affine3d placed = Eigen::Translation3d(1e6, -5, 0.25) * Eigen::Affine3d(linear);
    Bounds expected;
    for (std::size_t i = 0; i < 3; ++i) expected.extend(Eigen::Vector3d(placed * mesh.positions[i].cast<double>()));
    const Bounds found = bounds(mesh, placed);
    EXPECT_EQ(found.min, expected.min);
    EXPECT_EQ(found.max, expected.max);
  }
  EXPECT_TRUE(bounds(Mesh(), Eigen::Affine3d::Identity()).empty());
}

TEST(Bounds, OfProductsThatShareAMeshAreThoseOfEachPlace) {
  Environment e;
  e.surfaces.resize(1);
  e.products.resize(3);
  e.meshes = {std::make_shared<const Mesh>(cube(1)), std::make_shared<const Mesh>()};
  const Eigen::Affine3d far(Eigen::Translation3d(10, 0, 0));
  const Eigen::Affine3d turned(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  e.instances = {{0, 0, Eigen::Affine3d::Identity()}, {0, 0, far}, {0, 1, turned}, {0, 1, far}, {1, 2, far}};
  const auto boxes = productBounds(e);
  Bounds second = bounds(*e.meshes[0], turned);
  second.extend(bounds(*e.meshes[0], far));
  EXPECT_EQ(boxes[0].min, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(boxes[0].max, Eigen::Vector3d(11, 1, 1));
  EXPECT_EQ(boxes[1].min, second.min);
  EXPECT_EQ(boxes[1].max, second.max);
  EXPECT_TRUE(boxes[2].empty());
}

}  // namespace
}  // namespace standpoint
