// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "optimizer/optimizer.h"
#include "optimizer/walk/walkable.h"

namespace standpoint {

// Which IfcSpaces have a floor to walk on, and which of them can be walked to: from behind every passable door between
// a room and the open, and from the island of the walkable surface that leads into most rooms, as far as these are not
// above the ground.
std::vector<Room> checkRooms(const Environment& environment, const Walkable& walkable, const std::vector<Door>& doors,
                             Report& report);

}  // namespace standpoint
