// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/surface/scene_deviation.h"

#include <limits>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

constexpr std::uint32_t kInstances = 300;
constexpr double kLifted_m = 0.010;

// Nine squares of 1 m² with a metre between them, the first lifted.
std::shared_ptr<const Mesh> squares(double lift_m) {
  auto mesh = std::make_shared<Mesh>();
  for (std::uint32_t i = 0; i < 9; ++i) {
    const auto z = static_cast<float>(i == 0 ? lift_m : 0);
    const auto x = static_cast<float>(2 * i);
    for (const auto& [u, v] : {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}})
      mesh->positions.emplace_back(x + u, v, z);
    mesh->triangles.push_back({4 * i, 4 * i + 1, 4 * i + 2});
    mesh->triangles.push_back({4 * i, 4 * i + 2, 4 * i + 3});
  }
  mesh->surface_of_triangle.assign(18, 0);
  return mesh;
}

Environment many(const std::shared_ptr<const Mesh>& mesh) {
  Environment e;
  e.surfaces.resize(1);
  e.meshes = {mesh};
  e.products.resize(kInstances);
  for (std::uint32_t i = 0; i < kInstances; ++i)
    e.instances.push_back({0, i, Eigen::Affine3d(Eigen::Translation3d(0, 3.0 * i, 0))});
  return e;
}

// With two points on each, a fixed start would look at the third and the seventh square of all, where nothing moved.
TEST(SceneDeviation, OfManyEqualInstancesIsTheirMeanThoughEachGetsFewPoints) {
  const auto before = many(squares(0)), after = many(squares(kLifted_m));
  const std::vector<double> unknown(kInstances, std::numeric_limits<double>::infinity());
  const Progress progress;
  const auto deviation = sceneDeviation(before, after, 2 * kInstances, {{}, unknown, unknown}, progress);
  EXPECT_NEAR(deviation.mean_m / (kLifted_m / 9), 1, 0.04);
  EXPECT_NEAR(deviation.max_m, kLifted_m, 1e-6);
}

}  // namespace
}  // namespace standpoint
