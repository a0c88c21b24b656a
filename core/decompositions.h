// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Decompositions of matrices, compiled once: each of Eigen's solvers costs seconds in every file that uses one.

#include <Eigen/Core>

namespace standpoint {

// Of a symmetric matrix m: m · axes = axes · diag(values). The values ascend; the axes are orthonormal columns.
struct PrincipalAxes {
  Eigen::Vector3d values;
  Eigen::Matrix3d axes;
};
PrincipalAxes principalAxes(const Eigen::Matrix3d& symmetric);

// m = u · diag(values) · vᵀ. The values descend and are not negative; u and v are orthogonal, perhaps with a
// reflection.
struct SingularValues {
  Eigen::Matrix3d u;
  Eigen::Vector3d values;
  Eigen::Matrix3d v;
};
SingularValues singularValues(const Eigen::Matrix3d& m);

// The solution x of a · x = b and the inverse of a, for the normal matrix a of a least-squares fit: symmetric and
// positive semi-definite (by LDLᵀ with pivots; an unknown whose pivot is 0 stays 0).
Eigen::MatrixXd solveNormal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd inverseOfNormal(const Eigen::MatrixXd& a);

}  // namespace standpoint
