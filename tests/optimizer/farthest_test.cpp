// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/farthest.h"

#include <cmath>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Eigen::Vector3d;

// A square of 4 m in n x n cells, each cut along one diagonal, the vertex in the middle raised.
Shape square(int n, double raised = 0) {
  Shape shape;
  shape.half_size = {2, 2, raised};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      shape.positions.emplace_back(4.0 * i / n - 2, 4.0 * j / n - 2, 2 * i == n && 2 * j == n ? raised : 0);
  for (std::uint32_t j = 0, row = static_cast<std::uint32_t>(n) + 1; j + 1 < row; ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const auto a = j * row + i;
      shape.triangles.push_back({a, a + 1, a + row + 1});
      shape.triangles.push_back({a, a + row + 1, a + row});
    }
  shape.surface_of_triangle.assign(shape.triangles.size(), 0);
  return shape;
}

struct Pair {
  Shape from, to;
  TriangleTree tree{to.positions, to.triangles};
  std::vector<std::uint32_t> counterpart;
  OneWaySurfaces way{from, to, tree, counterpart};
};

TEST(Farthest, IsNothingBetweenTwoTilingsOfOnePlane) {
  const Pair pair{square(7), square(10)};
  EXPECT_LT(std::sqrt(farthestSquared(pair.way, 0)), 1e-12);
  EXPECT_FALSE(isAnyFurther(pair.way, 1e-20));
}

TEST(Farthest, FindsTheTipThatNoSampleHits) {
  const Pair pair{square(40, 0.3), square(3)};
  const double found = std::sqrt(farthestSquared(pair.way, 0));
  EXPECT_LE(found, 0.3 + 1e-12);
  EXPECT_GE(found, 0.3 / 1.04);
  EXPECT_TRUE(isAnyFurther(pair.way, 0.299 * 0.299));
  EXPECT_FALSE(isAnyFurther(pair.way, 0.301 * 0.301));
}

// 0.6 m wide about x 0.8, y -0.4.
Shape squareWithHole() {
  Shape holed = square(40);
  std::erase_if(holed.triangles, [&](const Triangle& t) {
    const Vector3d middle = (holed.positions[t[0]] + holed.positions[t[1]] + holed.positions[t[2]]) / 3;
    return std::abs(middle.x() - 0.8) < 0.3 && std::abs(middle.y() + 0.4) < 0.5;
  });
  holed.surface_of_triangle.resize(holed.triangles.size());
  return holed;
}

// A large triangle over a surface with a hole: the middle of the hole, which no vertex is near to.
TEST(Farthest, FindsTheMiddleOfAHole) {
  const Pair pair{square(1), squareWithHole()};
  const double found = std::sqrt(farthestSquared(pair.way, 0));
  EXPECT_LE(found, 0.3 + 1e-12);
  EXPECT_GE(found, 0.3 / 1.04);
  EXPECT_TRUE(isAnyFurther(pair.way, 0.29 * 0.29));
  EXPECT_FALSE(isAnyFurther(pair.way, 0.301 * 0.301));
}

TEST(Farthest, NamesThePlaceInEachTriangleThatIsFar) {
  const Pair pair{square(1), squareWithHole()};
  const auto places = placesFurther(pair.way, 0.25 * 0.25);
  ASSERT_EQ(places.size(), 1U);  // the hole is below one of the two triangles
  EXPECT_NEAR(places[0].position.x(), 0.8, 0.05);
  EXPECT_EQ(places[0].position.z(), 0);
  EXPECT_GE(pair.tree.squaredDistance(places[0].position), 0.25 * 0.25);
  EXPECT_TRUE(placesFurther(pair.way, 0.301 * 0.301).empty());
}

TEST(Weld, TakesBothZerosAndTurnedTrianglesForTheSame) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0F, 0, -0.0F}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 1, 0}, {0, 3, 1}, {3, 1, 4}, {0, 1, 2}};
  mesh.surface_of_triangle = {0, 0, 0, 0, 0, 1};
  WeldCounts counts;
  const Shape shape = weld(mesh, &counts);
  EXPECT_EQ(shape.positions.size(), 4U);
  EXPECT_EQ(shape.triangles.size(), 4U);  // the first, its back, the upright one, and the first of another surface
  EXPECT_EQ(counts.positions, 1U);
  EXPECT_EQ(counts.degenerate, 1U);
  EXPECT_EQ(counts.repeated, 1U);
}

}  // namespace
}  // namespace standpoint
