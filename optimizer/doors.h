// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "optimizer/optimizer.h"

namespace standpoint {

// Where a door stands and which way leads through it.
struct Passage {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // on its lower edge
  Eigen::Vector3d through = Eigen::Vector3d::UnitX(), across = Eigen::Vector3d::UnitY();
  double half_depth = 0;
};

bool isDoor(const Product& product);

// Nothing when the product has no geometry.
std::optional<Passage> passageOf(const Environment& environment, std::uint32_t product);

// For each product whether it is a door, or a part of one: these stand open and stop nobody.
std::vector<bool> belongsToDoor(const Environment& environment);

// Looks for a floor on both sides of each door and moves the agent's capsule through it, straight and with small offsets,
// between the collision shapes. What is wrong goes to the report.
std::vector<Door> checkDoors(const Environment& environment, const std::vector<CollisionShape>& shapes, const CollideOptions& options, Report& report);

}  // namespace standpoint
