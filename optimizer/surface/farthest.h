// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "optimizer/surface/shape.h"
#include "optimizer/surface/triangle_tree.h"

namespace standpoint {

// One direction of a measurement: from points of `from` to what is nearest of `to`. Keeps references.
struct OneWaySurfaces {
  const Shape& from;
  const Shape& to;
  const TriangleTree& tree;  // of `to`
  // For triangles of `from` one of `to` that is near, or the largest number; or empty. It only makes the search faster.
  const std::vector<std::uint32_t>& counterpart;

  double squaredDistance(const Eigen::Vector3d& p, std::uint32_t triangle) const;  // of `to`
};

// The largest squared distance, at most 4 % (of the distance) below the truth but for pieces that are still in doubt
// when a triangle was divided a thousand times; or `known_squared`, if none is further. Where both together have more
// than 200 000 triangles, only vertices and middles of faces and edges are looked at. Parallel, the same for any number
// of threads.
double farthestSquared(const OneWaySurfaces& way, double known_squared);

// Of each triangle of `from` that has points further than that, the farthest that was found. Nothing where both
// together have more than 200 000 triangles.
std::vector<SurfacePoint> placesFurther(const OneWaySurfaces& way, double squared);

// Whether a point is further than that, with the same doubts; much faster, as most pieces cannot be.
bool isAnyFurther(const OneWaySurfaces& way, double squared);

}  // namespace standpoint
