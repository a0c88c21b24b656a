// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/plane_lanes.h"

#include <cmath>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// rangeOnPlane() in lanes.
STANDPOINT_CLONES std::uint32_t meet(const PlaneLanes& planes, const RayLanes& axes, const float* hits_m,
                                     double min_range_m, double max_range_m, ReturnLanes& returns) {
  std::uint64_t bits[kPacket];
  for (int k = 0; k < kPacket; ++k) {
    const double slope = planes.normal_x[k] * axes.direction.x[k] + planes.normal_y[k] * axes.direction.y[k] +
                         planes.normal_z[k] * axes.direction.z[k];
    const double origin = planes.normal_x[k] * axes.origin.x[k] + planes.normal_y[k] * axes.origin.y[k] +
                          planes.normal_z[k] * axes.origin.z[k];
    const double on_plane = (planes.offset[k] - origin) / slope;
    const auto hit = static_cast<double>(hits_m[k]);
    const double range = std::abs(on_plane - hit) <= 1e-3 + 1e-4 * hit ? on_plane : hit;
    const auto steep = static_cast<float>(std::abs(slope));
    returns.range_m[k] = range;
    const bool within = (range >= min_range_m) & (range <= max_range_m);
    bits[k] = within ? std::uint64_t{1} << static_cast<unsigned>(k) : 0;
    returns.signal.range_m[k] = static_cast<float>(range);
    returns.signal.cosine[k] = steep < 1 ? steep : 1;
    returns.place_x[k] = static_cast<float>(axes.origin.x[k] + range * axes.direction.x[k]);
    returns.place_y[k] = static_cast<float>(axes.origin.y[k] + range * axes.direction.y[k]);
    returns.place_z[k] = static_cast<float>(axes.origin.z[k] + range * axes.direction.z[k]);
  }
  std::uint64_t lanes = 0;
  for (int k = 0; k < kPacket; ++k) lanes |= bits[k];
  return static_cast<std::uint32_t>(lanes);
}

}  // namespace

std::uint32_t meetPlanes(const PlaneLanes& planes, const RayLanes& axes, const float* hits_m, double min_range_m,
                         double max_range_m, ReturnLanes& returns) {
  return meet(planes, axes, hits_m, min_range_m, max_range_m, returns);
}

}  // namespace standpoint
