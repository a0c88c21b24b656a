// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"

namespace standpoint {

// What an IfcSpace takes up.
struct SpaceBody {
  std::uint32_t product = 0;
  std::vector<Eigen::Vector3d> corners;  // three for each triangle, local frame
  Bounds box;

  bool contains(const Eigen::Vector3d& p) const;
};

// Of all that have geometry and are not excluded.
std::vector<SpaceBody> spaceBodies(const Environment& environment);

// The product of the smallest one around p.
std::optional<std::uint32_t> spaceAt(std::span<const SpaceBody> spaces, const Eigen::Vector3d& p);

}  // namespace standpoint
