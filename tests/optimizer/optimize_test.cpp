// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "optimizer/optimizer.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

OptimizeResult optimizedTo(const Environment& environment, std::uint64_t budget, double max_deviation_m = 0.015) {
  Progress progress;
  auto result = optimize(environment, {budget, max_deviation_m}, progress);
  EXPECT_TRUE(result) << describe(result.error());
  EXPECT_EQ(validate(result->environment), "");
  EXPECT_EQ(triangleCount(result->environment), result->all.triangles_after);
  EXPECT_EQ(result->products.size(), environment.products.size());
  return std::move(*result);
}

Environment only(Mesh mesh) {
  Environment environment;
  models::add(environment, std::move(mesh));
  return environment;
}

std::map<std::uint32_t, double> areaOfSurfaces(const Mesh& mesh) {
  std::map<std::uint32_t, double> areas;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    Mesh one;
    one.positions = mesh.positions;
    one.triangles = {mesh.triangles[i]};
    areas[mesh.surface_of_triangle[i]] += area(one);
  }
  return areas;
}

Mesh soup(int parts, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 20), size(0.05, 0.5);
  Mesh mesh;
  for (int i = 0; i < parts; ++i)
    models::append(mesh, models::box({size(random), size(random), size(random)}, 1),
                   Affine3d(Translation3d(place(random), place(random), place(random))));
  return mesh;
}

std::string bytes(const OptimizeResult& result) {
  std::string all;
  const auto put = [&](const void* data, std::size_t size) { all.append(static_cast<const char*>(data), size); };
  for (const auto& mesh : result.environment.meshes) {
    put(mesh->positions.data(), mesh->positions.size() * sizeof mesh->positions[0]);
    put(mesh->triangles.data(), mesh->triangles.size() * sizeof mesh->triangles[0]);
    put(mesh->surface_of_triangle.data(), mesh->surface_of_triangle.size() * sizeof mesh->surface_of_triangle[0]);
  }
  for (const auto& product : result.products) put(&product, sizeof product);
  for (const auto& issue : result.report.issues) all += issue.source + issue.message;
  return all;
}

// A little of everything: round, flat, thin, shared, many.
Environment mixture() {
  Environment environment;
  models::add(environment, models::sphere(1, 40, 60));
  models::add(environment, models::torus(2, 0.5, 60, 40), "", Affine3d(Translation3d(5, 0, 0)));
  models::add(environment, models::box({10, 0.2, 3}, 12), "", Affine3d(Translation3d(0, 5, 0)));
  models::add(environment, soup(300, 3));
  models::add(environment, models::cylinder(0.05, 3, 24, 10));
  for (int i = 0; i < 20; ++i) {
    environment.products.push_back({.id = "#9" + std::to_string(i)});
    environment.instances.push_back(
        {4, static_cast<std::uint32_t>(environment.products.size() - 1), Affine3d(Translation3d(i, 9, 0))});
  }
  return environment;
}

TEST(PlanarRegions, OfASubdividedBoxMergeToTwelveTriangles) {
  const auto before = models::box({7.3, 0.24, 2.9}, 15);
  const auto result = optimizedTo(only(before), 0);
  const auto& after = *result.environment.meshes[0];
  EXPECT_EQ(after.triangles.size(), 12);
  EXPECT_TRUE(isClosed(after));
  EXPECT_NEAR(volume(after) / volume(before), 1, 1e-6);
  EXPECT_NEAR(area(after) / area(before), 1, 1e-6);
  const auto a = bounds(before, Affine3d::Identity()), b = bounds(after, Affine3d::Identity());
  EXPECT_TRUE(a.min == b.min && a.max == b.max);
  EXPECT_LT(result.all.max_deviation_m, 1e-5);
}

TEST(PlanarRegions, KeepHolesAndTheBorderBetweenSurfaces) {
  const auto before = models::plateWithHole(4, 3, 1, 0.125);
  const auto after = *optimizedTo(only(before), 0).environment.meshes[0];
  EXPECT_EQ(after.triangles.size(), 12);  // each half has 8 corners on its rim
  const auto was = areaOfSurfaces(before), is = areaOfSurfaces(after);
  ASSERT_EQ(was.size(), is.size());
  for (const auto& [surface, square_metres] : was) EXPECT_NEAR(is.at(surface) / square_metres, 1, 1e-6);
}

TEST(PlanarRegions, OfACylinderLeaveTheRoundnessAlone) {
  const auto before = models::cylinder(0.5, 3, 48, 20);
  const auto after = *optimizedTo(only(before), 0).environment.meshes[0];
  EXPECT_EQ(after.triangles.size(), 2 * 48 + 2 * 46);
  EXPECT_NEAR(volume(after) / volume(before), 1, 1e-6);
  EXPECT_TRUE(isClosed(after));
}

TEST(PlanarRegions, StayWhatTheyAreFarFromTheOriginAndTurned) {
  Mesh before;
  models::append(before, models::box({5, 4, 3}, 10),
                 Translation3d(60, -40, 12) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()));
  const auto after = *optimizedTo(only(before), 0).environment.meshes[0];
  EXPECT_LE(after.triangles.size(), 40);
  EXPECT_NEAR(volume(after) / volume(before), 1, 1e-5);
  EXPECT_NEAR(area(after) / area(before), 1, 1e-5);
}

TEST(Surfaces, KeepTheirAreasWhenNothingIsLost) {
  const auto before = models::box({3, 4, 5}, 9, true);
  const auto after = *optimizedTo(only(before), 0).environment.meshes[0];
  EXPECT_EQ(after.triangles.size(), 12);
  for (const auto& [surface, square_metres] : areaOfSurfaces(before))
    EXPECT_NEAR(areaOfSurfaces(after)[surface] / square_metres, 1, 1e-6);
}

TEST(Budget, IsMetWithinOnePercentOnSpheresToriAndSoups) {
  for (const auto& environment :
       {only(models::sphere(1, 60, 90)), only(models::torus(2, 0.6, 90, 50)), only(soup(500, 1))})
    for (const double fraction : {0.5, 0.1, 0.02}) {
      const auto budget = static_cast<std::uint64_t>(fraction * static_cast<double>(triangleCount(environment)));
      const auto result = optimizedTo(environment, budget, 100);
      EXPECT_TRUE(result.budget_reached);
      EXPECT_LE(result.all.triangles_after, budget);
      EXPECT_GE(result.all.triangles_after, 0.99 * static_cast<double>(budget) - 1);
    }
}

TEST(Budget, IsSharedWhereItCostsLeast) {
  Environment environment;
  models::add(environment, models::box({2, 2, 2}, 20));  // flat: costs nothing
  models::add(environment, models::sphere(1, 30, 40), "", Affine3d(Translation3d(5, 0, 0)));
  const auto result = optimizedTo(environment, 12 + 2320, 0.5);
  EXPECT_EQ(result.products[0].triangles_after, 12);
  EXPECT_EQ(result.products[1].triangles_after, result.products[1].triangles_before);
}

TEST(Budget, OfThousandsOfTinyProductsDropsSomeAndSaysWhich) {
  Environment environment;
  for (int i = 0; i < 3000; ++i)
    models::add(environment, models::box({0.01 + 1e-5 * i, 0.02, 0.02}, 1), "IfcFastener",
                Affine3d(Translation3d(i % 50, i / 50, 0)));
  const auto result = optimizedTo(environment, 3000, 10);
  EXPECT_TRUE(result.budget_reached);
  EXPECT_LE(result.all.triangles_after, 3000);
  EXPECT_GE(result.all.triangles_after, 2700);
  std::size_t gone = 0;
  for (const auto& product : result.products)
    if (product.triangles_after == 0) {
      ++gone;
      EXPECT_GT(product.max_deviation_m, 0.014);  // half its diagonal
    }
  EXPECT_GT(gone, 0);
  EXPECT_EQ(result.report.losses(), gone);
  EXPECT_EQ(result.environment.instances.size(), environment.instances.size() - gone);
}

TEST(Budget, IsNotSavedByClosingADoorway) {
  Environment environment;
  Mesh wall;  // of three boxes: two piers and the lintel over a doorway of 0.9 x 2.1 m
  models::append(wall, models::box({2, 0.2, 2.8}, 1));
  models::append(wall, models::box({2, 0.2, 2.8}, 1), Affine3d(Translation3d(2.9, 0, 0)));
  models::append(wall, models::box({0.9, 0.2, 0.7}, 1), Affine3d(Translation3d(2, 0, 2.1)));
  models::add(environment, wall, "IfcWall");
  for (int i = 0; i < 40; ++i)
    models::add(environment, models::sphere(0.1, 12, 16), "IfcFurniture", Affine3d(Translation3d(0.5 * i, 5, 0)));
  const auto result = optimizedTo(environment, 350, 10);
  EXPECT_TRUE(result.budget_reached);
  ASSERT_GT(result.products[0].triangles_after, 0);
  const Vector3d middle(2.45, 0.1, 1);
  for (const auto& t : result.environment.meshes[0]->triangles) {
    Vector3d corner[3];
    for (int k = 0; k < 3; ++k) corner[k] = result.environment.meshes[0]->positions[t[k]].cast<double>();
    for (int k = 0; k < 1000; ++k) {  // no point of any triangle stands in the middle of the doorway
      const double u = (k % 32) / 31.0, v = (k / 32) / 31.0;
      if (u + v > 1) continue;
      EXPECT_GT((corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]) - middle).norm(), 0.2);
    }
  }
}

TEST(Deviation, StatedIsWhatExhaustiveSearchFinds) {
  for (const auto& before : {models::sphere(1, 20, 26), models::torus(1, 0.4, 30, 16)}) {
    const auto result = optimizedTo(only(before), before.triangles.size() / 6, 1);
    const auto& after = *result.environment.meshes[0];
    const double max_m = std::max(models::farthest(before, after, 20'000), models::farthest(after, before, 20'000));
    const double mean_m = 0.5 * (models::meanDistance(before, after, 2000) + models::meanDistance(after, before, 2000));
    EXPECT_GE(result.all.max_deviation_m, 0.96 * max_m);  // it does not search what can only be 4 % further
    EXPECT_LE(result.all.max_deviation_m, 1.15 * max_m);
    EXPECT_NEAR(result.all.mean_deviation_m / mean_m, 1, 0.05);
    EXPECT_LT(mean_m, 0.02);
  }
}

TEST(Deviation, NeverExceedsItsLimitAndTheSmallestBudgetCanBeReached) {
  const auto environment = mixture();
  const auto result = optimizedTo(environment, 400, 0.02);
  EXPECT_FALSE(result.budget_reached);
  EXPECT_EQ(result.smallest_budget, result.all.triangles_after);
  EXPECT_THAT(result.report.issues, testing::Contains(testing::Field(&Issue::source, "budget")));
  for (const auto& product : result.products) EXPECT_LE(product.max_deviation_m, 0.02);
  EXPECT_LT(result.all.triangles_after, result.all.triangles_before / 4);
  EXPECT_TRUE(optimizedTo(environment, result.smallest_budget, 0.02).budget_reached);
}

TEST(Deviation, CountsTheScaleOfTheInstance) {
  auto environment = only(models::sphere(1, 30, 40));
  environment.instances[0].world_from_mesh.linear() *= 10;
  EXPECT_LE(optimizedTo(environment, 100, 0.05).all.max_deviation_m, 0.05);
  EXPECT_GT(optimizedTo(environment, 100, 0.05).all.triangles_after,
            optimizedTo(only(models::sphere(1, 30, 40)), 100, 0.05).all.triangles_after);
}

TEST(Simplification, OfAClosedSurfaceStaysClosedAndInItsBounds) {
  for (const auto& before : {models::sphere(1, 40, 60), models::torus(1, 0.3, 50, 30), models::box({4, 0.1, 3}, 8)})
    for (const std::uint64_t budget : {600, 100, 8}) {
      const auto after = *optimizedTo(only(before), budget, 100).environment.meshes[0];
      EXPECT_TRUE(isClosed(after));
      const auto a = bounds(before, Affine3d::Identity()), b = bounds(after, Affine3d::Identity());
      EXPECT_TRUE((b.min.array() >= a.min.array() - 1e-5).all() && (b.max.array() <= a.max.array() + 1e-5).all());
    }
}

TEST(Simplification, GivesTheSameBytesForAnyNumberOfThreads) {
  const auto environment = mixture();
  std::string first;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto now = bytes(optimizedTo(environment, 3000, 0.1));
    if (first.empty()) first = now;
    EXPECT_TRUE(first == now) << threads << " threads";
  }
}

TEST(Simplification, OfAShapeThatIsCutIntoCellsGivesTheSameBytesForAnyNumberOfThreads) {
  const auto environment = only(models::torus(2, 0.5, 400, 150));  // 120 000 triangles
  std::string first;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto now = bytes(optimizedTo(environment, 3000, 0.1));
    if (first.empty()) first = now;
    EXPECT_TRUE(first == now) << threads << " threads";
  }
}

// So much is left that the refinement is done in cells, too.
TEST(Simplification, RefinedInCellsGivesTheSameBytesForAnyNumberOfThreads) {
  const auto environment = only(models::torus(2, 0.5, 400, 150));  // 120 000 triangles
  std::string first;
  for (const std::size_t threads : {1, 2, 8}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto result = optimizedTo(environment, 12'000, 0.1);
    EXPECT_LE(result.all.triangles_after, 12'000U);
    EXPECT_GE(result.all.triangles_after, 11'880U);
    EXPECT_TRUE(isClosed(*result.environment.meshes[0]));
    const auto now = bytes(result);
    if (first.empty()) first = now;
    EXPECT_TRUE(first == now) << threads << " threads";
  }
}

TEST(Simplification, SurvivesDegenerateInput) {
  Mesh bad = models::box({1, 1, 1}, 3);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    bad.triangles.push_back({a, b, c});
    bad.surface_of_triangle.push_back(0);
  };
  add(0, 0, 1);                               // no area, two corners alike
  add(0, 1, 2);                               // three points on a line
  bad.triangles.push_back(bad.triangles[5]);  // twice
  bad.surface_of_triangle.push_back(0);
  add(0, 1, 40);  // a third triangle on an edge
  add(40, 1, 0);  // and its back
  Environment environment;
  models::add(environment, bad);
  models::add(environment, Mesh{});
  Mesh one;
  one.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  one.surface_of_triangle = {0};
  models::add(environment, one);
  one.positions.assign(3, {5, 5, 5});
  models::add(environment, one);
  for (const std::uint64_t budget : {0, 1000, 40, 10, 1}) {
    const auto result = optimizedTo(environment, budget, 100);
    EXPECT_TRUE(result.budget_reached);
    if (budget == 0 || budget > 10) {  // else it may be what costs least
      EXPECT_EQ(result.products[2].triangles_after, 1);
    }
  }
  EXPECT_EQ(optimizedTo(Environment{}, 100).all.triangles_after, 0);
}

TEST(Simplification, OfAFanWithAHugeHubEndsSoon) {
  Mesh fan;
  fan.positions.emplace_back(0, 0, 0);
  const std::uint32_t n = 8000;
  for (std::uint32_t i = 0; i < n; ++i)
    fan.positions.emplace_back(std::cos(6.2831853 * i / n), std::sin(6.2831853 * i / n), 0.01 * std::cos(0.1 * i));
  for (std::uint32_t i = 0; i < n; ++i) {
    fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    fan.surface_of_triangle.push_back(0);
  }
  EXPECT_LE(optimizedTo(only(fan), 300, 10).all.triangles_after, 300);
}

TEST(Simplification, CanBeCancelled) {
  Progress progress;
  progress.cancel();
  const auto result = optimize(mixture(), {100, 1}, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::cancelled);
}

TEST(Simplification, RefusesNonsense) {
  Progress progress;
  EXPECT_EQ(optimize(mixture(), {100, -1}, progress).error().kind, ErrorKind::usage);
  auto broken = only(models::box({1, 1, 1}, 1));
  broken.instances[0].mesh = 7;
  EXPECT_EQ(optimize(broken, {100, 1}, progress).error().kind, ErrorKind::unusable);
}

Mesh looseTriangles(int count) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> place(0, 20), size(-0.05F, 0.05F);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f p(place(random), place(random), place(random));
    for (int k = 0; k < 3; ++k)
      mesh.positions.emplace_back(p + Eigen::Vector3f(size(random), size(random), size(random)));
    mesh.triangles.push_back({static_cast<std::uint32_t>(3 * i), static_cast<std::uint32_t>(3 * i + 1),
                              static_cast<std::uint32_t>(3 * i + 2)});
    mesh.surface_of_triangle.push_back(0);
  }
  return mesh;
}

TEST(BadInput, OfLooseTrianglesGoesToItsBudget) {
  const auto environment = only(looseTriangles(150'000));  // more than one queue takes at once
  for (const std::uint64_t budget : {100'000, 3000}) {
    const auto result = optimizedTo(environment, budget, 100);
    EXPECT_TRUE(result.budget_reached);
    EXPECT_LE(result.all.triangles_after, budget);
    EXPECT_GE(result.all.triangles_after, 0.99 * static_cast<double>(budget) - 1);
  }
}

TEST(BadInput, WithoutFiniteCoordinatesIsRefused) {
  auto mesh = models::box({1, 1, 1}, 2);
  mesh.positions[3].y() = std::numeric_limits<float>::quiet_NaN();
  Progress progress;
  const auto result = optimize(only(mesh), {10, 1, {}, {}}, progress);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().kind, ErrorKind::unusable);
}

TEST(BadInput, OfTurnedInsideOutAndRepeatedProductsIsAsGoodAsAny) {
  auto inside_out = models::sphere(1, 40, 60);
  for (auto& t : inside_out.triangles) std::swap(t[1], t[2]);
  Environment environment;
  models::add(environment, models::sphere(1, 40, 60));
  for (int i = 0; i < 3; ++i) models::add(environment, inside_out);  // all at the same place
  const auto result = optimizedTo(environment, 1200, 100);
  EXPECT_LE(result.all.triangles_after, 1200);
  EXPECT_GE(result.all.triangles_after, 1188);
  EXPECT_EQ(result.environment.meshes.size(), 2);  // the three are one
  EXPECT_LT(result.all.max_deviation_m, 0.05);
  for (const auto& instance : result.environment.instances) {
    const auto& mesh = *result.environment.meshes[instance.mesh];
    EXPECT_TRUE(isClosed(mesh));
    EXPECT_EQ(volume(mesh) < 0, instance.product > 0);
  }
}

TEST(BadInput, WithNothingInItIsNothing) {
  Environment environment;
  models::add(environment, Mesh{});
  models::add(environment, models::box({0, 0, 0}, 3));  // all at one point
  for (const std::uint64_t budget : {0, 1, 1000}) {
    const auto result = optimizedTo(environment, budget, 1);
    EXPECT_EQ(result.all.triangles_after, 0);
    EXPECT_TRUE(result.budget_reached);
  }
}

// Silhouettes, bounds and sides: nothing sticks out, nothing is turned over, nothing becomes a needle that was none.
TEST(Quality, OfSmoothAndSharpShapesHasNoFoldsNoNeedlesAndStaysInTheBox) {
  for (const auto& before :
       {models::sphere(1, 80, 120), models::torus(2, 0.5, 120, 60), models::cylinder(1, 3, 96, 40)}) {
    const auto result = optimizedTo(only(before), before.triangles.size() / 10, 100);
    const auto& after = *result.environment.meshes[0];
    EXPECT_TRUE(isClosed(after));
    EXPECT_NEAR(volume(after) / volume(before), 1, 0.01);
    EXPECT_LT(result.all.mean_turn_rad, 0.12);
    const auto was = bounds(before, Affine3d::Identity()), is = bounds(after, Affine3d::Identity());
    const double room = 0.01 * was.diagonal();
    EXPECT_TRUE((is.min.array() >= was.min.array() - room).all() && (is.max.array() <= was.max.array() + room).all());
    std::size_t folded = 0, needles = 0;
    for (const auto& t : after.triangles) {
      Vector3d corner[3];
      for (int k = 0; k < 3; ++k) corner[k] = after.positions[t[k]].cast<double>();
      const Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]),
                     middle = (corner[0] + corner[1] + corner[2]) / 3;
      // Outward is away from the axis of the torus' tube, and from the centre of the others.
      Vector3d core = Vector3d::Zero();
      if (before.triangles.size() == 14400) core = 2 * Vector3d(middle.x(), middle.y(), 0).normalized();
      if (before.triangles.size() == 7872) core = {0, 0, 1.5};
      folded += normal.dot(middle - core) <= 0 ? 1 : 0;
      double longest = 0;
      for (int k = 0; k < 3; ++k) longest = std::max(longest, (corner[k] - corner[(k + 1) % 3]).norm());
      needles += normal.norm() < 0.005 * longest * longest ? 1 : 0;
    }
    EXPECT_EQ(folded, 0);
    EXPECT_LE(needles, after.triangles.size() / 200) << before.triangles.size();
  }
}

TEST(Repetitions, AreSharedAndTheirProductsStayWhereTheyAre) {
  Environment environment;
  for (int i = 0; i < 12; ++i) {
    Mesh chair;  // written out in its own place each time
    models::append(chair, models::torus(0.5, 0.1, 40, 20),
                   Translation3d(2 * i, 0.3 * i, 0) * Eigen::AngleAxisd(0.5 * i, Vector3d(1, i, 2).normalized()));
    models::append(chair, models::box({0.3, 0.2, 0.9}, 3),
                   Translation3d(2 * i, 0.3 * i, 0) * Eigen::AngleAxisd(0.5 * i, Vector3d(1, i, 2).normalized()));
    models::add(environment, chair);
  }
  const auto same = optimizedTo(environment, 0);
  EXPECT_EQ(same.environment.meshes.size(), 1);
  EXPECT_LT(same.all.max_deviation_m, 1e-4);
  const auto result = optimizedTo(environment, 1200, 1);
  const auto was = productBounds(environment), is = productBounds(result.environment);
  for (std::size_t i = 0; i < was.size(); ++i)
    EXPECT_LT((was[i].min - is[i].min).norm() + (was[i].max - is[i].max).norm(), 0.05);
}

TEST(Optimize, LeavesSpacesAsTheyAreAndOutsideTheBudget) {
  Environment environment;
  models::add(environment, models::sphere(1, 24, 48), "IfcColumn");
  models::add(environment, models::sphere(3, 24, 48), "IfcSpace");
  environment.products[1].tangible = false;
  Progress progress;
  const auto result = optimize(environment, {400, 0.5, {}, {}}, progress);
  ASSERT_TRUE(result) << describe(result.error());
  EXPECT_EQ(result->all.triangles_before, environment.meshes[0]->triangles.size());
  EXPECT_LE(result->all.triangles_after, 400U);
  EXPECT_GE(result->all.triangles_after, 380U);
  ASSERT_EQ(result->environment.instances.size(), 2U);
  EXPECT_EQ(result->environment.meshes[1]->triangles, environment.meshes[1]->triangles);
}

}  // namespace
}  // namespace standpoint
