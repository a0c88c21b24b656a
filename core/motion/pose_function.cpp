// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/pose_function.h"

#include <algorithm>

#include "core/motion/rotation_vector.h"

namespace standpoint {

Velocity velocity(const PoseFunction& function, double time_s) {
  constexpr double kStep_s = 1e-4;
  const double from = std::max(time_s - kStep_s, std::min(function.first_s(), time_s));
  const double to = std::min(time_s + kStep_s, std::max(function.last_s(), time_s));
  if (!(to > from)) return {};
  const Pose before = function.pose(from), after = function.pose(to);
  return {(after.translation - before.translation) / (to - from),
          rotationVector(after.rotation * before.rotation.conjugate()) / (to - from)};
}

}  // namespace standpoint
