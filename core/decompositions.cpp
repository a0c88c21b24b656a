// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/decompositions.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

namespace standpoint {

PrincipalAxes principalAxes(const Eigen::Matrix3d& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SingularValues singularValues(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::MatrixXd solveNormal(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return Eigen::LDLT<Eigen::MatrixXd>(a).solve(b);
}

Eigen::MatrixXd inverseOfNormal(const Eigen::MatrixXd& a) {
  return solveNormal(a, Eigen::MatrixXd::Identity(a.rows(), a.cols()));
}

}  // namespace standpoint
