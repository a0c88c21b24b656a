// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/preview.h"

#include <gtest/gtest.h>

#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using models::add;

std::shared_ptr<const Environment> shelf() {
  auto e = std::make_shared<Environment>();
  e->surfaces.resize(1);
  add(*e, models::sphere(0.5, 8, 12), "IfcFurniture");
  add(*e, models::box({4, 0.3, 3}, 6), "IfcWall", Eigen::Affine3d(Eigen::Translation3d(2, 0, 0)));
  add(*e, models::cylinder(0.1, 3, 16, 8), "IfcColumn", Eigen::Affine3d(Eigen::Translation3d(-2, 0, 0)));
  return e;
}

OptimizeOptions within(double max_deviation_m) {
  OptimizeOptions options;
  options.max_deviation_m = max_deviation_m;
  return options;
}

std::unique_ptr<OptimizePreview> prepared(const std::shared_ptr<const Environment>& e, const OptimizeOptions& options) {
  Progress progress;
  auto preview = OptimizePreview::prepare(e, options, progress);
  EXPECT_TRUE(preview) << describe(preview.error());
  return std::move(*preview);
}

TEST(OptimizePreview, HasAsManyTrianglesAsTheOptimizedModelAtEveryBudget) {
  const auto e = shelf();
  const auto preview = prepared(e, within(0.05));
  EXPECT_EQ(preview->most(), triangleCount(*e));
  for (const std::uint64_t budget : {600U, 300U, 150U, 400U, 90U}) {  // up and down, as a slider goes
    auto options = within(0.05);
    options.budget = budget;
    Progress progress;
    const auto done = optimize(*e, options, progress);
    ASSERT_TRUE(done);
    const auto shown = preview->at(budget);
    EXPECT_EQ(validate(*shown), "");
    EXPECT_EQ(triangleCount(*shown), done->all.triangles_after) << budget;
  }
}

TEST(OptimizePreview, NamesTheLeastThatTheLimitsAllow) {
  const auto preview = prepared(shelf(), within(0.001));
  EXPECT_EQ(triangleCount(*preview->at(1)), preview->least());
  EXPECT_GT(preview->least(), 12U);
  EXPECT_LT(preview->least(), preview->most());
}

TEST(OptimizePreview, LeavesWhatIsKeptAndLeavesOutWhatIsExcluded) {
  auto e = std::make_shared<Environment>(*shelf());
  e->products[2].excluded = true;
  auto options = within(1);
  options.products.assign(3, {});
  for (auto& a : options.products) a.max_deviation_m = 1;
  options.products[0].keep = true;
  const auto ball = e->meshes[0]->triangles.size();
  const auto shown = prepared(e, options)->at(ball + 12);
  std::vector<std::size_t> triangles(3, 0);
  for (const auto& i : shown->instances) triangles[i.product] += shown->meshes[i.mesh]->triangles.size();
  EXPECT_EQ(triangles, (std::vector<std::size_t>{ball, 12, 0}));
}

TEST(OptimizePreview, RefusesWhatOptimizeRefusesAndStopsWhenCancelled) {
  Progress progress;
  EXPECT_FALSE(OptimizePreview::prepare(shelf(), within(-1), progress));
  progress.cancel();
  EXPECT_FALSE(OptimizePreview::prepare(shelf(), within(1), progress));
}

}  // namespace
}  // namespace standpoint
