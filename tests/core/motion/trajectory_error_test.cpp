// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/trajectory_error.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "core/motion/closures.h"
#include "core/motion/degeneracy.h"
#include "core/motion/gait.h"
#include "core/motion/rotation_vector.h"
#include "core/motion/walked_path.h"

namespace standpoint {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kDrawn = 500;

ErrorProfile drifting(double drift_mm, double heading_deg = 0) {
  ErrorProfile profile;
  profile.drift_m_sqrt_m = drift_mm / 1000;
  profile.heading_rad_sqrt_m = heading_deg * kRadPerDeg;
  return profile;
}

const ErrorProfile& profile(std::string_view id) {
  for (const auto& one : kErrorProfiles)
    if (one.id == id) return one;
  throw std::runtime_error("no such profile");
}

std::shared_ptr<const PoseSpline> walk(const std::vector<Vector3d>& places) {
  std::vector<Waypoint> waypoints;
  for (const auto& place : places) waypoints.push_back({place, 0, {}});
  auto path = walkPath(waypoints);
  EXPECT_TRUE(path);
  return std::make_shared<PoseSpline>(path->poses);
}

std::shared_ptr<const PoseSpline> straight(double metres) { return walk({{0, 0, 0}, {metres, 0, 0}}); }
std::shared_ptr<const PoseSpline> square(double around) {
  const double side = around / 4;
  return walk({{0, 0, 0}, {side, 0, 0}, {side, side, 0}, {0, side, 0}, {0, 0, 0}});
}

std::vector<KnotError> errorsOf(std::span<const ErrorKnot> knots, const ErrorProfile& p,
                                const std::vector<MotionConstraint>& constraints, int seed) {
  Progress progress;
  const auto solved = solveTrajectory(std::make_shared<ConstantPose>(Pose{}), knots, p, constraints,
                                      static_cast<std::uint64_t>(seed), 0, progress);
  EXPECT_TRUE(solved);
  return solved->errors;
}

// Root mean squares over the seeds, of each knot: along x, y, z (m), then the rotation (rad).
std::vector<std::array<double, 6>> spread(std::span<const ErrorKnot> knots, const ErrorProfile& p,
                                          const std::vector<MotionConstraint>& constraints, int seeds = kDrawn) {
  std::vector<std::array<double, 6>> sum(knots.size());
  for (int seed = 0; seed < seeds; ++seed) {
    const auto errors = errorsOf(knots, p, constraints, seed);
    for (std::size_t i = 0; i < knots.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        sum[i][k] += errors[i].position_m[k] * errors[i].position_m[k] / seeds;
        sum[i][k + 3] += errors[i].rotation_rad[k] * errors[i].rotation_rad[k] / seeds;
      }
  }
  for (auto& knot : sum)
    for (double& square_sum : knot) square_sum = std::sqrt(square_sum);
  return sum;
}

std::size_t knotAtWay(std::span<const ErrorKnot> knots, double way) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < knots.size(); ++i)
    if (std::abs(knots[i].way_m - way) < std::abs(knots[nearest].way_m - way)) nearest = i;
  return nearest;
}

double meanSquareOverWay(std::span<const ErrorKnot> knots, const std::vector<std::array<double, 6>>& sigma, int k) {
  double sum = 0;
  for (std::size_t i = 1; i < knots.size(); ++i)
    sum += (knots[i].way_m - knots[i - 1].way_m) * (sigma[i][k] * sigma[i][k] + sigma[i - 1][k] * sigma[i - 1][k]) / 2;
  return sum / knots.back().way_m;
}

TEST(ErrorKnots, AreAtMostAQuarterOfAMetreAndOfASecondApart) {
  const auto path = walkPath(std::vector<Waypoint>{{{0, 0, 0}, 5, {}}, {{6, 0, 0}, 3, {}}, {{6, 9, 1}, 0, {}}});
  const auto knots = errorKnots(path->poses);
  ASSERT_TRUE(knots);
  for (std::size_t i = 1; i < knots->size(); ++i) {
    EXPECT_LE((*knots)[i].time_s - (*knots)[i - 1].time_s, 0.25);
    EXPECT_LE((*knots)[i].way_m - (*knots)[i - 1].way_m, 0.25);
  }
  EXPECT_EQ(knots->back().time_s, path->poses.last_s());
  EXPECT_NEAR(knots->back().way_m, path->length_m, 0.02);
  EXPECT_FALSE(errorKnots(ConstantPose({})));
  // A path that ends just after a step has no step that is as short.
  for (const double end : {9.9999999, 10.0000001}) {
    const auto track = PoseSpline::through(
        {{0, end}, {{Eigen::Quaterniond::Identity(), {0, 0, 0}}, {Eigen::Quaterniond::Identity(), {end / 2, 0, 0}}}});
    const auto of_track = *errorKnots(*track);
    for (std::size_t i = 1; i < of_track.size(); ++i)
      EXPECT_GT(of_track[i].time_s - of_track[i - 1].time_s, 0.12) << end << " knot " << i;
    EXPECT_EQ(of_track.back().time_s, end);
  }
}

TEST(TrajectoryError, M7_GrowsWithTheRootOfTheWay) {
  const auto knots = *errorKnots(*straight(400));
  const auto sigma = spread(knots, drifting(2), {});
  for (const auto& [way, expected_mm] : {std::pair{25.0, 10.0}, std::pair{100.0, 20.0}, std::pair{400.0, 40.0}})
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(1000 * sigma[knotAtWay(knots, way)][k], expected_mm, 0.08 * expected_mm) << way << " axis " << k;
}

TEST(TrajectoryError, M7_OfTheHeadingAloneGrowsAcross) {
  const auto knots = *errorKnots(*straight(100));
  const auto sigma = spread(knots, drifting(0, 0.01), {});
  EXPECT_NEAR(1000 * sigma.back()[1], 100.8, 0.08 * 100.8);
  EXPECT_NEAR(1000 * sigma.back()[0], 0, 0.01);
  EXPECT_NEAR(sigma.back()[5] / kRadPerDeg, 0.1, 0.008);
}

TEST(TrajectoryError, M8_IsABridgeOnceTheLoopIsClosed) {
  const auto knots = *errorKnots(*square(100));
  const double end = knots.back().time_s;
  const auto open = spread(knots, drifting(2), {});
  EXPECT_NEAR(1000 * open.back()[0], 20, 1.6);
  const auto closed = spread(knots, drifting(2), {{end, 0, 0, {}}});
  EXPECT_NEAR(1000 * closed[knotAtWay(knots, 50)][1], 10, 0.8);
  EXPECT_NEAR(1000 * std::sqrt(meanSquareOverWay(knots, closed, 0)), 8.16, 0.08 * 8.16);
  EXPECT_LT(1000 * closed.back()[0], 0.001);
  const auto loose = spread(knots, drifting(2), {{end, 0, 0.005, {}}});
  EXPECT_NEAR(1000 * loose.back()[0], 4.85, 0.08 * 4.85);
}

TEST(TrajectoryError, M12_IsHeldByAnchors) {
  const auto path = straight(200);
  const auto knots = *errorKnots(*path);
  for (const auto& [sigma_mm, mid_mm] : {std::pair{0.0, 5.0}, std::pair{3.0, 5.43}}) {
    std::vector<MotionConstraint> anchors;
    for (int k = 0; k <= 8; ++k) anchors.push_back({knots[knotAtWay(knots, 25 * k)].time_s, {}, sigma_mm / 1000, {}});
    const auto sigma = spread(knots, drifting(2), anchors);
    EXPECT_NEAR(1000 * sigma[knotAtWay(knots, 87.5)][0], mid_mm, 0.08 * mid_mm);
    if (sigma_mm > 0) continue;
    EXPECT_NEAR(1000 * std::sqrt(meanSquareOverWay(knots, sigma, 0)), 4.08, 0.08 * 4.08);
  }
}

// In closed form what the draws show.
TEST(ExpectedErrors, AreTheSpreadOverSeeds) {
  const auto knots = *errorKnots(*square(60));
  const std::vector<MotionConstraint> held = {{knots.back().time_s, 0, 0.005, 0.02 * kRadPerDeg},
                                              {knots[knotAtWay(knots, 22)].time_s, {}, 0.003, {}}};
  Progress progress;
  for (const char* id : {"poor", "survey-mms"})
    for (const auto& constraints : {std::vector<MotionConstraint>{}, held}) {
      const auto drawn = spread(knots, profile(id), constraints);
      const auto expected = expectedErrors(knots, profile(id), constraints, progress, 7);
      ASSERT_TRUE(expected);
      ASSERT_EQ(expected->size(), 7U);
      EXPECT_EQ(expected->back().time_s, knots.back().time_s);
      for (const auto& one : *expected) {
        std::size_t i = 0;
        while (knots[i].time_s < one.time_s) ++i;
        for (int k = 0; k < 3; ++k) {
          EXPECT_NEAR(drawn[i][k], one.position_m[k], 0.16 * one.position_m[k] + 1e-9) << id << " " << i;
          EXPECT_NEAR(drawn[i][k + 3], one.rotation_rad[k], 0.16 * one.rotation_rad[k] + 1e-9) << id << " " << i;
        }
      }
    }
}

// The table of mobile.md §4.3, in the plane and without the error of scale.
TEST(TrajectoryError, OfTheProfilesIsThatOfTheirTable) {
  struct Row {
    const char* id;
    double closed_100_mm, closed_300_mm, open_300_mm;
  };
  for (const auto& [id, closed_100, closed_300, open_300] :
       {Row{"wearable", 5.0, 11.1, 26.9}, Row{"handheld", 9.1, 20.1, 53.8}, Row{"poor", 10.5, 29.3, 109}}) {
    ErrorProfile p = profile(id);
    p.scale = 0;
    for (const auto& [around, expected] : {std::pair{100.0, closed_100}, std::pair{300.0, closed_300}}) {
      const auto knots = *errorKnots(*square(around));
      const auto closed = spread(knots, p, {{knots.back().time_s, 0, 0.003, 0.02 * kRadPerDeg}}, 300);
      const double rms = std::sqrt(meanSquareOverWay(knots, closed, 0) + meanSquareOverWay(knots, closed, 1));
      EXPECT_NEAR(1000 * rms, expected, 0.12 * expected) << id << " " << around;
    }
    const auto knots = *errorKnots(*square(300));
    const auto open = spread(knots, p, {}, 300);
    EXPECT_NEAR(1000 * std::hypot(open.back()[0], open.back()[1]), open_300, 0.12 * open_300) << id;
  }
}

TEST(TrajectoryError, TiltsAsGravityAllowsAndDriftsUpAndDownThroughThat) {
  ErrorProfile p;
  p.drift_m_sqrt_m = 1e-9;
  p.tilt_rad = 0.03 * kRadPerDeg;
  const auto knots = *errorKnots(*straight(200));
  const auto sigma = spread(knots, p, {});
  for (const std::size_t i : {std::size_t{0}, knots.size() / 2, knots.size() - 1})
    for (const int k : {3, 4}) EXPECT_NEAR(sigma[i][k] / kRadPerDeg, 0.03, 0.03 * 5 / std::sqrt(2.0 * kDrawn));
  EXPECT_LT(sigma.back()[5], 1e-12);
  // 20 s of correlation are 18 m of way: about 0.03° √(2 · 18 m · 200 m).
  EXPECT_NEAR(1000 * sigma.back()[2], 1000 * p.tilt_rad * std::sqrt(2 * 18.0 * (200 - 18)), 8);
}

TEST(TrajectoryError, WithGnssStaysWhatItsClassSays) {
  const auto knots = *errorKnots(*straight(200));
  const auto sigma = spread(knots, profile("survey-mms"), {});
  for (const std::size_t i : {std::size_t{0}, knots.size() - 1}) {
    EXPECT_NEAR(1000 * sigma[i][0], 20, 1.6);
    EXPECT_NEAR(1000 * sigma[i][2], 30, 2.4);
    EXPECT_NEAR(sigma[i][5] / kRadPerDeg, 0.015, 0.0012);
  }
  double product = 0;  // slowly varying: over 60 s of τ = 120 s it keeps e^-1/2
  const std::size_t later = knotAtWay(knots, 54);
  for (int seed = 0; seed < kDrawn; ++seed) {
    const auto errors = errorsOf(knots, profile("survey-mms"), {}, seed);
    product += errors[0].position_m.dot(errors[later].position_m) / kDrawn;
  }
  const double seconds = knots[later].time_s;
  EXPECT_NEAR(product / (2 * 0.02 * 0.02 + 0.03 * 0.03), std::exp(-seconds / 120), 0.1);
}

TEST(TrajectoryError, IsLargerAlongACorridorAndInAHurry) {
  auto knots = *errorKnots(*straight(100));
  for (auto& knot : knots) knot.degeneracy = degeneracy(Vector3d(0, 50, 50).asDiagonal());
  const auto sigma = spread(knots, drifting(2), {}, 300);
  EXPECT_NEAR(sigma.back()[0] / sigma.back()[1], 5, 0.5);
  EXPECT_NEAR(1000 * sigma.back()[1], 20, 2);
}

// M15's last part: by bits, up to the last knots of the shorter walk.
TEST(TrajectoryError, M15_IsTheSameHoweverLongTheWalkGets) {
  const auto long_path = straight(300);
  const auto all = *errorKnots(*long_path);
  const auto beginning = std::span(all).first(400);
  Progress progress;
  const ErrorProfile p = profile("handheld");
  const auto a = solveTrajectory(long_path, all, p, {}, 7, 3, progress);
  const auto b = solveTrajectory(long_path, beginning, p, {}, 7, 3, progress);
  for (double t = 0; t < beginning[398].time_s; t += 0.0731) {
    const Pose x = a->pose->pose(t), y = b->pose->pose(t);
    EXPECT_EQ(std::memcmp(x.translation.data(), y.translation.data(), sizeof(double) * 3), 0);
    EXPECT_EQ(std::memcmp(x.rotation.coeffs().data(), y.rotation.coeffs().data(), sizeof(double) * 4), 0);
  }
}

TEST(TrajectoryError, IsKnownByItsSeed) {
  const auto knots = *errorKnots(*square(40));
  const std::vector<MotionConstraint> closure = {{knots.back().time_s, 0, 0.003, 0.02 * kRadPerDeg}};
  const auto a = errorsOf(knots, profile("handheld"), closure, 1), b = errorsOf(knots, profile("handheld"), closure, 1),
             c = errorsOf(knots, profile("handheld"), closure, 2);
  EXPECT_EQ(a[50].position_m, b[50].position_m);
  EXPECT_NE(a[50].position_m, c[50].position_m);
}

TEST(SolvedTrajectory, IsTheTruthWithTheErrorOnItAndSmooth) {
  const auto path = square(40);
  const auto knots = *errorKnots(*path);
  ErrorProfile p = profile("handheld");
  p.shake_m = p.shake_rad = 0;
  Progress progress;
  const auto solved = solveTrajectory(path, knots, p, {}, 5, 0, progress);
  ASSERT_TRUE(solved);
  for (std::size_t i = 0; i < knots.size(); i += 7) {
    const Pose truth = path->pose(knots[i].time_s), is = solved->pose->pose(knots[i].time_s);
    EXPECT_LT((is.translation - truth.translation - solved->errors[i].position_m).norm(), 1e-12);
    EXPECT_LT((rotationVector(is.rotation * truth.rotation.conjugate()) - solved->errors[i].rotation_rad).norm(), 1e-9);
  }
  constexpr double h = 1e-3;
  const auto bend = [&](double t) {
    const auto error = [&](double at) {
      return Vector3d(solved->pose->pose(at).translation - path->pose(at).translation);
    };
    return Vector3d((error(t - h) - 2 * error(t) + error(t + h)) / (h * h));
  };
  double largest = 0, jump = 0;
  for (std::size_t i = 20; i < 60; ++i) {
    largest = std::max(largest, bend(knots[i].time_s).norm());
    jump = std::max(jump, (bend(knots[i].time_s + 2 * h) - bend(knots[i].time_s - 2 * h)).norm());
  }
  EXPECT_LT(jump, 0.3 * largest);
}

TEST(SolvedTrajectory, ShakesWithinAScan) {
  const auto path = straight(20);
  const auto knots = *errorKnots(*path);
  ErrorProfile p;
  p.drift_m_sqrt_m = 1e-12;
  p.shake_m = 0.002;
  p.shake_rad = 0.02 * kRadPerDeg;
  Progress progress;
  const auto solved = solveTrajectory(path, knots, p, {}, 5, 0, progress);
  double squares = 0, turns = 0;
  int count = 0;
  for (double t = 1; t < 20; t += 0.0057, ++count) {
    squares += (solved->pose->pose(t).translation - path->pose(t).translation).squaredNorm() / 3;
    turns += rotationVector(solved->pose->pose(t).rotation * path->pose(t).rotation.conjugate()).squaredNorm() / 3;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.002, 0.0003);
  EXPECT_NEAR(std::sqrt(turns / count) / kRadPerDeg, 0.02, 0.003);
}

TEST(TrajectoryError, OfTooManyConstraintsIsRefusedAndCanBeCancelled) {
  const auto knots = *errorKnots(*straight(20));
  Progress progress;
  const std::vector<MotionConstraint> many(601);
  const auto refused =
      solveTrajectory(std::make_shared<ConstantPose>(Pose{}), knots, drifting(2), many, 1, 0, progress);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "a trajectory has at most 600 closures and control points, not 601");
  progress.cancel();
  const auto cancelled = solveTrajectory(std::make_shared<ConstantPose>(Pose{}), knots, drifting(2),
                                         std::vector<MotionConstraint>(3), 1, 0, progress);
  EXPECT_EQ(cancelled.error().kind, ErrorKind::cancelled);
}

// M20.
TEST(Degeneracy, M20_IsTheClampAlongABareCorridorAndOneInARoom) {
  Matrix3d corridor = Matrix3d::Zero(), room = Matrix3d::Zero();
  for (int i = 0; i < 400; ++i) {
    const Vector3d across = i % 2 == 0 ? Vector3d::UnitY() : Vector3d::UnitZ();
    corridor += across * across.transpose();
    const Vector3d any = Vector3d::Unit(i % 3) * (1 + 0.1 * (i % 3));
    room += any * any.transpose();
  }
  const Matrix3d along = degeneracy(corridor);
  EXPECT_NEAR(along(0, 0), 5, 1e-9);
  EXPECT_NEAR(along(1, 1), 1, 1e-9);
  EXPECT_NEAR(along(2, 2), 1, 1e-9);
  const Matrix3d in_room = degeneracy(room);
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(in_room(k, k), 1 - 1e-9);
    EXPECT_LE(in_room(k, k), 1.3);
  }
  const Matrix3d turned = rotationBy({0, 0, 0.7}).toRotationMatrix();
  EXPECT_LT((degeneracy(turned * corridor * turned.transpose()) - turned * along * turned.transpose()).norm(), 1e-9);
  EXPECT_EQ(degeneracy(room, 0.05), 5 * Matrix3d::Identity());
  EXPECT_EQ(degeneracy(Matrix3d::Zero()), 5 * Matrix3d::Identity());
  EXPECT_NEAR(degeneracy(Vector3d(0, 0, 7).asDiagonal())(2, 2), 1, 1e-9);
  EXPECT_NEAR(degeneracy(Vector3d(0, 0, 7).asDiagonal())(0, 0), 5, 1e-9);
}

TEST(FindClosures, FindsWhereAPathComesBack) {
  const auto once = findClosures(*errorKnots(*square(100)));
  ASSERT_EQ(once.size(), 1U);
  EXPECT_LT(once[0].distance_m, 0.3);
  EXPECT_NEAR(once[0].way_m, 100, 2);
  EXPECT_TRUE(findClosures(*errorKnots(*straight(100))).empty());
  const auto eight = walk({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {10, 20, 0}, {10, -20, 0}});
  const auto crossing = findClosures(*errorKnots(*eight));
  ASSERT_EQ(crossing.size(), 1U);
  EXPECT_LT(crossing[0].distance_m, 0.25);
  const auto and_back = walk({{0, 0, 0}, {30, 0, 0}, {0, 0, 0}});
  const auto several = findClosures(*errorKnots(*and_back));
  EXPECT_GE(several.size(), 2U);
  EXPECT_LE(several.size(), 4U);
  EXPECT_TRUE(findClosures(*errorKnots(*and_back), {}, [](const LoopClosure&) { return false; }).empty());
  const auto upstairs = walk({{0, 0, 0}, {20, 0, 0}, {20, 2, 3}, {0, 2, 3}});
  EXPECT_TRUE(findClosures(*errorKnots(*upstairs)).empty());
}

// Shortly before its end it crosses the way that it has just come.
TEST(FindClosures, ClosesTheLongestWayRoundFirst) {
  const auto path =
      walk({{0, 0, 0}, {25, 0, 0}, {25, 25, 0}, {0, 25, 0}, {0, 5, 0}, {5, 5, 0}, {5, 9, 0}, {-1, 9, 0}, {0, 0, 0}});
  const auto closures = findClosures(*errorKnots(*path));
  ASSERT_FALSE(closures.empty());
  const LoopClosure& last = closures.back();
  EXPECT_NEAR(last.time_s, path->last_s(), 3);
  EXPECT_LT(last.earlier_s, 3);
  EXPECT_GT(last.way_m, 100);
}

}  // namespace
}  // namespace standpoint
