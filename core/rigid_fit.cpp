// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rigid_fit.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "core/decompositions.h"

namespace standpoint {

namespace {

// Places this near to one line, as a share of its length, say nothing of the turn about it.
constexpr double kOnOneLine = 1e-3;

Eigen::Vector3d middleOf(std::span<const Eigen::Vector3d> places) {
  // About the first one, so that a national grid's digits do not eat those of the sum.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : places) sum += p - places.front();
  return places.front() + sum / static_cast<double>(places.size());
}

Eigen::Matrix3Xd around(std::span<const Eigen::Vector3d> places, const Eigen::Vector3d& middle) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = places[i] - middle;
  return result;
}

double breadthOf(const Eigen::Matrix3Xd& centred) {
  const Eigen::Vector3d squares = principalAxes(centred * centred.transpose()).values;
  return squares[2] > 0 ? std::sqrt(std::max(0.0, squares[1]) / squares[2]) : 0;
}

// The residuals of a fit with scale have 3n - 7 degrees of freedom; the scale's own weight is the spread of the places.
double scaleSigma(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b, const Eigen::Matrix3d& turn, double scale) {
  const double free = 3.0 * static_cast<double>(a.cols()) - 7;
  return std::sqrt((b - scale * turn * a).squaredNorm() / free / a.squaredNorm());
}

}  // namespace

Result<RigidFit> fitRigid(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to) {
  if (from.size() != to.size())
    return failure(ErrorKind::usage, "some positions have no counterpart in the other frame");
  if (from.size() < 3)
    return failure(ErrorKind::usage, "at least three pairs are required; given: " + std::to_string(from.size()));
  const auto finite = [](const Eigen::Vector3d& p) { return p.allFinite(); };
  if (!std::all_of(from.begin(), from.end(), finite) || !std::all_of(to.begin(), to.end(), finite))
    return failure(ErrorKind::usage, "a coordinate of a pair is not a finite number");
  const Eigen::Vector3d from_middle = middleOf(from), to_middle = middleOf(to);
  const Eigen::Matrix3Xd a = around(from, from_middle), b = around(to, to_middle);
  RigidFit fit;
  fit.breadth = std::min(breadthOf(a), breadthOf(b));
  if (!(fit.breadth > kOnOneLine))
    return failure(ErrorKind::usage,
                   "the positions are collinear, so rotation about the line is undetermined: add a pair off the line");

  const Eigen::Matrix4d motion = Eigen::umeyama(a, b, false);
  const Eigen::Matrix3d turn = motion.topLeftCorner<3, 3>();
  fit.to_from.rotation = Eigen::Quaterniond(turn).normalized();
  if (fit.to_from.rotation.w() < 0) fit.to_from.rotation.coeffs() *= -1;
  fit.to_from.translation = to_middle - fit.to_from.rotation * from_middle;
  fit.scale = (b.array() * (turn * a).array()).sum() / a.squaredNorm();
  fit.scale_sigma = scaleSigma(a, b, turn, fit.scale);
  for (Eigen::Index i = 0; i < a.cols(); ++i)
    fit.residual_m.push_back((b.col(i) - fit.to_from.rotation * a.col(i)).norm());
  for (const double r : fit.residual_m) fit.rms_m += r * r / static_cast<double>(from.size());
  fit.rms_m = std::sqrt(fit.rms_m);
  return fit;
}

}  // namespace standpoint
