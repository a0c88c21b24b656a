// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

namespace standpoint {

using Corners = std::array<Eigen::Vector3d, 3>;

// Smallest distance between two triangles; 0 where they meet.
double distance(const Corners& a, const Corners& b);

struct NearestPoints {
  Eigen::Vector3d first, second;
  double squaredDistance() const { return (first - second).squaredNorm(); }
};

// Of the segment p-q and of the triangle; nothing where the one passes through the other.
std::optional<NearestPoints> nearestPoints(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& triangle);

}  // namespace standpoint
