// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "optimizer/optimizer.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

struct RoomCheck {
  std::vector<Room> rooms;
  std::set<std::uint32_t> reached_islands;  // of the walkable surface
};

// Which IfcSpaces have a floor to walk on, and which of them can be walked to: from behind every passable door between
// a room and the open, and from the island of the walkable surface that leads into most rooms, as far as these are not
// above the ground.
RoomCheck checkRooms(const Environment& environment, const Walkable& walkable, const std::vector<Door>& doors);

// What is wrong with them.
void reportRooms(const Environment& environment, const std::vector<Room>& rooms, Report& report);

}  // namespace standpoint
