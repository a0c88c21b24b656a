// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bench/collision_soup.h"
#include "optimizer/walk/doors.h"

namespace standpoint {

// Whether one comes through the door's own opening on a walkable surface: by flooding points a centimetre apart between
// its sides, from one end of the way to the other, with steps no higher than a stair's.
bool leadsThrough(const Mesh& walkable, const Passage& door, double radius_m);

// Whether the model has a floor under the whole of a straight way through the door, without steps that nobody climbs.
bool hasFloor(const Soup& model, const TriangleTree& tree, const Passage& door, double radius_m);

}  // namespace standpoint
