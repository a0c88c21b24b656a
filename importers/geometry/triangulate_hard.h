// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "importers/geometry/polygon.h"

namespace standpoint::geometry {

// Constrained Delaunay triangulation of an outer loop (the first) and holes, which may touch themselves and each other.
// Points of `inner` become corners, too; they lie inside and off the loops. Appends nothing and returns false when
// loops cross.
bool triangulateHard(std::span<const Eigen::Vector3d> points, const std::vector<std::vector<std::uint32_t>>& loops,
                     std::span<const std::uint32_t> inner, const Projection& projection,
                     std::vector<Triangle>& triangles);

}  // namespace standpoint::geometry
