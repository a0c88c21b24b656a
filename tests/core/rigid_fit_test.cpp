// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rigid_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

const Pose kMotion{Eigen::Quaterniond(Eigen::AngleAxisd(2.5, Vector3d(1, -2, 3).normalized())), {4, -5, 6}};

std::vector<Vector3d> moved(const std::vector<Vector3d>& places, const Pose& by) {
  std::vector<Vector3d> result;
  for (const auto& p : places) result.push_back(by * p);
  return result;
}

TEST(RigidFit, OfThreePlacesIsTheMotionThatMovedThem) {
  const std::vector<Vector3d> from = {{0, 0, 0}, {5, 0, 1}, {0, 3, 2}};
  const auto fit = fitRigid(from, moved(from, kMotion));
  ASSERT_TRUE(fit) << fit.error().message;
  EXPECT_LT((fit->to_from.translation - kMotion.translation).norm(), 1e-12);
  EXPECT_LT(fit->to_from.rotation.angularDistance(kMotion.rotation), 1e-7);
  EXPECT_LT(fit->rms_m, 1e-12);
  EXPECT_NEAR(fit->scale, 1, 1e-12);
}

TEST(RigidFit, NeverMirrors) {
  const std::vector<Vector3d> from = {{0, 0, 0}, {5, 0, 0}, {0, 3, 0}, {0, 0, 2}};
  std::vector<Vector3d> to = from;
  for (auto& p : to) p.x() = -p.x();
  const auto fit = fitRigid(from, to);
  ASSERT_TRUE(fit);
  EXPECT_GT(fit->to_from.rotation.toRotationMatrix().determinant(), 0.999);
  EXPECT_GT(fit->rms_m, 0.3);
}

TEST(RigidFit, KeepsTheDigitsOfANationalGrid) {
  const Vector3d far(4567890.123, 5678901.234, 456.789);
  const std::vector<Vector3d> from = {{0, 0, 0}, {12.345, 0, 1}, {0, 7.654, 2}, {3, 4, 5}};
  std::vector<Vector3d> to = moved(from, kMotion);
  for (auto& p : to) p += far;
  const auto fit = fitRigid(from, to);
  ASSERT_TRUE(fit);
  for (std::size_t i = 0; i < from.size(); ++i) EXPECT_LT((fit->to_from * from[i] - to[i]).norm(), 3e-9);
  // And back, where a turn acts on the large numbers.
  const auto back = fitRigid(to, from);
  ASSERT_TRUE(back);
  for (std::size_t i = 0; i < from.size(); ++i) EXPECT_LT((back->to_from * to[i] - from[i]).norm(), 5e-9);
}

TEST(RigidFit, TellsTheScaleAndDoesNotApplyIt) {
  const std::vector<Vector3d> from = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}};
  std::vector<Vector3d> to;
  for (const auto& p : from) to.push_back(1.001 * p);
  const auto fit = fitRigid(from, to);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->scale, 1.001, 1e-12);
  for (const double r : fit->residual_m) EXPECT_NEAR(r, 0.001 * std::sqrt(200.0), 1e-12);
}

TEST(RigidFit, SharesAnErrorOutAsLeastSquaresDo) {
  // One corner of a square of side 2 lifted by 4 h: a plane takes up three quarters, and leaves ±h.
  const double h = 1e-4;
  const std::vector<Vector3d> from = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  std::vector<Vector3d> to = from;
  to[2].z() = 4 * h;
  const auto fit = fitRigid(from, to);
  ASSERT_TRUE(fit);
  for (const double r : fit->residual_m) EXPECT_NEAR(r, h, 1e-7);
}

// V15 of physics.md §7: what is left of errors of 1 mm in each coordinate of both frames, of 3n - 6 degrees of freedom.
TEST(RigidFit, V15_LeavesTheResidualThatItsDegreesOfFreedomSay) {
  constexpr double kSigma_m = 0.001;
  constexpr std::uint32_t kRuns = 500;
  const std::vector<Vector3d> places = {{0, 0, 0}, {12, 1, 2}, {10, 9, -1}, {-1, 11, 3}};
  for (const std::size_t n : {std::size_t{3}, std::size_t{4}}) {
    double squares = 0;
    for (std::uint32_t run = 0; run < kRuns; ++run) {
      std::vector<Vector3d> from(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(n));
      auto to = moved(from, kMotion);
      for (std::uint32_t i = 0; i < n; ++i) {
        const auto a = normals(philox({15, 0}, run, i, 0)), b = normals(philox({15, 0}, run, i, 1));
        from[i] += kSigma_m * Vector3d(a[0], a[1], a[2]);
        to[i] += kSigma_m * Vector3d(b[0], b[1], b[2]);
      }
      const auto fit = fitRigid(from, to);
      ASSERT_TRUE(fit);
      squares += fit->rms_m * fit->rms_m / kRuns;
    }
    EXPECT_NEAR(std::sqrt(squares) / (kSigma_m * (n == 3 ? 1.41 : 1.73)), 1, 0.03) << n;
  }
}

TEST(RigidFit, RefusesWhatHoldsNothing) {
  const std::vector<Vector3d> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}, two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_NE(fitRigid(line, line).error().message.find("collinear"), std::string::npos);
  EXPECT_NE(fitRigid(two, two).error().message.find("at least three pairs"), std::string::npos);
  EXPECT_FALSE(fitRigid(line, two));
  const std::vector<Vector3d> same(4, Vector3d(7, 7, 7)), nan = {{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}};
  EXPECT_FALSE(fitRigid(same, same));
  EXPECT_FALSE(fitRigid(nan, nan));
}

}  // namespace
}  // namespace standpoint
