// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/body_winding.h"

#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

// Solid angle of a triangle seen from the origin, signed (van Oosterom and Strackee 1983).
double solidAngle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

double windingOf(const Environment& environment, const std::vector<std::uint32_t>& instances,
                 const Eigen::Vector3d& place) {
  double sum = 0;
  for (const auto i : instances) {
    const auto& instance = environment.instances[i];
    const auto& mesh = *environment.meshes[instance.mesh];
    std::vector<Eigen::Vector3d> around;  // the corners, seen from the place
    around.reserve(mesh.positions.size());
    for (const auto& p : mesh.positions) around.emplace_back(instance.world_from_mesh * p.cast<double>() - place);
    double angle = 0;
    for (const auto& t : mesh.triangles) angle += solidAngle(around[t[0]], around[t[1]], around[t[2]]);
    sum +=
        instance.world_from_mesh.linear().determinant() < 0 ? -angle : angle;  // a mirrored mesh is turned inside out
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace standpoint
