// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/mesh.h"

namespace standpoint {

// Solid angle of a triangle seen from the origin, in steradians: positive where its corners run counter-clockwise seen
// from there (van Oosterom and Strackee 1983).
inline double solidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

// How often a surface goes round a place, by the sum of the solid angles: 1 inside a closed body whose faces look
// outwards, -1 where they look inwards, 0 outside, and some share where the surface has holes.
inline double windingNumber(const std::vector<Eigen::Vector3d>& positions, const std::vector<Triangle>& triangles,
                            const Eigen::Vector3d& place) {
  double sum = 0;
  for (const auto& t : triangles)
    sum += solidAngle(positions[t[0]] - place, positions[t[1]] - place, positions[t[2]] - place);
  return sum / (4 * std::numbers::pi);
}

}  // namespace standpoint
