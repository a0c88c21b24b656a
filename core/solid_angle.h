// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace standpoint {

// Solid angle of a triangle seen from the origin, in steradians: positive where its corners run counter-clockwise seen
// from there (van Oosterom and Strackee 1983). Divided by 4π and summed over a closed surface it is the winding number.
inline double solidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace standpoint
