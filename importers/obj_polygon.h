// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/mesh.h"

namespace standpoint {

struct PolygonTriangles {
  std::vector<Triangle> triangles;   // corner numbers 0 … n − 1, always n − 2 of them, turning as the polygon does
  bool clean = true;                 // false: the polygon crosses itself or has no area, so a fan stands for it
};

// Ear clipping (Meisters 1975) in the plane of Newell's normal; convex polygons become a fan. Time is bounded by a fixed
// number of steps for each corner.
PolygonTriangles triangulatePolygon(std::span<const Eigen::Vector3d> corners);

}  // namespace standpoint
