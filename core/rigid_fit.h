// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/result.h"
#include "core/survey.h"

namespace standpoint {

// The rigid motion that brings places in one frame to the same places in another (Umeyama 1991): targets of two scans,
// marks in a cloud and corners of a model. Each pair weighs the same. Coordinates may be as large as a national grid's.
struct RigidFit {
  Pose to_from;
  std::vector<double> residual_m;  // distance of each pair after the motion, in their order
  double rms_m = 0;
  // What a fit with a free scale would use. It is told, never applied: instruments and models do not stretch, units do.
  double scale = 1;
  double scale_sigma = 0;  // 1 σ by the residuals that this fit leaves; 0 when nothing is left over to judge by
  // Of the narrower frame's places: how far they spread across their longest line, as a share of it. Near 0, a turn
  // about that line is hardly held.
  double breadth = 0;
};

// Errors: fewer than three pairs, places that are not finite or not in the same number, places on one line.
Result<RigidFit> fitRigid(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to);

}  // namespace standpoint
