// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace standpoint {

// How much worse than usual a scanner that finds its way by surfaces does so along each direction. `normals` is the sum
// of n nᵀ over the surface normals of what it has just hit; along its eigenvectors the factor is √(λ of the middle one
// / λ), from 1 to 5: nothing faces the axis of a corridor. The result is symmetric, has these factors along these
// directions and the frame of the normals. Where less than a tenth of the pulses return, all are 5.
Eigen::Matrix3d degeneracy(const Eigen::Matrix3d& normals, double returned_fraction = 1);

}  // namespace standpoint
