// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/surface_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

// Planes n·x = offset, met only within `reach`: a surface whose distance is known without a search of ours.
struct Planes {
  std::vector<std::pair<Vector3d, double>> planes;
  SurfaceSearch search() const {
    return [this](std::span<const Vector3d> placed, double reach_m, std::span<SurfaceTouch> touches) {
      for (std::size_t i = 0; i < placed.size(); ++i) {
        double nearest = reach_m;
        for (const auto& [n, offset] : planes) {
          const double off = offset - n.dot(placed[i]);
          if (std::abs(off) >= nearest) continue;
          nearest = std::abs(off);
          touches[i] = {placed[i] + off * n, n};
        }
      }
    };
  }
};

const Planes kRoom{{{Vector3d::UnitX(), 0},
                    {Vector3d::UnitX(), 6},
                    {Vector3d::UnitY(), 0},
                    {Vector3d::UnitY(), 4},
                    {Vector3d::UnitZ(), 0},
                    {Vector3d::UnitZ(), 3}}};
const Planes kCorridor{
    {{Vector3d::UnitY(), 0}, {Vector3d::UnitY(), 2}, {Vector3d::UnitZ(), 0}, {Vector3d::UnitZ(), 3}}};

// Points on the planes' parts within [0, 6] x [0, 4] x [0, 3], off by noise along the normal.
std::vector<Vector3d> pointsOn(const Planes& surface, double sigma_m, int each = 400) {
  std::vector<Vector3d> points;
  for (std::uint32_t k = 0; k < surface.planes.size(); ++k)
    for (int i = 0; i < each; ++i) {
      const auto words = philox({7, k}, static_cast<std::uint32_t>(i), 0, 0);
      const auto noise = normals(philox({8, k}, static_cast<std::uint32_t>(i), 0, 0));
      Vector3d p(6 * uniform(words[0]), 4 * uniform(words[1]), 3 * uniform(words[2]));
      const auto& [n, offset] = surface.planes[k];
      points.push_back(p + (offset - n.dot(p) + sigma_m * noise[0]) * n);
    }
  return points;
}

std::vector<Vector3d> seenFrom(const Pose& frame, const std::vector<Vector3d>& points) {
  std::vector<Vector3d> result;
  for (const auto& p : points) result.push_back(frame.rotation.conjugate() * (p - frame.translation));
  return result;
}

double worst(const Pose& a, const Pose& b, const std::vector<Vector3d>& points) {
  double most = 0;
  for (const auto& p : points) most = std::max(most, (a * p - b * p).norm());
  return most;
}

const Pose kTruth{Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Vector3d(0.2, 0.1, 1).normalized())), {0.15, -0.1, 0.08}};

Result<SurfaceFit> fit(const Planes& surface, const std::vector<Vector3d>& points, const Pose& start = {}) {
  Progress progress;
  return fitToSurface(points, start, surface.search(), {}, progress);
}

TEST(SurfaceFit, BringsARoomBackToWhereItWas) {
  const auto points = seenFrom(kTruth, pointsOn(kRoom, 0));
  const auto result = fit(kRoom, points);
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_TRUE(result->settled);
  EXPECT_LT(worst(result->to_from, kTruth, points), 1e-6);
  EXPECT_NEAR(result->used_fraction, 1, 1e-12);
  EXPECT_NEAR(result->moved_m, 0.2, 0.05);
  EXPECT_TRUE(result->free.empty());
}

TEST(SurfaceFit, StatesItsNoiseAndHowWellItIsPlaced) {
  // 800 points hold each axis: σ of the shift is 2 mm / √800, by the weights of Tukey about 1.03 times that.
  const double sigma = 0.002;
  double squares = 0, stated = 0;
  constexpr int kTrials = 24;
  for (int trial = 0; trial < kTrials; ++trial) {
    auto points = pointsOn(kRoom, 0);
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const double noise = normals(philox({100u + static_cast<unsigned>(trial), 1}, i, 0, 0))[0];
      points[i] += sigma * noise * kRoom.planes[i / 400].first;
    }
    const auto result = fit(kRoom, points);
    ASSERT_TRUE(result);
    EXPECT_NEAR(result->rms_m, sigma, 0.0003);
    Vector3d middle = Vector3d::Zero();
    for (const auto& p : points) middle += p / static_cast<double>(points.size());
    squares += (result->to_from * middle - middle).squaredNorm();
    stated += result->sigma_shift_m.squaredNorm();
  }
  EXPECT_NEAR(std::sqrt(squares / 3 / kTrials), sigma / std::sqrt(800.0), 0.25 * sigma / std::sqrt(800.0));
  EXPECT_NEAR(std::sqrt(stated / squares), 1, 0.3);
}

TEST(SurfaceFit, IsNotDrawnAsideByWhatTheModelLacks) {
  auto points = seenFrom(kTruth, pointsOn(kRoom, 0.001));
  const std::size_t good = points.size();
  for (std::uint32_t i = 0; i < good / 3; ++i) {  // furniture: a quarter of all, on one side
    const auto words = philox({9, 0}, i, 0, 0);
    points.push_back({4.5 + uniform(words[0]), 0.4 + uniform(words[1]), uniform(words[2])});
  }
  const auto result = fit(kRoom, points);
  ASSERT_TRUE(result);
  EXPECT_LT(worst(result->to_from, kTruth, points), 0.001);
  EXPECT_NEAR(result->used_fraction, 0.75, 0.03);
}

TEST(SurfaceFit, TellsThatACorridorSlidesAndLeavesItThere) {
  const auto points = seenFrom(kTruth, pointsOn(kCorridor, 0.001));
  const auto result = fit(kCorridor, points);
  ASSERT_TRUE(result);
  ASSERT_EQ(result->free.size(), 1U);
  EXPECT_GT(std::abs(result->free[0].shift.x()), 0.999);
  EXPECT_TRUE(result->free[0].axis.isZero());
  // Across it is placed; along it stays where it was: 0.15 m off, but for what the turn about its middle brings.
  Vector3d off = Vector3d::Zero();
  for (const auto& p : points) off += (result->to_from * p - kTruth * p) / static_cast<double>(points.size());
  EXPECT_LT(std::hypot(off.y(), off.z()), 0.001);
  EXPECT_GT(std::abs(off.x()), 0.05);
}

TEST(SurfaceFit, OfAFloorAloneLeavesThreeMotionsFree) {
  const Planes floor{{{Vector3d::UnitZ(), 0}}};
  const auto result = fit(floor, pointsOn(floor, 0.001));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->free.size(), 3U);
}

TEST(SurfaceFit, RefusesTooFewPointsAndPointsFarFromAnySurface) {
  EXPECT_FALSE(fit(kRoom, pointsOn(kRoom, 0, 10)));
  auto far = pointsOn(kRoom, 0);
  for (auto& p : far) p += Vector3d(100, 100, 100);
  const auto result = fit(kRoom, far);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("place the cloud by pairs of points first"), std::string::npos);
  Progress cancelled;
  cancelled.cancel();
  EXPECT_EQ(fitToSurface(pointsOn(kRoom, 0), {}, kRoom.search(), {}, cancelled).error().kind, ErrorKind::cancelled);
}

}  // namespace
}  // namespace standpoint
