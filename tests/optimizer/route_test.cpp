// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/route.h"

#include <cmath>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Eigen::Vector3d;

void addFloor(Mesh& mesh, double x0, double y0, double x1, double y1, double z) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const std::pair<double, double> corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  for (const auto& [x, y] : corners)
    mesh.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

std::vector<Vector3d> route(const Mesh& mesh, const Vector3d& from, const Vector3d& to) {
  Progress progress;
  auto way = WalkRoutes(mesh).between(from, to, progress);
  EXPECT_TRUE(way);
  return way ? *way : std::vector<Vector3d>();
}

double length(const std::vector<Vector3d>& way) {
  double sum = 0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += (way[i] - way[i - 1]).norm();
  return sum;
}

TEST(Route, OverAnEmptyFloorIsAStraightLine) {
  Mesh mesh;
  addFloor(mesh, 0, 0, 10, 6, 0);
  const auto way = route(mesh, {0.5, 0.5, 0}, {9, 5, 0});
  EXPECT_NEAR(length(way), std::hypot(8.5, 4.5), 0.1);
  for (std::size_t i = 1; i < way.size(); ++i) EXPECT_LE((way[i] - way[i - 1]).norm(), 0.15);
}

// Two rooms with a door of 0.4 m between them: the corner of the opening is what the way goes around.
TEST(Route, GoesThroughTheDoor) {
  Mesh mesh;
  addFloor(mesh, 0, 0, 4, 6, 0);
  addFloor(mesh, 4, 4, 4.2, 4.4, 0);
  addFloor(mesh, 4.2, 0, 8, 6, 0);
  const Vector3d from(3, 1, 0), to(6, 1, 0);
  const double around = std::hypot(1.0, 3.0) + 0.2 + std::hypot(1.8, 3.0);
  const auto way = route(mesh, from, to);
  EXPECT_NEAR(length(way), around, 0.15);
  for (const auto& p : way)
    if (p.x() > 4.03 && p.x() < 4.17) EXPECT_TRUE(p.y() > 3.97 && p.y() < 4.43) << p.transpose();
}

TEST(Route, ClimbsStairsAndStaysOnTheirSteps) {
  Mesh mesh;
  addFloor(mesh, 0, 0, 2, 2, 0);
  for (int i = 0; i < 15; ++i) addFloor(mesh, 2 + 0.28 * i, 0, 2.28 + 0.28 * i, 1, 0.18 * (i + 1));
  addFloor(mesh, 6.2, 0, 9, 2, 2.7);
  const auto way = route(mesh, {0.5, 0.5, 0}, {8, 1.5, 2.7});
  ASSERT_FALSE(way.empty());
  EXPECT_NEAR(way.back().z(), 2.7, 1e-3);
  for (std::size_t i = 1; i < way.size(); ++i) EXPECT_LE(std::abs(way[i].z() - way[i - 1].z()), 0.2);
}

TEST(Route, IsNoneWhereAStepIsTooHighOrNothingLeadsThere) {
  Mesh mesh;
  addFloor(mesh, 0, 0, 2, 2, 0);
  addFloor(mesh, 2, 0, 4, 2, 0.4);
  addFloor(mesh, 10, 0, 12, 2, 0);
  EXPECT_TRUE(route(mesh, {1, 1, 0}, {3, 1, 0.4}).empty());
  EXPECT_TRUE(route(mesh, {1, 1, 0}, {11, 1, 0}).empty());
  EXPECT_TRUE(route(mesh, {1, 1, 0}, {50, 1, 0}).empty());
  EXPECT_TRUE(route(Mesh(), {1, 1, 0}, {3, 1, 0}).empty());
}

TEST(Route, BeginsOnTheStoreyOfThePoint) {
  Mesh mesh;
  addFloor(mesh, 0, 0, 4, 4, 0);
  addFloor(mesh, 0, 0, 4, 4, 3);
  const WalkRoutes routes(mesh);
  EXPECT_NEAR(routes.nearest({2, 2, 2.8}).value().z(), 3, 1e-3);
  EXPECT_NEAR(routes.nearest({2, 2, 0.3}).value().z(), 0, 1e-3);
  EXPECT_FALSE(routes.nearest({2, 2, 1.5}));
  EXPECT_NEAR(routes.nearest({4.8, 2, 0}).value().x(), 4, 0.06);
  EXPECT_FALSE(routes.nearest({6, 2, 0}));
}

}  // namespace
}  // namespace standpoint
