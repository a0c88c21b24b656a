// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include <Eigen/Core>

namespace standpoint {

// Places of points among other columns: x, y, z every `stride` floats.
struct PointPlaces {
  const float* first = nullptr;
  std::size_t count = 0, stride = 3;
};

// A cone around a line of sight, in the frame of the points; a cylinder where `per_metre` is 0.
struct SightCone {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), direction = Eigen::Vector3d::UnitX();  // unit
  double radius_m = 0, per_metre = 0;  // at the origin, and what it grows by along the direction
};

// The point in the cone that is met first; nothing where none is. `counts` says of a place in the frame of the points
// whether it is there at all; empty: all are.
std::optional<std::size_t> firstPoint(const PointPlaces& places, const SightCone& cone,
                                      const std::function<bool(const Eigen::Vector3d&)>& counts = {});

// Unit, the normal of the plane that the points within `radius_m` of `place` lie on; its sign is arbitrary. Nothing
// where they are too few, lie along a line, or stray from their plane by more than a twentieth of the radius (RMS).
std::optional<Eigen::Vector3d> normalAround(const PointPlaces& places, const Eigen::Vector3d& place, double radius_m);

}  // namespace standpoint
