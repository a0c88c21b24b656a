// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decompositions.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

TEST(Decompositions, PrincipalAxesOfATurnedEllipsoidAreItsOwnAscending) {
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const auto [values, axes] = principalAxes(turn * Vector3d(4, 0.25, 1).asDiagonal() * turn.transpose());
  EXPECT_TRUE(values.isApprox(Vector3d(0.25, 1, 4), 1e-14));
  EXPECT_NEAR(std::abs(axes.col(0).dot(turn.col(1))), 1, 1e-14);
  EXPECT_NEAR(std::abs(axes.col(2).dot(turn.col(0))), 1, 1e-14);
}

TEST(Decompositions, SingularValuesOfAMirroredStretchDescendAndGiveTheMatrixBack) {
  Matrix3d m;
  m << 0, -3, 0, 1, 0, 0, 0, 0, -2;  // by hand: a quarter turn of stretches 1 and 3, and a mirrored 2
  const auto [u, values, v] = singularValues(m);
  EXPECT_TRUE(values.isApprox(Vector3d(3, 2, 1), 1e-14));
  EXPECT_TRUE((u * values.asDiagonal() * v.transpose()).isApprox(m, 1e-14));
}

TEST(Decompositions, ALineThroughFourPointsHasTheSlopeAndSpreadOfTheTextbook) {
  MatrixXd rows(4, 2);
  rows << 1, 0, 1, 1, 1, 2, 1, 3;
  const VectorXd heights = Eigen::Vector4d(1, 3, 2, 5);
  const VectorXd line = solveNormal(rows.transpose() * rows, rows.transpose() * heights);
  EXPECT_NEAR(line[0], 1.1, 1e-14);  // Σ(x-x̄)(y-ȳ) / Σ(x-x̄)² = 5.5 / 5
  EXPECT_NEAR(line[1], 1.1, 1e-14);
  const MatrixXd cofactors = inverseOfNormal(rows.transpose() * rows);
  EXPECT_NEAR(cofactors(0, 0), 0.7, 1e-14);  // 1/n + x̄² / Σ(x-x̄)²
  EXPECT_NEAR(cofactors(1, 1), 0.2, 1e-14);
}

TEST(Decompositions, AnUnknownThatNoObservationTouchesStaysZero) {
  MatrixXd a = MatrixXd::Zero(2, 2);
  a(0, 0) = 4;
  EXPECT_EQ(solveNormal(a, Eigen::Vector2d(2, 0)), Eigen::Vector2d(0.5, 0));
}

}  // namespace
}  // namespace standpoint
