// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "optimizer/optimizer.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;

OptimizeResult optimized(const Environment& environment, const OptimizeOptions& options) {
  Progress progress;
  auto result = optimize(environment, options, progress);
  EXPECT_TRUE(result) << describe(result.error());
  EXPECT_EQ(validate(result->environment), "");
  return std::move(*result);
}

// Two equal spheres of radius 1, side by side, and a bolt.
Environment spheres() {
  Environment environment;
  models::add(environment, models::sphere(1, 24, 48), "IfcColumn");
  models::add(environment, models::sphere(1, 24, 48), "IfcColumn", Affine3d(Translation3d(10, 0, 0)));
  models::add(environment, models::box({0.02, 0.02, 0.02}, 2), "IfcFastener", Affine3d(Translation3d(5, 0, 0)));
  return environment;
}

OptimizeOptions alike(const Environment& environment, std::uint64_t budget, double max_deviation_m) {
  OptimizeOptions options{budget, max_deviation_m, {}, {}};
  options.products.resize(environment.products.size());
  for (auto& allowance : options.products) allowance.max_deviation_m = max_deviation_m;
  return options;
}

TEST(Allowance, OfOneKindForAllIsTheSameAsNone) {
  const auto environment = spheres();
  const auto without = optimized(environment, {1000, 0.05, {}, {}});
  const auto with = optimized(environment, alike(environment, 1000, 0.05));
  EXPECT_EQ(with.all.triangles_after, without.all.triangles_after);
  for (std::size_t i = 0; i < without.environment.meshes.size(); ++i)
    EXPECT_EQ(with.environment.meshes[i]->triangles, without.environment.meshes[i]->triangles);
}

TEST(Allowance, KeepsWhatIsToStayAsItIs) {
  const auto environment = spheres();
  auto options = alike(environment, 3000, 0.2);
  options.products[0].keep = true;
  const auto result = optimized(environment, options);
  EXPECT_EQ(result.products[0].triangles_after, result.products[0].triangles_before);
  EXPECT_LT(result.products[0].max_deviation_m, 1e-9);
  EXPECT_LT(result.products[1].triangles_after, result.products[1].triangles_before);
}

TEST(Allowance, DropsByRuleAndSaysWhy) {
  const auto environment = spheres();
  auto options = alike(environment, 0, 0.05);
  options.products[2].drop = true;
  options.products[2].lod = "LoD 300";
  options.products[2].reason = "fasteners";
  const auto result = optimized(environment, options);
  EXPECT_EQ(result.products[2].triangles_after, 0U);
  EXPECT_NEAR(result.products[2].max_deviation_m, 0.01 * std::sqrt(3.0), 1e-6);  // the corner from the middle
  EXPECT_EQ(result.environment.instances.size(), 2U);
  EXPECT_EQ(result.all.triangles_before, triangleCount(environment));
  ASSERT_FALSE(result.report.issues.empty());
  EXPECT_THAT(result.report.issues.front().message, ::testing::HasSubstr("fasteners"));
  EXPECT_EQ(result.report.losses(), 1U);
}

TEST(Allowance, HoldsEachProductToItsOwnDeviation) {
  const auto environment = spheres();
  auto options = alike(environment, 300, 0.2);
  options.products[0].max_deviation_m = 0.01;
  const auto result = optimized(environment, options);
  EXPECT_LE(result.products[0].max_deviation_m, 0.01);
  EXPECT_GT(result.products[1].max_deviation_m, 0.01);
  EXPECT_LE(models::farthest(*environment.meshes[0], *result.environment.meshes[0], 2000), 0.0105);
}

TEST(Allowance, WithMoreWeightGetsMoreOfTheBudget) {
  const auto environment = spheres();
  auto options = alike(environment, 1000, 0.5);
  options.products[0].weight = 8;
  const auto result = optimized(environment, options);
  EXPECT_GT(result.products[0].triangles_after, result.products[1].triangles_after * 3 / 2);
}

TEST(Allowance, KeepsEachShareToItsOwnBudgetAndNamesTheLeastThatCanBeReached) {
  const auto environment = spheres();
  auto options = alike(environment, 500, 0.5);
  options.products[1].budget_group = 1;
  options.further_budgets = {200};
  const auto result = optimized(environment, options);
  EXPECT_LE(result.products[0].triangles_after + result.products[2].triangles_after, 500U);
  EXPECT_LE(result.products[1].triangles_after, 200U);
  EXPECT_TRUE(result.budget_reached);
  options.products[1].max_deviation_m = 0.002;
  options.products[1].lod = "LoD 200";
  const auto tight = optimized(environment, options);
  EXPECT_FALSE(tight.budget_reached);
  EXPECT_THAT(tight.report.issues.back().message, ::testing::HasSubstr("LoD 200: cannot reach 200 triangles"));
}

TEST(Allowance, OutOfRangeIsRefused) {
  const auto environment = spheres();
  Progress progress;
  auto options = alike(environment, 500, 0.5);
  options.products[1].budget_group = 1;
  EXPECT_FALSE(optimize(environment, options, progress));
  options = alike(environment, 500, 0.5);
  options.products[1].weight = 0;
  EXPECT_FALSE(optimize(environment, options, progress));
  options = alike(environment, 500, 0.5);
  options.products.pop_back();
  EXPECT_FALSE(optimize(environment, options, progress));
}

}  // namespace
}  // namespace standpoint
