// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

namespace standpoint {

// The rotation by the smallest angle that takes the direction `from` to the direction `to`; both in one frame, of any
// length but zero. Of opposite directions it is half a turn about an axis across them. (Eigen's FromTwoVectors does the
// same by a singular-value decomposition, which costs each file that calls it several seconds of compiling.)
Eigen::Quaterniond shortestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace standpoint
