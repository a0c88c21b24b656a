// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/mesh.h"

namespace standpoint {

struct PolygonTriangles {
  std::vector<Triangle>
      triangles;  // corner numbers 0 … n − 1, turning as the polygon does; n − 2 of them unless corners coincide
  bool clean = true;  // false: the polygon crosses itself or has no area, so a fan stands for it
};

// In the plane of Newell's normal. Convex polygons become a fan, others are cut by geometry::triangulate(), which also
// takes those that touch themselves, as a hole does that a bridge joins to the outline.
PolygonTriangles triangulatePolygon(std::span<const Eigen::Vector3d> corners);

// The same with holes: ring after ring, the outer one first; `ring_ends` are past the last corner of each. Where the
// holes cannot be cut out, the outer ring stands without them and is not clean.
PolygonTriangles triangulateRings(std::span<const Eigen::Vector3d> corners, std::span<const std::size_t> ring_ends);

}  // namespace standpoint
