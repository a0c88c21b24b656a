// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <Eigen/Core>

#include "core/result.h"

namespace standpoint {

// A target as office software measures it in the points of one scan. All coordinates are in the scanner's own frame:
// the beams come from its origin.
struct TargetFit {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 =
      Eigen::Matrix3d::Zero();  // of the centre, by the scatter of the points: no bias is in it
  std::size_t points = 0;       // used
  double residual_m = 0;        // root mean square, across the surface
  double radius_m = 0;          // of a sphere: as given, or as fitted
  double radius_sigma_m = 0;
  double incidence_rad = 0;  // of a plate
  Eigen::Vector3d sigma_m() const { return covariance_m2.diagonal().cwiseSqrt(); }
};

struct TargetSearch {
  double search_m = 0.5;        // how far from the predicted place the centre may be
  std::size_t min_points = 20;  // fewer are no measurement
};

// Why there is no fit.
enum class NoFit { few_points, other_radius, mixed, parts, no_pattern, no_intensity, two, none };
// `unusable`; its message begins with the reason, which noFitOf() reads from it. `more`: ": 12 of at least 20".
Error noFit(NoFit why, const std::string& more = {});
NoFit noFitOf(const Error& error);

// Sphere of a known radius: found by votes of the surface's normals within reach of the prediction, then least squares
// of the distances to its surface with Tukey's weights, on beams that meet it within 60° of its normal. Errors are
// `unusable` and say why: no or too few points, another radius, mixed with what is around it, two candidates.
struct SphereSearch : TargetSearch {
  double radius_m = 0.0725;
  bool free_radius = false;  // the radius is a result, too; it moves the centre towards the scanner (physics.md §6)
  double radius_tolerance_m = 0.002;  // as office software has it: sets differ by that much
};
Result<TargetFit> findSphere(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& predicted,
                             const SphereSearch& search);
// The same from a centre that is known to a quarter of the radius.
Result<TargetFit> fitSphere(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& start,
                            const SphereSearch& search);

// Centre of a plate of two by two squares, white and black in turn: where its edges cross, by the intensities of the
// beams in the plane of its points. Errors as above, and: no intensity, no such pattern.
struct CheckerboardSearch : TargetSearch {
  double side_m = 0.15;
};
Result<TargetFit> findCheckerboard(std::span<const Eigen::Vector3d> points, std::span<const float> intensity,
                                   const Eigen::Vector3d& predicted, const CheckerboardSearch& search);

}  // namespace standpoint
