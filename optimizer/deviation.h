// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/random.h"
#include "optimizer/shape.h"

namespace standpoint {

struct SurfacePoint {
  std::uint32_t triangle = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

// One point per equal share of the area, at a random place in its triangle. The same key gives the same points.
std::vector<SurfacePoint> pointsByArea(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles,
                                       std::uint32_t count, const RandomKey& key);

struct Deviation {
  double max_m = 0;   // sampled symmetric Hausdorff distance
  double mean_m = 0;  // mean of the two directions' area-weighted means
  double area_m2 = 0; // of the shape before
};

// Measures how far two shapes with the same centre are apart: `samples` points spread by area on each, and every vertex
// for the maximum, each against the other's nearest triangle. An empty `after` counts as its centre: a dropped shape.
// `image` is replay()'s: it only makes the search faster.
Deviation measureDeviation(const Shape& before, const Shape& after, const std::vector<std::uint32_t>& image, std::uint32_t samples,
                           std::uint64_t seed);

}  // namespace standpoint
