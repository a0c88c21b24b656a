// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/walker.h"

#include <gtest/gtest.h>

#include "optimizer/walk/landing.h"
#include "tests/optimizer/models.h"

namespace standpoint {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr Body kBody{0.25, 1.70};

CollisionShape block(const Vector3d& low, const Vector3d& high) {
  CollisionShape shape{CollisionShapeKind::box, 0, {}};
  models::append(shape.mesh, models::box(high - low, 1), Eigen::Affine3d(Eigen::Translation3d(low)));
  return shape;
}

// A floor of 20 x 10 m, a stair up at x = 5 to a landing at 2.72 m, a wall along it and one across the landing.
std::vector<CollisionShape> stairwell() {
  std::vector<CollisionShape> shapes{block({-5, -5, -0.2}, {15, 5, 0}), block({4, 1, 0}, {13, 1.2, 5}),
                                     block({12, -5, 0}, {12.2, 5, 5})};
  for (int i = 0; i < 16; ++i) shapes.push_back(block({5 + 0.28 * i, -1, 0}, {5.28 + 0.28 * i, 1, 0.17 * (i + 1)}));
  shapes.push_back(block({5 + 0.28 * 16, -1, 0}, {13, 1, 2.72}));
  return shapes;
}

TEST(Walker, EndsInTheSamePlaceAtEveryFrameRate) {
  const Obstacles obstacles(stairwell());
  std::vector<Vector3d> ends;
  for (const double rate : {15.0, 30.0, 60.0, 144.0}) {
    Walker walker(obstacles, kBody, -0.2);
    ASSERT_TRUE(walker.stand({0, 0, 0.5}));
    for (int i = 0; i < 3 * rate; ++i) walker.go({Vector2d(1.8, 0.4)}, 1 / rate);  // along the wall, up the stair
    for (int i = 0; i < rate; ++i) walker.go({Vector2d(0, -1)}, 1 / rate);
    for (int i = 0; i < 2 * rate; ++i) walker.go({}, 1 / rate);
    ends.push_back(walker.feet());
  }
  EXPECT_GT(ends[0].z(), 0.1) << "on the stair";
  for (const auto& end : ends) EXPECT_LT((end - ends[2]).norm(), 0.05) << end.transpose();
}

TEST(Walker, GoesUpTheStairAndDownAgainAndIsStoppedByTheWall) {
  const Obstacles obstacles(stairwell());
  Walker walker(obstacles, kBody, -0.2);
  ASSERT_TRUE(walker.stand({0, 0, 0.5}));
  double jerk = 0, eyes = walker.eyes().z();
  for (int i = 0; i < 60 * 9; ++i) {
    walker.go({Vector2d(1.8, 0)}, 1.0 / 60);
    jerk = std::max(jerk, std::abs(walker.eyes().z() - eyes));
    eyes = walker.eyes().z();
  }
  EXPECT_NEAR((walker.feet() - Vector3d(11.75, 0, 2.72)).norm(), 0, 1e-2) << walker.feet().transpose();
  EXPECT_NEAR(walker.eyes().z() - walker.feet().z(), 1.6, 1e-3);
  EXPECT_LT(jerk, 0.09) << "a riser of 0.17 m is spread over more than one picture";
  for (int i = 0; i < 60 * 9; ++i) walker.go({Vector2d(-1.8, 0)}, 1.0 / 60);
  EXPECT_NEAR(walker.feet().z(), 0, 1e-5);
  EXPECT_LT(walker.feet().x(), 0);
}

TEST(Walker, DoesNotStumbleAlongAnUnevenWallOfAStair) {
  auto shapes = stairwell();
  shapes.push_back(block({4, 0.992, 2.3}, {13, 1.2, 5}));
  const Obstacles obstacles(shapes);
  Walker walker(obstacles, kBody, -0.2);
  ASSERT_TRUE(walker.stand({0, 0, 0.5}));
  for (int i = 0; i < 60 * 9; ++i) {
    walker.go({Vector2d(1.8, 0.3)}, 1.0 / 60);
    ASSERT_FALSE(walker.headroom()) << walker.feet().transpose();
  }
  EXPECT_NEAR(walker.feet().z(), 2.72, 1e-4);
}

// As near the newel of a winding stair, where the second tread ahead is under the shoulders.
TEST(Walker, GoesUpTreadsThatAreNarrowerThanItsBody) {
  std::vector<CollisionShape> shapes{block({-5, -5, -0.2}, {15, 5, 0})};
  for (int i = 0; i < 14; ++i) shapes.push_back(block({1 + 0.1 * i, -1, 0}, {8, 1, 0.177 * (i + 1)}));
  const Obstacles obstacles(shapes);
  for (const Vector2d way : {Vector2d(1.8, 0), Vector2d(1, 0.2), Vector2d(0.6, -0.1)}) {
    Walker walker(obstacles, kBody, -0.2);
    ASSERT_TRUE(walker.stand({0, 0, 0.5}));
    for (int i = 0; i < 60 * 4; ++i) walker.go({way}, 1.0 / 60);
    EXPECT_NEAR(walker.feet().z(), 14 * 0.177, 1e-3) << walker.feet().transpose();
    EXPECT_NEAR(walker.height(), kBody.height_m, 1e-6);
  }
}

TEST(Walker, IsStoppedByABenchAsByAnyThingThatIsNoStair) {
  for (const double high : {0.31, 0.36, 0.45, 0.59, 0.8}) {
    const Obstacles obstacles(std::vector{block({-5, -5, -0.2}, {15, 5, 0}), block({2, -1, 0}, {2.4, 1, high}),
                                          block({-1, 1.5, 0}, {5, 2, 3})});
    Walker walker(obstacles, kBody, -0.2);
    ASSERT_TRUE(walker.stand({0, 0, 0.5}));
    for (int i = 0; i < 60 * 3; ++i) walker.go({Vector2d(1.8, 0)}, 1.0 / 60);
    EXPECT_LT(walker.feet().x(), 2) << high;
    EXPECT_NEAR(walker.feet().z(), 0, 1e-5) << high;
  }
}

TEST(Walker, IsAtFullSpeedAfterATenthOfASecondAndStandsAsSoon) {
  const Obstacles obstacles(stairwell());
  Walker walker(obstacles, kBody, -0.2);
  ASSERT_TRUE(walker.stand({0, 0, 0.5}));
  walker.go({Vector2d(0, 1.8)}, 0.1);
  EXPECT_NEAR(walker.feet().y(), 0.5 * 1.8 * 0.1, 0.02);
  walker.go({Vector2d(0, 1.8)}, 0.1);
  const double at = walker.feet().y();
  walker.go({Vector2d(0, 1.8)}, 0.1);
  EXPECT_NEAR(walker.feet().y() - at, 0.18, 1e-3);
  walker.go({}, 0.15);
  const Vector3d stopped = walker.feet();
  walker.go({}, 0.2);
  EXPECT_EQ(walker.feet(), stopped);
  EXPECT_FALSE(walker.moves());
}

TEST(Walker, CrouchesUnderALowBeamAndSaysHowHighItIs) {
  for (const double beam : {1.5, 1.0}) {
    const Obstacles obstacles(std::vector{block({-5, -5, -0.2}, {15, 5, 0}), block({2, -5, beam}, {2.5, 5, 3})});
    Walker walker(obstacles, kBody, -0.2);
    ASSERT_TRUE(walker.stand({0, 0, 0.5}));
    std::optional<double> headroom;
    double lowest = 2;
    for (int i = 0; i < 60 * 3; ++i) {
      walker.go({Vector2d(1.8, 0)}, 1.0 / 60);
      if (walker.headroom()) headroom = std::min(headroom.value_or(9), *walker.headroom());
      lowest = std::min(lowest, walker.height());
    }
    ASSERT_TRUE(headroom) << beam;
    EXPECT_NEAR(*headroom, beam, 1e-3);
    EXPECT_EQ(walker.feet().x() > 2.8, beam > 1.2);
    if (beam > 1.2) {
      EXPECT_LT(lowest, 1.5);
      EXPECT_NEAR(walker.height(), 1.7, 1e-9) << "it rises behind the beam";
    }
  }
}

TEST(Walker, FallsOverAnEdgeAndComesBackFromTheVoid) {
  const Obstacles obstacles(std::vector{block({-5, -5, 2.8}, {0, 5, 3}), block({-5, -5, -0.2}, {3, 5, 0})});
  Walker walker(obstacles, kBody, -0.2);
  ASSERT_TRUE(walker.stand({-1, 0, 3.5}));
  for (int i = 0; i < 90; ++i) walker.go({Vector2d(1.8, 0)}, 1.0 / 60);
  for (int i = 0; i < 60; ++i) walker.go({}, 1.0 / 60);
  EXPECT_NEAR(walker.feet().z(), 0, 1e-5) << "on the floor below";
  EXPECT_FALSE(walker.wasBroughtBack());
  bool brought_back = false;
  for (int i = 0; i < 60 * 4 && !brought_back; ++i) {
    walker.go({Vector2d(1.8, 0)}, 1.0 / 60);
    brought_back = walker.wasBroughtBack();
  }
  EXPECT_TRUE(brought_back);
  EXPECT_NEAR(walker.feet().z(), 0, 1e-5);
  EXPECT_LT(walker.feet().x(), 3.13);
}

TEST(Walker, CrossesGapsOfAFootsWidth) {
  const Obstacles obstacles(std::vector{block({-5, -5, -0.2}, {0, 5, 0}), block({0.15, -5, -0.2}, {5, 5, 0}),
                                        block({-5, -5, -9}, {5, 5, -3})});
  Walker walker(obstacles, kBody, -9);
  ASSERT_TRUE(walker.stand({-1, 0, 0.5}));
  for (int i = 0; i < 90; ++i) {
    walker.go({Vector2d(1.8, 0)}, 1.0 / 60);
    ASSERT_NEAR(walker.feet().z(), 0, 1e-4) << walker.feet().x();
  }
  EXPECT_GT(walker.feet().x(), 1);
}

TEST(Landing, SaysWhyNobodyCanStandThere) {
  const Obstacles obstacles(std::vector{block({-5, -5, -0.2}, {5, 5, 0}), block({3, -5, 0}, {3.2, 5, 3}),
                                        block({-5, -5, 1.1}, {-3, 5, 1.2}), block({-1, 3, 0}, {0, 3.2, 3}),
                                        block({-1, 3.6, 0}, {0, 3.8, 3})});
  const Vector3d up(0, 0, 1);
  EXPECT_EQ(landingAt(obstacles, kBody, {0, 0, 0}, up).why_not, "");
  EXPECT_EQ(landingAt(obstacles, kBody, {0, 0, 0}, Vector3d(0.78801, 0, 0.61566)).why_not,
            "too steep: 52°, at most 45°");
  EXPECT_EQ(landingAt(obstacles, kBody, {-4, 0, 0}, up).why_not, "no headroom: 1.10 m, at least 1.20 m");
  EXPECT_EQ(landingAt(obstacles, kBody, {9, 0, 0}, up).why_not, "no floor here");
  EXPECT_EQ(landingAt(obstacles, kBody, {-0.5, 3.4, 0}, up).why_not, "too narrow: somebody is 0.50 m wide");
  const auto beside = landingAt(obstacles, kBody, {2.9, 0, 0}, up);
  EXPECT_EQ(beside.why_not, "");
  EXPECT_NEAR(beside.feet.x(), 3 - 0.25, 2e-3) << "away from the wall";
}

}  // namespace
}  // namespace standpoint
