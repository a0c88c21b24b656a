// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/targets/target_fit.h"

#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "core/random.h"
#include "core/units.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

// Beams of a grid over a window round +X, and what they meet, by formulas of their own.
struct Scanned {
  std::vector<Vector3d> points;
  std::vector<float> intensity;
};

std::optional<double> sphereRange(const Vector3d& beam, const Vector3d& centre, double radius) {
  const double along = beam.dot(centre), inside = radius * radius - (centre - along * beam).squaredNorm();
  return inside > 0 ? std::optional(along - std::sqrt(inside)) : std::nullopt;
}

class Bench {
 public:
  struct Ball {
    Vector3d centre;
    double radius;
  };
  struct Board {
    Vector3d centre, normal, right;
    double side;
  };
  std::vector<Ball> balls;
  std::vector<Board> boards;
  std::optional<double> wall_x;
  double pipe_radius = 0;  // upright, round balls[0]'s place: (x, y) of it
  Vector3d pipe = Vector3d::Zero();
  double sigma_m = 0, intensity_sigma = 0;

  Scanned scan(double points_per_degree, double half_window_rad, std::uint32_t run = 0) const {
    Scanned s;
    const double step = kRadPerDeg / points_per_degree;
    const auto n = static_cast<int>(half_window_rad / step);
    const auto dither = philox({run, 77}, 0, 0, 0);
    for (int i = -n; i <= n; ++i)
      for (int j = -n; j <= n; ++j) {
        const double azimuth = (i + uniform(dither[0])) * step, elevation = (j + uniform(dither[1])) * step;
        const Vector3d beam(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                            std::sin(elevation));
        const auto [range, bright] = met(beam);
        if (!(range < 1e3)) continue;
        const auto noise =
            normals(philox({run, 5}, static_cast<std::uint32_t>(i + n), static_cast<std::uint32_t>(j + n), 1));
        s.points.push_back(beam * (range + sigma_m * noise[0]));
        s.intensity.push_back(static_cast<float>(bright + intensity_sigma * noise[1]));
      }
    return s;
  }

 private:
  std::pair<double, double> met(const Vector3d& beam) const {
    double range = 1e9, bright = 0.5;
    if (wall_x) range = *wall_x / beam.x();
    for (const auto& b : balls)
      if (const auto r = sphereRange(beam, b.centre, b.radius); r && *r < range) range = *r, bright = 0.9;
    if (pipe_radius > 0) {
      const double flat = std::hypot(beam.x(), beam.y());
      const Vector3d level(beam.x() / flat, beam.y() / flat, 0);
      if (const auto r = sphereRange(level, Vector3d(pipe.x(), pipe.y(), 0), pipe_radius); r && *r / flat < range)
        range = *r / flat;
    }
    for (const auto& b : boards) {
      const double r = b.normal.dot(b.centre) / b.normal.dot(beam);
      const Vector3d d = r * beam - b.centre;
      const double x = b.right.dot(d), y = b.normal.cross(b.right).dot(d);
      if (r < range && std::abs(x) < b.side / 2 && std::abs(y) < b.side / 2) range = r, bright = x * y > 0 ? 0.9 : 0.05;
    }
    return {range, bright};
  }
};

struct Spread {
  Vector3d mean = Vector3d::Zero(), sigma = Vector3d::Zero();
  double points = 0, told_los = 0;
};
// physics.md §6: sphere of 145 mm, 1 mm of range noise, no angle noise; x is the line of sight. In mm.
Spread spread(double ppd, double distance, bool free_radius, std::uint32_t runs) {
  Bench bench;
  bench.balls = {{{distance, 0, 0}, 0.0725}};
  bench.sigma_m = 0.001;
  SphereSearch search;
  search.free_radius = free_radius;
  Vector3d squares = Vector3d::Zero();
  Spread s;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const auto fit = fitSphere(bench.scan(ppd, 0.09 / distance, run).points, {distance + 0.004, -0.003, 0.005}, search);
    if (!fit) {
      ADD_FAILURE() << fit.error().message;
      return s;
    }
    const Vector3d off = (fit->centre - Vector3d(distance, 0, 0)) * 1000;
    s.mean += off / runs, squares += off.cwiseAbs2() / runs, s.points += static_cast<double>(fit->points) / runs;
    s.told_los += fit->sigma_m().x() * 1000 / runs;
  }
  s.sigma = (squares - s.mean.cwiseAbs2()).cwiseSqrt();
  return s;
}

TEST(SphereFit, WithTheKnownRadiusScattersAsTheReferenceHasIt) {
  const Spread s = spread(30, 10, false, 200);
  EXPECT_NEAR(s.points, 366, 12);
  EXPECT_NEAR(s.sigma.x(), 0.058, 0.008);
  EXPECT_NEAR(s.sigma.y(), 0.082, 0.010);
  EXPECT_NEAR(s.sigma.z(), 0.082, 0.010);
  EXPECT_NEAR(s.mean.x(), -0.014, 0.012) << "bias -σ²/r";
  EXPECT_NEAR(s.told_los, s.sigma.x(), 0.15 * s.sigma.x()) << "what a single fit tells of itself";
  const Spread fine = spread(90, 10, false, 60);
  EXPECT_NEAR(fine.points, 3294, 100);
  EXPECT_NEAR(fine.sigma.x(), 0.0185, 0.004);
  EXPECT_NEAR(fine.sigma.y(), 0.0275, 0.005);
  EXPECT_NEAR(fine.sigma.z(), 0.0275, 0.005);
  const Spread far = spread(30, 20, false, 200);
  EXPECT_NEAR(far.points, 91, 6);
  EXPECT_NEAR(far.sigma.x(), 0.115, 0.015);
  EXPECT_NEAR(far.sigma.y(), 0.165, 0.02);
}

TEST(SphereFit, WithAFreeRadiusIsBiasedTowardsTheScanner) {
  const Spread s = spread(30, 10, true, 200);
  EXPECT_NEAR(s.sigma.x(), 0.29, 0.04);
  EXPECT_NEAR(s.mean.x(), -0.16, 0.05);
  const Spread fine = spread(90, 10, true, 60);
  EXPECT_NEAR(fine.sigma.x(), 0.096, 0.02);
  EXPECT_NEAR(fine.mean.x(), -0.16, 0.03);
}

TEST(SphereFit, IsExactWithoutNoiseFromAPredictionHalfAMetreOffBeforeAWall) {
  Bench bench;
  const Vector3d centre(8, 0.1, -0.05);
  bench.balls = {{centre, 0.0725}};
  bench.wall_x = 8.3;
  const auto s = bench.scan(30, 0.1);
  for (const Vector3d& off : {Vector3d(0, 0.49, 0), Vector3d(-0.3, -0.3, 0.2), Vector3d(0.49, 0, 0)}) {
    const auto fit = findSphere(s.points, centre + off, {});
    ASSERT_TRUE(fit) << fit.error().message;
    EXPECT_LT((fit->centre - centre).norm(), 1e-7);
  }
}

TEST(SphereFit, WithNoiseFindsAFarSphereOfFewPoints) {
  Bench bench;
  const Vector3d centre(26, 0, 0);
  bench.balls = {{centre, 0.0725}};
  bench.wall_x = 26.5;
  bench.sigma_m = 0.002;
  const auto fit = findSphere(bench.scan(30, 0.03, 3).points, centre + Vector3d(0.1, 0.4, 0.2), {});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_LT((fit->centre - centre).norm(), 0.0015);
  EXPECT_GT(fit->points, 40U);
}

std::string refused(const Bench& bench, const Vector3d& predicted, const SphereSearch& search = {}, double ppd = 30) {
  const auto fit = findSphere(bench.scan(ppd, 0.1, 1).points, predicted, search);
  return fit ? "found" : fit.error().message;
}

TEST(SphereFit, IsRefusedWithTheReason) {
  Bench bench;
  bench.sigma_m = 0.001;
  bench.wall_x = 8.6;
  EXPECT_NE(refused(bench, {8, 0, 0}), "found") << "a bare wall";
  bench.balls = {{{8, 0, 0}, 0.1}};
  EXPECT_THAT(refused(bench, {8, 0.2, 0}), HasSubstr("wrong radius: fitted 9"));
  bench.balls = {{{8, 0, 0}, 0.0725}, {{8, 0.4, 0}, 0.0725}};
  EXPECT_THAT(refused(bench, {8, 0.2, 0}), HasSubstr("two candidates 400"));
  SphereSearch near;
  near.search_m = 0.15;
  EXPECT_EQ(refused(bench, {8, 0, 0}, near), "found");
  bench.balls = {{{8, 0, 0}, 0.0725}};
  EXPECT_THAT(fitSphere(bench.scan(5, 0.1).points, {8, 0, 0}, {}).error().message,
              HasSubstr("too few points on the target"));
  bench.balls.clear();
  EXPECT_THAT(refused({}, {8, 0, 0}), HasSubstr("too few points near"));
  bench.pipe = {8, 0, 0};
  bench.pipe_radius = 0.0725;
  EXPECT_NE(refused(bench, {8, 0, 0}), "found") << "a pipe of the same radius";
}

TEST(NoFit, IsReadFromTheErrorThatItMade) {
  for (const auto why : {NoFit::few_points, NoFit::other_radius, NoFit::mixed, NoFit::parts, NoFit::no_pattern,
                         NoFit::no_intensity, NoFit::two, NoFit::none}) {
    EXPECT_EQ(noFitOf(noFit(why)), why);
    EXPECT_EQ(noFitOf(noFit(why, ": 12 of at least 20")), why);
  }
  const auto fit = findSphere({}, {8, 0, 0}, {});
  ASSERT_FALSE(fit);
  EXPECT_EQ(noFitOf(fit.error()), NoFit::few_points);
}

TEST(SphereFit, BehindARailIsMixedAndRefused) {
  Bench bench;
  bench.sigma_m = 0.001;
  bench.balls = {{{8, 0, 0}, 0.0725}};
  bench.pipe = {7.8, 0, 0};
  bench.pipe_radius = 0.025;
  EXPECT_NE(refused(bench, {8, 0, 0}), "found");
}

Bench boardBench(const Vector3d& centre, double tilt_deg, double turn_deg) {
  Bench bench;
  const Vector3d normal = Eigen::AngleAxisd(tilt_deg * kRadPerDeg, Vector3d::UnitZ()) * -Vector3d::UnitX();
  const Vector3d right = Eigen::AngleAxisd(turn_deg * kRadPerDeg, normal) * normal.cross(Vector3d::UnitZ());
  bench.boards = {{centre, normal, right, 0.15}};
  bench.sigma_m = 0.001;
  bench.intensity_sigma = 0.02;
  return bench;
}

// physics.md §6: σ_edge ≈ increment/√12/√n_edge, which is 0.36 mm here (5.8 mm between points, some 22 along each
// edge). Where the edges run along the columns, all points of an edge are as far off: increment/√12 for each axis, 2.4
// mm.
TEST(CheckerboardFit, FindsTheMiddleFromAPredictionHalfAMetreOff) {
  for (const double tilt : {0.0, 40.0})
    for (const double turn : {0.0, 17.0, 70.0}) {
      const Vector3d centre(10, 0.05, -0.02);
      Bench bench = boardBench(centre, tilt, turn);
      bench.wall_x = 10.3;
      double squares = 0, told = 0;
      for (std::uint32_t run = 0; run < 5; ++run) {
        const auto s = bench.scan(30, 0.07, run);
        const auto fit = findCheckerboard(s.points, s.intensity, centre + Vector3d(0.2, 0.35, 0.25), {});
        ASSERT_TRUE(fit) << fit.error().message << " at " << tilt << " " << turn;
        squares += (fit->centre - centre).squaredNorm() / 5;
        told += fit->covariance_m2.trace() / 5;
        EXPECT_NEAR(fit->incidence_rad, tilt * kRadPerDeg, 0.02);
      }
      EXPECT_LT(std::sqrt(squares), turn == 0 ? 0.0036 : 0.0012) << tilt << " " << turn;
      EXPECT_LT(std::sqrt(squares / told), 2.5) << "told: " << std::sqrt(told);
    }
}

TEST(CheckerboardFit, IsToATenthOfAMillimetreWhereThePointsAreDense) {
  const Vector3d centre(5, 0, 0);
  const auto s = boardBench(centre, 20, 30).scan(90, 0.03, 9);
  const auto fit = findCheckerboard(s.points, s.intensity, centre + Vector3d(0, 0.1, 0.1), {});
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_LT((fit->centre - centre).norm(), 1e-4);
}

TEST(CheckerboardFit, IsRefusedWithTheReason) {
  const Vector3d centre(8, 0, 0);
  Bench bench = boardBench(centre, 0, 0);
  const auto s = bench.scan(30, 0.07);
  EXPECT_THAT(findCheckerboard(s.points, {}, centre, {}).error().message, HasSubstr("no intensity"));
  EXPECT_THAT(findCheckerboard(s.points, s.intensity, {20, 0, 0}, {}).error().message,
              HasSubstr("too few points near"));
  bench.boards.push_back(bench.boards[0]);
  bench.boards[1].centre.y() = 0.4;
  const auto two = bench.scan(30, 0.07);
  EXPECT_THAT(findCheckerboard(two.points, two.intensity, {8, 0.2, 0}, {}).error().message,
              HasSubstr("two candidates"));
  bench.boards.clear();
  bench.wall_x = 8;
  const auto blank = bench.scan(30, 0.07);
  EXPECT_FALSE(findCheckerboard(blank.points, blank.intensity, centre, {}));
}

}  // namespace
}  // namespace standpoint
