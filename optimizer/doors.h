// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "optimizer/optimizer.h"

namespace standpoint {

// For each product whether it is a door, or a part of one: these stand open and stop nobody.
std::vector<bool> belongsToDoor(const Environment& environment);

// Looks for a floor on both sides of each door and moves the agent's capsule through it, straight and with small offsets,
// between the collision shapes. What is wrong goes to the report.
std::vector<Door> checkDoors(const Environment& environment, const std::vector<CollisionShape>& shapes, const CollideOptions& options, Report& report);

}  // namespace standpoint
