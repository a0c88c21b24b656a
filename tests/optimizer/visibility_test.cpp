// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/simplify/visibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;

Mesh slab(double x, double y, double z) { return models::box({x, y, z}, 1); }

// A closed room of six plates, a ball in it, a ball on its roof.
Environment house() {
  Environment e;
  models::add(e, slab(6, 6, 0.2), "IfcSlab");
  models::add(e, slab(6, 6, 0.2), "IfcRoof", Affine3d(Translation3d(0, 0, 3)));
  models::add(e, slab(6, 0.2, 3.2), "IfcWall");
  models::add(e, slab(6, 0.2, 3.2), "IfcWall", Affine3d(Translation3d(0, 5.8, 0)));
  models::add(e, slab(0.2, 6, 3.2), "IfcWall");
  models::add(e, slab(0.2, 6, 3.2), "IfcWall", Affine3d(Translation3d(5.8, 0, 0)));
  models::add(e, models::sphere(0.5, 10, 16), "IfcFurniture", Affine3d(Translation3d(3, 3, 1)));
  models::add(e, models::sphere(0.5, 10, 16), "IfcFurniture", Affine3d(Translation3d(3, 3, 4)));
  return e;
}

TEST(Visibility, OfTheSkyIsNoneInAClosedRoomAndMuchOnItsRoof) {
  const auto fractions = skyFractions(house(), Progress());
  EXPECT_EQ(fractions[6], 0);
  EXPECT_GT(fractions[7], 0.4);
  for (const int wall : {1, 2, 3, 4, 5}) EXPECT_GT(fractions[wall], 0.1);
}

TEST(Visibility, OfTheSkyIsHalfForAPlateWithBothSidesFree) {
  Environment e;  // its upper side sees all of it, its lower side none
  models::add(e, slab(4, 4, 0.001));
  EXPECT_NEAR(skyFractions(e, Progress())[0], 0.5, 0.05);
}

TEST(Visibility, FromTheFloorIsOfWhatIsInTheRoomOnly) {
  const auto e = house();
  Mesh floor;
  floor.positions = {{1, 1, 0.2F}, {5, 1, 0.2F}, {5, 5, 0.2F}, {1, 5, 0.2F}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  floor.surface_of_triangle = {0, 0};
  const auto view = walkersView(e, floor, Progress());
  EXPECT_GT(view[6], 1);
  EXPECT_EQ(view[7], 0);
  OptimizeOptions options{100, 0.1, {}, {}};
  weighByView(options, e, floor, Progress());
  ASSERT_EQ(options.products.size(), e.products.size());
  EXPECT_GT(options.products[6].weight, 9 * options.products[7].weight);
  for (const double v : walkersView(e, Mesh{}, Progress())) EXPECT_EQ(v, 1);
}

TEST(Visibility, OfFacesIsNoneWhereTwoBlocksTouch) {
  Environment e;  // so small that no ray runs 0.6 m in them
  models::add(e, slab(0.3, 0.3, 0.3));
  models::add(e, slab(0.3, 0.3, 0.3), "", Affine3d(Translation3d(0.3, 0, 0)));
  const auto hidden = hiddenTriangles(e, Progress());
  for (const int block : {0, 1}) {
    ASSERT_EQ(hidden[block].size(), 12);
    for (int i = 0; i < 12; ++i) {
      const auto& mesh = *e.meshes[block];
      const auto& t = mesh.triangles[i];
      const float x = block == 0 ? 0.3F : 0.0F;
      const bool touches =
          mesh.positions[t[0]].x() == x && mesh.positions[t[1]].x() == x && mesh.positions[t[2]].x() == x;
      EXPECT_EQ(hidden[block][i], touches);
    }
  }
  Progress progress;
  const auto result = optimize(e, {.hidden_faces = true}, progress);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->all.triangles_after, 20);
  EXPECT_THAT(result->report.issues, testing::Contains(testing::Field(&Issue::source, "hidden faces")));
}

TEST(Visibility, IsTheSameForAnyNumberOfThreads) {
  const auto e = house();
  std::vector<double> first;
  for (const std::size_t threads : {1, 2, 7}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const auto now = skyFractions(e, Progress());
    if (first.empty()) first = now;
    EXPECT_EQ(first, now);
  }
}

}  // namespace
}  // namespace standpoint
