// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/vertex_deviation.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;

std::vector<std::shared_ptr<const InstanceDeviation>> deviations(const Environment& from, const Environment& to) {
  Progress progress;
  auto result = vertexDeviation(from, to, progress);
  EXPECT_TRUE(result);
  EXPECT_EQ(result->size(), from.instances.size());
  return *std::move(result);
}

TEST(VertexDeviation, OfConcentricSpheresIsTheDifferenceOfTheirRadii) {
  Environment small, large;
  models::add(small, models::sphere(1, 60, 120));
  models::add(large, models::sphere(1.25, 60, 120));
  const auto out = deviations(large, small)[0];
  ASSERT_EQ(out->distance_m.size(), large.meshes[0]->positions.size());
  for (const float d : out->distance_m) EXPECT_NEAR(d, 0.25, 0.0015);  // sagitta of 3° at a radius of 1 m
  EXPECT_NEAR(std::accumulate(out->area_m2.begin(), out->area_m2.end(), 0.0), area(*large.meshes[0]), 1e-3);
}

TEST(VertexDeviation, IsInMetresOfTheWorldAndCountsTheProductsOwnSurfacesOnly) {
  Environment before, after;
  models::add(before, models::box({1, 1, 1}, 1), "", Affine3d(Translation3d(5, 0, 0) * Eigen::Scaling(2.0)));
  models::add(before, models::box({9, 9, 9}, 1));
  after = before;
  Mesh shifted = *before.meshes[0];
  for (auto& p : shifted.positions) p.x() += 0.5F;
  after.meshes[0] = std::make_shared<const Mesh>(shifted);
  const auto moved = deviations(after, before);
  for (std::size_t i = 0; i < shifted.positions.size();
       ++i)  // the box from 5 to 7 m moved by 1 m: its far side stands off by 1 m
    EXPECT_NEAR(moved[0]->distance_m[i], shifted.positions[i].x() > 1 ? 1 : 0, 1e-5);
  EXPECT_NEAR(std::accumulate(moved[0]->area_m2.begin(), moved[0]->area_m2.end(), 0.0), 24, 1e-4);
  for (const float d : moved[1]->distance_m) EXPECT_EQ(d, 0);  // the same object at the same place
}

TEST(VertexDeviation, OfADroppedProductIsTheDistanceToWhatIsLeft) {
  Environment before;
  models::add(before, models::box({1, 1, 1}, 1));
  models::add(before, models::box({1, 1, 1}, 1), "", Affine3d(Translation3d(4, 0, 0)));
  Environment after = before;
  after.instances.pop_back();
  const auto lost = deviations(before, after);
  for (std::size_t i = 0; i < before.meshes[1]->positions.size(); ++i)
    EXPECT_NEAR(lost[1]->distance_m[i], 3 + before.meshes[1]->positions[i].x(), 1e-5);
  after.instances.clear();
  EXPECT_TRUE(std::isinf(deviations(before, after)[0]->distance_m[0]));
}

TEST(VertexDeviation, OfCopiesIsHeldOnce) {
  Environment before;
  models::add(before, models::sphere(1, 20, 30));
  before.products.push_back({.id = "#2"});
  before.instances.push_back(
      {0, 1, Affine3d(Translation3d(7, 1, 0) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()))});
  Environment after = before;
  after.meshes[0] = std::make_shared<const Mesh>(models::sphere(0.9, 20, 30));
  const auto both = deviations(before, after);
  EXPECT_EQ(both[0], both[1]);
  after.instances[1].world_from_mesh.translation().z() += 0.3;
  EXPECT_NE(deviations(before, after)[0], deviations(before, after)[1]);
}

TEST(VertexDeviation, IsTheSameForAnyNumberOfThreads) {
  Environment before, after;
  models::add(before, models::torus(2, 0.5, 90, 60));
  models::add(after, models::torus(2, 0.5, 13, 9));
  std::vector<float> first;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto now = deviations(before, after)[0]->distance_m;
    if (first.empty()) first = now;
    EXPECT_EQ(first, now);
  }
}

}  // namespace
}  // namespace standpoint
