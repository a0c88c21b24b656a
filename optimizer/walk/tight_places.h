// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/progress.h"
#include "optimizer/optimizer.h"
#include "optimizer/walk/obstacles.h"
#include "optimizer/walk/rooms.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

inline constexpr double kLowestBody = 1.2;  // m, as low as somebody walks who crouches

// What an agent of some size can walk on, pass through and get to.
struct WalkedWorld {
  Walkable walkable;
  std::vector<Door> doors;
  RoomCheck rooms;
  Report report;
};

// `overhead`: as walkableSurface has it.
Result<WalkedWorld> walkedWorld(const Environment& environment, const std::vector<CollisionShape>& shapes,
                                const std::vector<bool>& overhead, const CollideOptions& options, Progress& progress);

// For each room of `world` that is not reached and that a smaller body gets to: the widest one of the agent's radius,
// 0.25 m and 0.20 m, the tallest of these in steps of 0.1 m from 1.9 m to 1.2 m, and the place that keeps a larger one
// out. It is the lowest on the way that the smaller body gains.
Result<void> findTightPlaces(const Environment& environment, const std::vector<CollisionShape>& shapes,
                             const std::vector<bool>& overhead, const CollideOptions& options, WalkedWorld& world,
                             Progress& progress);

}  // namespace standpoint
