// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "optimizer/optimizer.h"
#include "optimizer/walk/doors.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

// Whether the surface leads through the door's own opening, and not around, from one end of an agent's way to the
// other.
bool leadsThrough(const Walkable& walkable, const Passage& passage, double radius_m);

// Says of each door whether the surface leads through it. The surface is found on a grid, so openings hardly wider than
// the agent are missing: where a sweep through a door is free, there is a floor under it and the surface is on both
// sides, it is joined by a strip a cell wide.
void joinThroughDoors(const Environment& environment, const std::vector<CollisionShape>& shapes,
                      const CollideOptions& options, std::vector<Door>& doors, Walkable& walkable, Report& report);

}  // namespace standpoint
