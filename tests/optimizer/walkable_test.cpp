// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/walkable.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

Affine3d movedTo(double x, double y, double z) { return Affine3d(Translation3d(x, y, z)); }

Walkable walkableOf(const Environment& environment) {
  std::vector<CollisionShape> shapes;
  for (const auto& instance : environment.instances) {
    CollisionShape shape{CollisionShapeKind::convex, instance.product, {}};
    models::append(shape.mesh, *environment.meshes[instance.mesh], instance.world_from_mesh);
    shapes.push_back(std::move(shape));
  }
  Progress progress;
  auto result = walkableSurface(shapes, {}, {}, progress);
  EXPECT_TRUE(result);
  return std::move(*result);
}

std::size_t islands(const Walkable& walkable) {
  return std::set<std::uint32_t>(walkable.island_of_triangle.begin(), walkable.island_of_triangle.end()).size();
}

// Whatever its height over the lowest thing of the model, from which the grid's levels are counted.
TEST(Step, OfJustTheHeightThatIsClimbedIsClimbedAnywhere) {
  for (int i = 0; i < 40; ++i) {
    const double level = 0.0037 * i;
    for (const double step : {0.25, 0.27}) {
      Environment e;
      models::add(e, models::box({0.1, 0.1, 0.1}, 1), "", movedTo(20, 20, -1));
      models::add(e, models::box({3, 3, 0.2}, 1), "", movedTo(0, 0, level - 0.2));
      models::add(e, models::box({3, 3, 0.2}, 1), "", movedTo(3, 0, level - 0.2 + step));
      EXPECT_EQ(islands(walkableOf(e)), step < 0.26 ? 1 : 2) << level << " " << step;
    }
  }
}

// As many roofs are: which side of the limit rounding leaves it on is no answer.
TEST(Slope, OfJustFortyFiveDegreesIsWalkedWhereverItPoints) {
  for (int i = 0; i < 12; ++i) {
    for (const double degrees : {45.0, 46.0}) {
      Environment e;
      const Affine3d turn(Eigen::AngleAxisd(0.1 + 0.5 * i, Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(degrees * EIGEN_PI / 180, Vector3d::UnitX()));
      models::add(e, models::box({5, 5, 0.3}, 1), "", turn);
      EXPECT_EQ(walkableOf(e).area_m2 > 1, degrees < 45.5) << i << " " << degrees;
    }
  }
}

// A thing by mistake 10 km away must not make the grid so coarse that no room has a floor any more.
TEST(Walkability, IsFoundAsFinelyWhereSomethingIsFarAway) {
  Environment near, far;
  for (auto* e : {&near, &far}) models::add(*e, models::box({3, 3, 0.2}, 1), "");
  models::add(far, models::box({1, 1, 1}, 1), "", movedTo(10'000, -10'000, 3000));
  models::add(far, models::box({3, 0.2, 2}, 1), "", movedTo(0, -0.4, 0.1));  // beside it, and in the way
  models::add(near, models::box({3, 0.2, 2}, 1), "", movedTo(0, -0.4, 0.1));
  const auto a = walkableOf(near), b = walkableOf(far);
  EXPECT_EQ(a.cell_m, b.cell_m);
  EXPECT_EQ(a.area_m2, b.area_m2);
}

}  // namespace
}  // namespace standpoint
