// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh.h"
#include "optimizer/surface/triangle_distance.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

// Triangles in the local frame, with what each belongs to.
struct Soup {
  std::vector<Eigen::Vector3d> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> owner;

  void add(const Mesh& mesh, const Eigen::Affine3d& place, std::uint32_t owned_by) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const auto& p : mesh.positions) positions.push_back(place * p.cast<double>());
    for (const auto& t : mesh.triangles) {
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
      owner.push_back(owned_by);
    }
  }
  Corners corners(std::uint32_t i) const {
    return {positions[triangles[i][0]], positions[triangles[i][1]], positions[triangles[i][2]]};
  }
};

// Height of the uppermost triangle over or under p between the reaches.
inline double floorUnder(const Soup& soup, const TriangleTree& tree, const Eigen::Vector3d& p, double above,
                         double below) {
  double best = -1e300;
  tree.inBox(p - Eigen::Vector3d(1e-7, 1e-7, below), p + Eigen::Vector3d(1e-7, 1e-7, above), [&](std::uint32_t i) {
    const auto t = soup.corners(i);
    const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (std::abs(normal.z()) < 1e-12) return true;
    const auto side = [&](int a, int b) {
      return (t[b].x() - t[a].x()) * (p.y() - t[a].y()) - (t[b].y() - t[a].y()) * (p.x() - t[a].x());
    };
    const double s = side(0, 1), q = side(1, 2), r = side(2, 0);
    if (!((s >= 0 && q >= 0 && r >= 0) || (s <= 0 && q <= 0 && r <= 0))) return true;
    const double z = t[0].z() - ((p.x() - t[0].x()) * normal.x() + (p.y() - t[0].y()) * normal.y()) / normal.z();
    if (z <= p.z() + above && z >= p.z() - below) best = std::max(best, z);
    return true;
  });
  return best;
}

}  // namespace standpoint
