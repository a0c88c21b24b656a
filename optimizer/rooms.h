// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "optimizer/optimizer.h"
#include "optimizer/walkable.h"

namespace standpoint {

// Which IfcSpaces have a floor to walk on, and which of them can be walked to: from the island of the walkable surface that
// leads into most rooms, and from every passable door between a room and the open, as far as it is not above the ground.
std::vector<Room> checkRooms(const Environment& environment, const Walkable& walkable, const std::vector<Door>& doors, Report& report);

}  // namespace standpoint
