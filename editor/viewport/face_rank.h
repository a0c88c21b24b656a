// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"

namespace standpoint {

// Models have faces of several products in one plane, as the side of a slab in that of a wall. Depths alone would
// show either, pixel by pixel and in each picture another; so what fills and finishes is seen before walls, these
// before slabs and roofs, these before their frame, and the ground last.
inline constexpr int kFaceRanks = 5;
int faceRank(const Product& product);  // 0 is seen before all others

// How far behind rank 0 it is drawn, as Layer::drawSurface() counts: some 2 mm at 10 m in a room, and less from
// outside.
double depthOffsetOf(int rank);

}  // namespace standpoint
