// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh.h"

namespace standpoint {

// Where a placed triangle looks to, unit; zero for a degenerate one. A mirroring placement turns the corners' order
// round.
inline Eigen::Vector3d placedNormal(const Mesh& mesh, const Triangle& triangle,
                                    const Eigen::Affine3d& world_from_mesh) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return world_from_mesh * mesh.positions[triangle[k]].cast<double>();
  };
  const Eigen::Vector3d a = corner(0);
  const Eigen::Vector3d cross = (corner(1) - a).cross(corner(2) - a);
  const double length = cross.norm();
  if (length == 0) return Eigen::Vector3d::Zero();
  return world_from_mesh.linear().determinant() < 0 ? Eigen::Vector3d(-cross / length)
                                                    : Eigen::Vector3d(cross / length);
}

inline double placedArea(const Mesh& mesh, const Triangle& triangle, const Eigen::Affine3d& world_from_mesh) {
  const auto corner = [&](int k) -> Eigen::Vector3d {
    return world_from_mesh * mesh.positions[triangle[k]].cast<double>();
  };
  return 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
}

}  // namespace standpoint
