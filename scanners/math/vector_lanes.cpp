// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/math/vector_lanes.h"

#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

STANDPOINT_CLONES void turnBack(const PoseLanes& poses, const VectorLanes& from, VectorLanes& to) {
  for (int k = 0; k < kPacket; ++k) {
    double x = from.x[k], y = from.y[k], z = from.z[k];
    turnBy(-poses.qx[k], -poses.qy[k], -poses.qz[k], poses.qw[k], x, y, z);
    to.x[k] = x, to.y[k] = y, to.z[k] = z;
  }
}

STANDPOINT_CLONES void moveBack(const VectorLanes& from, const VectorLanes& by, VectorLanes& to) {
  for (int k = 0; k < kPacket; ++k) {
    to.x[k] = from.x[k] - by.x[k];
    to.y[k] = from.y[k] - by.y[k];
    to.z[k] = from.z[k] - by.z[k];
  }
}

}  // namespace

void placesAtRest(const PoseLanes& poses, const VectorLanes& places, VectorLanes& at_rest) {
  VectorLanes moved;
  moveBack(places, poses.translation, moved);
  turnBack(poses, moved, at_rest);
}

void directionsAtRest(const PoseLanes& poses, const VectorLanes& directions, VectorLanes& at_rest) {
  turnBack(poses, directions, at_rest);
}

}  // namespace standpoint
