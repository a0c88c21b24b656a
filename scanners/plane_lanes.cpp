// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/plane_lanes.h"

#include <cmath>

#include "scanners/portable_math.h"
#include "scanners/target_clones.h"

namespace standpoint {

namespace {

// rangeOnPlane() in lanes.
STANDPOINT_CLONES void meet(const PlaneLanes& planes, const AxisLanes& axes, const float* hits_m,
                            ReturnLanes& returns) {
  for (int k = 0; k < kPacket; ++k) {
    const double slope = planes.normal_x[k] * axes.direction_x[k] + planes.normal_y[k] * axes.direction_y[k] +
                         planes.normal_z[k] * axes.direction_z[k];
    const double origin = planes.normal_x[k] * axes.origin_x[k] + planes.normal_y[k] * axes.origin_y[k] +
                          planes.normal_z[k] * axes.origin_z[k];
    const double on_plane = (planes.offset[k] - origin) / slope;
    const auto hit = static_cast<double>(hits_m[k]);
    const double range = std::abs(on_plane - hit) <= 1e-3 + 1e-4 * hit ? on_plane : hit;
    const auto steep = static_cast<float>(std::abs(slope));
    returns.range_m[k] = range;
    returns.signal.range_m[k] = static_cast<float>(range);
    returns.signal.cosine[k] = steep < 1 ? steep : 1;
    returns.place_x[k] = static_cast<float>(axes.origin_x[k] + range * axes.direction_x[k]);
    returns.place_y[k] = static_cast<float>(axes.origin_y[k] + range * axes.direction_y[k]);
    returns.place_z[k] = static_cast<float>(axes.origin_z[k] + range * axes.direction_z[k]);
  }
}

}  // namespace

std::uint32_t meetPlanes(const PlaneLanes& planes, const AxisLanes& axes, const float* hits_m, double min_range_m,
                         double max_range_m, ReturnLanes& returns) {
  meet(planes, axes, hits_m, returns);
  std::uint32_t within = 0;
  for (unsigned k = 0; k < kPacket; ++k)
    within |= static_cast<std::uint32_t>(returns.range_m[k] >= min_range_m && returns.range_m[k] <= max_range_m) << k;
  return within;
}

}  // namespace standpoint
