// SPDX-License-Identifier: GPL-3.0-or-later
// Where the wrong points of a labelling are: how far a cloud reaches, where points are the densest, pictures of them.
#include "pointclouds/scores/error_view.h"

#include <random>

#include <gtest/gtest.h>

#include "pointclouds/scores/error_places.h"

namespace standpoint {
namespace {

TEST(PointSpread, LeavesOutTheFewPointsThatLieFarOff) {
  PointSpread spread;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in_room(0, 1);
  const Eigen::Vector3d corner(456780.25, 5429120.5, 110);  // of a national grid
  for (int i = 0; i < 100000; ++i)
    spread.add(corner + Eigen::Vector3d(8 * in_room(random), 6 * in_room(random), 3 * in_room(random)));
  for (int i = 0; i < 20; ++i) spread.add(corner + Eigen::Vector3d(-300, 900, 40.0 * i));
  const auto room = spread.without(0.001);
  EXPECT_LT((room.min - corner).cwiseAbs().maxCoeff(), 0.4);
  EXPECT_LT((room.max - corner - Eigen::Vector3d(8, 6, 3)).cwiseAbs().maxCoeff(), 0.4) << "a bin of 0.32 m";
  EXPECT_NEAR(spread.bounds().min.x(), corner.x() - 300, 0.01);
  const auto all = spread.without(0);
  EXPECT_LT((all.min - spread.bounds().min).cwiseAbs().maxCoeff(), 0.5) << "a bin";
  EXPECT_EQ(spread.points(), 100020U);
}

TEST(PointSpread, EndsWithAnyNumberThatIsOne) {
  PointSpread spread;
  for (const double far : {1e300, -1e300, 0.0, 1e-300}) spread.add(Eigen::Vector3d::Constant(far));
  const auto all = spread.without(0);
  EXPECT_EQ(all.min.x(), -1e300);
  EXPECT_EQ(all.max.x(), 1e300);
}

TEST(DensestPlace, IsInTheMiddleOfTheThickestCluster) {
  DensestPlace places;
  std::mt19937 random(6);
  std::normal_distribution<double> near(0, 0.1);
  std::uniform_real_distribution<double> anywhere(-20, 20);
  const Eigen::Vector3d thick(456790, 5429125, 111.5), thin(456800, 5429130, 111);
  for (int i = 0; i < 3000; ++i) {
    places.add(thick + Eigen::Vector3d(near(random), near(random), near(random)));
    if (i % 2 == 0) places.add(thin + Eigen::Vector3d(near(random), near(random), near(random)));
    places.add(thick + Eigen::Vector3d(anywhere(random), anywhere(random), anywhere(random)));
  }
  const auto place = places.place();
  ASSERT_TRUE(place);
  EXPECT_LT((place->at_m - thick).norm(), 0.05);
  EXPECT_NEAR(static_cast<double>(place->points), 3000, 30);
  EXPECT_FALSE(DensestPlace().place());
}

TEST(DensestPlace, StaysSmallInAWideCloud) {
  DensestPlace places;
  for (int x = 0; x < 400; ++x)
    for (int y = 0; y < 400; ++y) places.add({3.0 * x, 3.0 * y, 0});
  for (int k = 0; k < 100; ++k) places.add({600, 900, 1});
  const auto place = places.place();
  ASSERT_TRUE(place);
  EXPECT_GT(place->edge_m, 1.5) << "160 000 cubes of half a metre would be too many";
  EXPECT_LT((place->at_m - Eigen::Vector3d(600, 900, 1)).norm(), place->edge_m);
}

class ErrorViews : public ::testing::Test {
 protected:
  static Rgb pixel(const ErrorView& view, int x, int y) {
    const auto rgb = view.pixels();
    const auto at = static_cast<std::size_t>(y * view.width() + x) * 3;
    return {rgb[at], rgb[at + 1], rgb[at + 2]};
  }
  const Bounds box_{{10, 20, 0}, {14, 22, 3}};
  const Rgb red_{213, 94, 0}, blue_{0, 114, 178}, white_{255, 255, 255}, grey_{190, 190, 190};
};

TEST_F(ErrorViews, ShowsRightPointsInGreyAndWrongOnesInTheirColourWhereTheyAre) {
  ErrorView plan(ViewFrom::above, box_, 0.5, {red_, blue_});
  ASSERT_EQ(plan.width(), 8);
  ASSERT_EQ(plan.height(), 4);
  plan.addRight({10.1, 20.1, 1});
  plan.addWrong({13.9, 21.9, 2}, 0);
  plan.addWrong({13.9, 20.1, 2}, 1);
  plan.addWrong({9.9, 20.1, 2}, 1);
  plan.addRight({12, 21, 3.1});
  EXPECT_EQ(pixel(plan, 0, 3), grey_) << "lower left";
  EXPECT_EQ(pixel(plan, 7, 0), red_) << "upper right";
  EXPECT_EQ(pixel(plan, 7, 3), blue_) << "lower right";
  EXPECT_EQ(pixel(plan, 4, 1), white_) << "above the box: left out";
  ErrorView south(ViewFrom::south, box_, 0.5, {red_}), east(ViewFrom::east, box_, 0.5, {red_});
  south.addWrong({13.9, 20.1, 2.9}, 0);
  east.addWrong({13.9, 20.1, 2.9}, 0);
  EXPECT_EQ(pixel(south, 7, 0), red_) << "x to the right, z up";
  EXPECT_EQ(pixel(east, 0, 0), red_) << "y to the right, z up";
}

TEST_F(ErrorViews, IsTheStrongerTheMoreOfThePointsAreWrong) {
  ErrorView plan(ViewFrom::above, box_, 0.5, {red_, blue_});
  for (int k = 0; k < 30; ++k) plan.addRight({10.1, 20.1, 1}), plan.addRight({11.1, 20.1, 1});
  plan.addWrong({10.1, 20.1, 1}, 0);
  for (int k = 0; k < 30; ++k) plan.addWrong({11.1, 20.1, 1}, 0);
  plan.addWrong({11.1, 20.1, 1}, 1);
  const auto faint = pixel(plan, 0, 3), strong = pixel(plan, 2, 3);
  const auto redness = [](const Rgb& colour) { return colour[0] - colour[2]; };
  EXPECT_GT(redness(faint), 60) << "one of thirty is seen";
  EXPECT_GT(redness(strong), redness(faint) + 40);
  EXPECT_LT(redness(strong), redness(red_));
}

TEST_F(ErrorViews, HasNoMorePixelsThanItMay) {
  const ErrorView view(ViewFrom::above, {{0, 0, 0}, {1e6, 10, 1}}, 1e-3, {red_});
  EXPECT_LE(view.width(), ErrorView::kMostPixels);
  EXPECT_EQ(view.height(), 1);
}

}  // namespace
}  // namespace standpoint
