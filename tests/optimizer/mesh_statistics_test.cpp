// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/mesh_statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;

Mesh tubeWithoutEnds(int around, int rows) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i < around; ++i)
      mesh.positions.emplace_back(std::cos(2 * M_PI * i / around), std::sin(2 * M_PI * i / around), j);
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(j * around + i % around); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < around; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
  return mesh;
}

TEST(MeshStatistics, OfClosedSolidsHaveNoHoles) {
  const auto box = statisticsOf(models::box({1, 2, 3}, 4));
  EXPECT_TRUE(box.isClosed());
  EXPECT_EQ(box.triangles, 6 * 16 * 2);
  EXPECT_EQ(box.vertices, 98);  // V - E + F = 2
  EXPECT_EQ(box.parts, 1);
  EXPECT_EQ(box.holes + box.border_edges + box.odd_edges + box.odd_vertices, 0);
  EXPECT_TRUE(statisticsOf(models::torus(2, 0.5, 12, 8)).isClosed());
}

TEST(MeshStatistics, CountPartsAndHoles) {
  auto mesh = tubeWithoutEnds(12, 3);
  auto statistics = statisticsOf(mesh);
  EXPECT_FALSE(statistics.isClosed());
  EXPECT_EQ(statistics.holes, 2);
  EXPECT_EQ(statistics.border_edges, 24);
  models::append(mesh, models::sphere(1, 8, 12), Affine3d(Translation3d(5, 0, 0)));
  models::append(mesh, models::plateWithHole(2, 2, 1, 0.25), Affine3d(Translation3d(0, 5, 0)));
  statistics = statisticsOf(mesh);
  EXPECT_EQ(statistics.parts, 3);
  EXPECT_EQ(statistics.holes, 4);  // the tube's two ends, the plate's rim and its hole
  EXPECT_EQ(statistics.border_edges, 24 + 4 * 8 + 4 * 4);
  EXPECT_EQ(statistics.odd_edges, 0);
}

TEST(MeshStatistics, CountEdgesOfThreeTrianglesAndThoseThatFaceTwoWays) {
  Mesh mesh = tubeWithoutEnds(8, 4);
  const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.emplace_back(3, 0, 1.5F);
  mesh.triangles.push_back({8, 16, tip});  // a fin on an edge inside the tube's wall
  mesh.surface_of_triangle.push_back(0);
  auto statistics = statisticsOf(mesh);
  EXPECT_EQ(statistics.odd_edges, 1);
  EXPECT_EQ(statistics.border_edges, 16 + 2);
  EXPECT_EQ(statistics.holes, 2);
  Mesh turned = models::box({1, 1, 1}, 3);
  std::swap(turned.triangles[4][0], turned.triangles[4][1]);
  statistics = statisticsOf(turned);
  EXPECT_EQ(statistics.odd_edges, 3);
  EXPECT_EQ(statistics.border_edges, 0);
  EXPECT_FALSE(statistics.isClosed());
}

TEST(MeshStatistics, CountVerticesWhereTwoSurfacesTouch) {
  Mesh mesh;
  models::append(mesh, models::box({1, 1, 1}, 1));
  models::append(mesh, models::box({1, 1, 1}, 1), Affine3d(Translation3d(1, 1, 1)));
  const auto statistics = statisticsOf(mesh);
  EXPECT_EQ(statistics.odd_vertices, 1);
  EXPECT_EQ(statistics.odd_edges, 0);
  EXPECT_EQ(statistics.parts, 1);
  EXPECT_TRUE(statistics.isClosed());
}

TEST(MeshStatistics, OfAProductAreTheSumOfItsInstances) {
  Environment environment;
  models::add(environment, models::box({1, 1, 1}, 2));
  environment.instances.push_back({0, 0, Affine3d(Translation3d(5, 0, 0))});
  models::add(environment, models::sphere(1, 6, 8));
  const auto statistics = statisticsOfProduct(environment, 0);
  EXPECT_EQ(statistics.parts, 2);
  EXPECT_EQ(statistics.triangles, 96);
  EXPECT_EQ(statisticsOf(Mesh()).parts, 0);
}

}  // namespace
}  // namespace standpoint
