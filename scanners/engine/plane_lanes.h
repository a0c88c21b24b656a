// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/engine/column_hits.h"
#include "scanners/engine/return_lanes.h"

namespace standpoint {

// The planes that the axes of sixteen rows meet, and where: in double, so that a range does not suffer from the float
// BVH.
struct alignas(64) PlaneLanes {
  double normal_x[kPacket] = {}, normal_y[kPacket] = {}, normal_z[kPacket] = {}, offset[kPacket] = {};

  void set(int from, int to, const Facet& facet) {
    for (int k = from; k < to; ++k) {
      normal_x[k] = facet.normal.x(), normal_y[k] = facet.normal.y(), normal_z[k] = facet.normal.z();
      offset[k] = facet.offset;
    }
  }
};

// Gives the lanes their range, incidence and place; `hits_m` are the ranges of the float BVH. The lanes with a range
// between the limits are the bits of the result.
std::uint32_t meetPlanes(const PlaneLanes& planes, const RayLanes& axes, const float* hits_m, double min_range_m,
                         double max_range_m, ReturnLanes& returns);

}  // namespace standpoint
