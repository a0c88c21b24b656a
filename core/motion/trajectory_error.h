// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/motion/error_profiles.h"
#include "core/motion/pose_function.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// Where the error of a trajectory takes its steps: at most 0.25 m and 0.25 s apart.
struct ErrorKnot {
  double time_s = 0;
  Pose pose;         // of the path
  double way_m = 0;  // since the first knot
  // Of the way to here from the knot before (core/motion/degeneracy.h), local frame.
  Eigen::Matrix3d degeneracy = Eigen::Matrix3d::Identity();
};
// Along a path as it is without gait and shaking, which are no way. A longer path has the knots of a shorter one that
// it begins with, but for the last two of that. An error where it has no end, or would take more than a million knots.
Result<std::vector<ErrorKnot>> errorKnots(const PoseFunction& path);

// What holds a trajectory: at a time it was where it had been at another one (a loop closure), or where it is known to
// be (a control point, a static station). Of the nearest knots.
struct MotionConstraint {
  double time_s = 0;
  std::optional<double> same_as_s = {};        // the other time of a closure, earlier
  double position_sigma_m = 0.003;             // of each axis
  std::optional<double> angle_sigma_rad = {};  // of each axis; none: of the position alone
};

struct KnotError {  // solved less true, local frame
  double time_s = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  // solved rotation = rotation by this · true rotation
};

struct SolvedTrajectory {
  PoseFunctionPtr pose;           // costs some microseconds: sampled() of core/motion/gait.h gives one for each pulse
  std::vector<KnotError> errors;  // at the knots, without the shaking within a scan
};

// The trajectory that the surveyor would know, for a true one (mobile.md §4.3, §4.4).
//
// From knot to knot, Δp apart, the errors of position e and of rotation φ go on as
//   e += φ × Δp + scale Δp + drift √Δs · degeneracy · n,   φ_z += heading √Δs (1 + (ω / 60°/s)²) n,
// roll and pitch as Gauss-Markov processes, so that height drifts through them and ω is the turn rate; with GNSS all
// are Gauss-Markov processes in time. The n are increments of seekable walks, keyed by (seed, trajectory): without
// constraints the error at a time is the same however much longer the path is.
//
// Constraints are linear in these errors, and met with noise of their sigmas by the linear correction that makes an
// exact conditional draw of them (Matheron): x - K Cᵀ (C K Cᵀ + Σ)⁻¹ (C x + ν), K being the covariance of the open
// trajectory, which is applied along the knots and never built. O(constraints · knots + constraints³); at most 600.
// Poses are moved, points never. `truth` may carry the gait that the knots' path has not.
Result<SolvedTrajectory> solveTrajectory(PoseFunctionPtr truth, std::span<const ErrorKnot> knots,
                                         const ErrorProfile& profile, std::span<const MotionConstraint> constraints,
                                         std::uint64_t seed, std::uint32_t trajectory, Progress& progress);

struct ExpectedError {  // standard deviations, local frame, without the shaking within a scan
  double time_s = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();
};

// How large the errors of such a trajectory are over all seeds, in closed form, at up to `places` of its knots that lie
// evenly, the first and the last among them: before anything is walked, or to colour what was.
Result<std::vector<ExpectedError>> expectedErrors(std::span<const ErrorKnot> knots, const ErrorProfile& profile,
                                                  std::span<const MotionConstraint> constraints, Progress& progress,
                                                  std::size_t places = 400);

}  // namespace standpoint
