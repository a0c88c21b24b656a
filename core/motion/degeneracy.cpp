// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/degeneracy.h"

#include <algorithm>
#include <cmath>

#include "core/decompositions.h"

namespace standpoint {

namespace {

constexpr double kWorst = 5;
constexpr double kFewestReturned = 0.1;

}  // namespace

Eigen::Matrix3d degeneracy(const Eigen::Matrix3d& normals, double returned_fraction) {
  if (returned_fraction < kFewestReturned || !(normals.trace() > 0)) return kWorst * Eigen::Matrix3d::Identity();
  const PrincipalAxes principal = principalAxes(normals);
  const Eigen::Vector3d& values = principal.values;  // rising
  Eigen::Vector3d factors(kWorst, kWorst, 1);        // of a single wall
  for (int k = 0; k < 3 && values[1] > 1e-12 * values[2]; ++k)
    factors[k] = std::sqrt(std::clamp(values[1] / std::max(values[k], 1e-6 * values[1]), 1.0, kWorst * kWorst));
  return principal.axes * factors.asDiagonal() * principal.axes.transpose();
}

}  // namespace standpoint
