// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optimizer/optimizer.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

Mesh optimizedMesh(Mesh mesh, std::uint64_t budget, double max_deviation_m = 100) {
  Environment environment;
  models::add(environment, std::move(mesh));
  Progress progress;
  const auto result = optimize(environment, {budget, max_deviation_m, {}, {}}, progress);
  EXPECT_TRUE(result);
  EXPECT_EQ(validate(result->environment), "");
  EXPECT_EQ(result->report.losses(), 0);
  return *result->environment.meshes[0];
}

// Two charts on one flat plate of 2 x 1 m, which meet at x = 1: there every position stands twice.
Mesh plateOfTwoCharts(int cells) {
  Mesh mesh;
  for (const int chart : {0, 1}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= cells; ++j)
      for (int i = 0; i <= cells; ++i) {
        const float x = static_cast<float>(chart) + static_cast<float>(i) / static_cast<float>(cells),
                    y = static_cast<float>(j) / static_cast<float>(cells);
        mesh.positions.emplace_back(x, y, 0);
        mesh.texture_coordinates.push_back(chart == 0 ? Vector2f(0.3F * x, 0.4F * y)
                                                      : Vector2f(0.9F - 0.2F * y, 0.5F * x));
        mesh.colours.push_back(
            {static_cast<std::uint8_t>(std::lround(100 * x)), static_cast<std::uint8_t>(std::lround(200 * y)), 7, 255});
      }
    const auto index = [&](int i, int j) { return first + static_cast<std::uint32_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j)
      for (int i = 0; i < cells; ++i)
        for (const Triangle& t : {Triangle{index(i, j), index(i + 1, j), index(i + 1, j + 1)},
                                  Triangle{index(i, j), index(i + 1, j + 1), index(i, j + 1)}}) {
          mesh.triangles.push_back(t);
          mesh.surface_of_triangle.push_back(0);
        }
  }
  return mesh;
}

TEST(Paint, OfAFlatPlateWithASeamIsExactOnBothSidesOfIt) {
  const auto after = optimizedMesh(plateOfTwoCharts(20), 0);
  EXPECT_EQ(after.triangles.size(), 4);
  ASSERT_EQ(after.texture_coordinates.size(), after.positions.size());
  ASSERT_EQ(after.colours.size(), after.positions.size());
  for (const auto& t : after.triangles) {
    const Vector3f middle = (after.positions[t[0]] + after.positions[t[1]] + after.positions[t[2]]) / 3;
    for (const auto v : t) {
      const auto& p = after.positions[v];
      const Vector2f expected =
          middle.x() < 1 ? Vector2f(0.3F * p.x(), 0.4F * p.y()) : Vector2f(0.9F - 0.2F * p.y(), 0.5F * p.x());
      EXPECT_LT((after.texture_coordinates[v] - expected).norm(), 1e-5);
      EXPECT_NEAR(after.colours[v][0], 100 * p.x(), 1);
      EXPECT_NEAR(after.colours[v][1], 200 * p.y(), 1);
    }
  }
}

// A globe with a map on it: u along the equator, v from pole to pole; the meridian 0 is a seam.
Mesh globe(int rings, int segments) {
  Mesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j <= segments; ++j) {
      const double polar = std::numbers::pi * i / rings, turn = j == segments ? 0 : 2 * std::numbers::pi * j / segments;
      const double r = i == 0 || i == rings ? 0 : std::sin(polar);
      mesh.positions.emplace_back(static_cast<float>(r * std::cos(turn)), static_cast<float>(r * std::sin(turn)),
                                  static_cast<float>(std::cos(polar)));
      mesh.texture_coordinates.emplace_back(static_cast<float>(j) / static_cast<float>(segments),
                                            static_cast<float>(i) / static_cast<float>(rings));
    }
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>(i * (segments + 1) + j); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < segments; ++j)
      for (const Triangle& t : {Triangle{index(i, j), index(i + 1, j), index(i + 1, j + 1)},
                                Triangle{index(i, j), index(i + 1, j + 1), index(i, j + 1)}}) {
        if (mesh.positions[t[0]] == mesh.positions[t[1]] || mesh.positions[t[1]] == mesh.positions[t[2]] ||
            mesh.positions[t[2]] == mesh.positions[t[0]])
          continue;
        mesh.triangles.push_back(t);
        mesh.surface_of_triangle.push_back(0);
      }
  return mesh;
}

TEST(Paint, OfAGlobeStaysWhereTheMapSaysAndIsNotTornAtItsSeam) {
  const auto before = globe(60, 120);
  const auto after = optimizedMesh(before, before.triangles.size() / 12);
  ASSERT_EQ(after.texture_coordinates.size(), after.positions.size());
  EXPECT_LE(after.triangles.size(), before.triangles.size() / 12);
  EXPECT_GE(after.triangles.size(), 0.98 * static_cast<double>(before.triangles.size()) / 12);
  EXPECT_TRUE(isClosed(after));  // the two sides of the seam are still at the same places
  for (const auto& t : after.triangles) {
    float low = 1, high = 0;
    for (const auto v : t) {
      const Eigen::Vector3d p = after.positions[v].cast<double>().normalized();
      EXPECT_NEAR(after.texture_coordinates[v].y(), std::acos(p.z()) / std::numbers::pi, 0.02);
      if (std::abs(p.z()) > 0.9) continue;  // near the poles u means little
      double u = std::atan2(p.y(), p.x()) / (2 * std::numbers::pi);
      u -= std::floor(u);
      const double off = std::abs(after.texture_coordinates[v].x() - u);
      EXPECT_LT(std::min(off, 1 - off), 0.02);
      low = std::min(low, after.texture_coordinates[v].x());
      high = std::max(high, after.texture_coordinates[v].x());
    }
    EXPECT_LT(high - low, 0.3);  // a triangle across the seam would have the whole map on it
  }
}

TEST(Paint, OfABoxWithSixChartsAndSurfacesKeepsEachFaceItsOwn) {
  Mesh before = models::box({2, 1, 3}, 9, true);
  for (std::size_t i = 0; i < before.positions.size(); ++i) before.texture_coordinates.emplace_back(0.1F, 0.1F);
  for (std::size_t i = 0; i < before.triangles.size(); ++i)
    for (const auto v : before.triangles[i])
      before.texture_coordinates[v] = {
          static_cast<float>(before.surface_of_triangle[i]) + 0.1F * before.positions[v].x(),
          before.positions[v].y() + before.positions[v].z()};
  const auto after = optimizedMesh(before, 0);
  EXPECT_EQ(after.triangles.size(), 12);
  for (std::size_t i = 0; i < after.triangles.size(); ++i)
    for (const auto v : after.triangles[i]) {
      EXPECT_NEAR(after.texture_coordinates[v].x(),
                  static_cast<float>(after.surface_of_triangle[i]) + 0.1F * after.positions[v].x(), 1e-5);
      EXPECT_NEAR(after.texture_coordinates[v].y(), after.positions[v].y() + after.positions[v].z(), 1e-5);
    }
}

}  // namespace
}  // namespace standpoint
