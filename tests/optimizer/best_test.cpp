// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/engines/best.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "optimizer/optimizer.h"
#include "optimizer/simplify/engines/fitting.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;

OptimizeResult optimizedBy(const std::string& engine, const Environment& environment, std::uint64_t budget) {
  Progress progress;
  OptimizeOptions options;
  options.budget = budget;
  options.max_deviation_m = 100;
  options.engine = engine;
  auto result = optimize(environment, options, progress);
  EXPECT_TRUE(result) << describe(result.error());
  EXPECT_EQ(validate(result->environment), "");
  return std::move(*result);
}

Environment lonely(Mesh mesh) {
  Environment environment;
  models::add(environment, std::move(mesh));
  return environment;
}

Mesh wavy(const Mesh& smooth, float frequency) {
  Mesh mesh = smooth;
  for (auto& p : mesh.positions)
    p *=
        1 + 0.06F * std::sin(frequency * p.x()) * std::cos(frequency * p.y()) + 0.02F * std::cos(3 * frequency * p.z());
  return mesh;
}

TEST(BestEngine, IsOnEachMeshAtMostTheLeastMeanAndNearlyTheLeastMaximum) {
  for (const auto& mesh :
       {wavy(models::sphere(1, 50, 70), 7), wavy(models::torus(1, 0.4, 60, 40), 5), models::cylinder(0.5, 2, 48, 30)}) {
    const auto environment = lonely(mesh);
    const auto budget = mesh.triangles.size() / 15;
    double mean = std::numeric_limits<double>::infinity(), max = mean;
    for (const auto& engine : engines()) {
      const auto result = optimizedBy(std::string(engine.id), environment, budget);
      mean = std::min(mean, result.all.mean_deviation_m);
      max = std::min(max, result.all.max_deviation_m);
    }
    const auto best = optimizedBy("best", environment, budget);
    EXPECT_LE(best.all.triangles_after, budget);
    EXPECT_LE(best.all.mean_deviation_m, mean * 1.0001);
    EXPECT_LE(best.all.max_deviation_m, 1.05 * max);
  }
}

TEST(BestEngine, StatesWhatAnIndependentMeasureFinds) {
  const auto mesh = wavy(models::sphere(1, 24, 36), 6);
  const auto result = optimizedBy("best", lonely(mesh), 250);
  const auto& after = *result.environment.meshes[0];
  const double mean = 0.5 * (models::meanDistance(mesh, after, 2000) + models::meanDistance(after, mesh, 2000));
  EXPECT_NEAR(result.all.mean_deviation_m / mean, 1, 0.08);
  EXPECT_GE(result.all.max_deviation_m,
            0.999 * std::max(models::farthest(mesh, after, 2000), models::farthest(after, mesh, 2000)));
  EXPECT_NEAR(volume(after) / volume(mesh), 1, 0.005);
  EXPECT_TRUE(isClosed(after));
}

TEST(BestEngine, GivesTheSameForAnyNumberOfThreads) {
  const auto environment = lonely(wavy(models::sphere(1, 30, 40), 7));
  std::vector<Eigen::Vector3f> first;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto result = optimizedBy("best", environment, 200);
    const auto& positions = result.environment.meshes[0]->positions;
    if (first.empty()) first = positions;
    EXPECT_EQ(positions, first) << threads;
  }
}

TEST(BestEngine, CarriesPaintAndKeepsBordersBetweenSurfaces) {
  auto mesh = models::plateWithHole(4, 3, 1, 0.0625);
  for (auto& p : mesh.positions) {
    p.y() += 0.1F * std::sin(2 * p.x()) * std::cos(2 * p.z());
    mesh.texture_coordinates.emplace_back(p.x() / 4, p.z() / 3);
  }
  const auto result = optimizedBy("best", lonely(mesh), 300);
  const auto& after = *result.environment.meshes[0];
  ASSERT_EQ(after.texture_coordinates.size(), after.positions.size());
  for (std::size_t i = 0; i < after.positions.size(); ++i) {
    EXPECT_NEAR(after.texture_coordinates[i].x(), after.positions[i].x() / 4, 0.01);
    EXPECT_NEAR(after.texture_coordinates[i].y(), after.positions[i].z() / 3, 0.01);
  }
  for (std::size_t i = 0; i < after.triangles.size(); ++i)
    for (const auto v : after.triangles[i]) {
      if (after.surface_of_triangle[i] == 0)
        EXPECT_LT(after.positions[v].z(), 1.52F);
      else
        EXPECT_GT(after.positions[v].z(), 1.48F);
    }
}

TEST(EngineOption, OfAnUnknownNameIsRefusedWithThoseThatThereAre) {
  Progress progress;
  OptimizeOptions options;
  options.engine = "magic";
  const auto result = optimize(lonely(models::box({1, 1, 1}, 2)), options, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::usage);
  EXPECT_THAT(result.error().message, testing::AllOf(testing::HasSubstr("own"), testing::HasSubstr("openmesh")));
}

TEST(EngineOption, IsInTheReportOfEachProduct) {
  Environment environment;
  models::add(environment, wavy(models::sphere(1, 30, 40), 7), "IfcFurniture");
  models::add(environment, wavy(models::sphere(1, 30, 40), 5), "IfcFurniture", Affine3d(Translation3d(4, 0, 0)));
  for (const auto& engine : engines()) {
    const auto result = optimizedBy(std::string(engine.id), environment, 400);
    EXPECT_THAT(result.engines, testing::Each(std::string(engine.id)));
    EXPECT_TRUE(std::any_of(result.report.issues.begin(), result.report.issues.end(), [&](const Issue& issue) {
      return issue.source == "engine" && issue.message.find("#1, #2") != std::string::npos;
    }));
  }
  EXPECT_THAT(optimizedBy("auto", environment, 400).engines, testing::Each("own"));
}

TEST(EngineOption, FallsBackToOursWhereTheEngineRefusesAndSaysWhy) {
  Mesh mesh;  // three leaves at each edge of a tube
  for (std::uint32_t i = 0; i < 200; ++i) {
    mesh.positions.emplace_back(0, 0, 0.1F * static_cast<float>(i));
    for (int leaf = 0; leaf < 3; ++leaf)
      mesh.positions.emplace_back(std::cos(2.1F * static_cast<float>(leaf)), std::sin(2.1F * static_cast<float>(leaf)),
                                  0.1F * static_cast<float>(i));
    for (std::uint32_t leaf = 1; i > 0 && leaf < 4; ++leaf) {
      const auto now = 4 * i, before = now - 4;
      mesh.triangles.push_back({before, before + leaf, now + leaf});
      mesh.triangles.push_back({before, now + leaf, now});
    }
  }
  mesh.surface_of_triangle.assign(mesh.triangles.size(), 0);
  for (auto& p : mesh.positions) p.x() += 0.5F * std::sin(p.z());
  const auto result = optimizedBy("openmesh", lonely(mesh), 150);
  EXPECT_EQ(result.engines[0], "own");
  EXPECT_TRUE(std::any_of(result.report.issues.begin(), result.report.issues.end(), [](const Issue& issue) {
    return issue.source == "engine" && issue.message.find("own engine, as openmesh refused") != std::string::npos;
  }));
}

TEST(LargeShapesOfManyParts, AreThoseForWhichOursIsKnownToLose) {
  Mesh many;
  for (int i = 0; i < 80; ++i)
    models::append(many, models::sphere(0.4, 50, 70), Affine3d(Translation3d(i % 10, i / 10, 0)));
  const auto shape = weld(many);
  ASSERT_GT(shape.triangles.size(), 500'000);
  EXPECT_TRUE(isOwnKnownToLose(shape, 20'000));
  EXPECT_FALSE(isOwnKnownToLose(shape, 2'000));
  EXPECT_FALSE(isOwnKnownToLose(weld(models::sphere(1, 520, 520)), 20'000));
}

}  // namespace
}  // namespace standpoint
