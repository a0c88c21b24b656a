// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include <Eigen/Core>

namespace standpoint {

using Corners = std::array<Eigen::Vector3d, 3>;

// Smallest distance between two triangles; 0 where they meet.
double distance(const Corners& a, const Corners& b);

}  // namespace standpoint
