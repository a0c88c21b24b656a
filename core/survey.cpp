// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/survey.h"

#include <algorithm>

#include "core/points.h"

namespace standpoint {

Pose inverse(const Pose& pose) {
  const Eigen::Quaterniond back = pose.rotation.conjugate();
  return {back, -(back * pose.translation)};
}

Pose at(const Trajectory& trajectory, double time_s) {
  const auto& times = trajectory.time_s;
  if (trajectory.pose.size() == 1 || time_s <= times.front()) return trajectory.pose.front();
  if (time_s >= times.back()) return trajectory.pose.back();
  const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
  const double fraction = (time_s - times[next - 1]) / (times[next] - times[next - 1]);
  const Pose& a = trajectory.pose[next - 1];
  const Pose& b = trajectory.pose[next];
  return {a.rotation.slerp(fraction, b.rotation), a.translation + fraction * (b.translation - a.translation)};
}

void PointBlock::clear() {
  for (auto* column_of_floats : {&x_m, &y_m, &z_m, &intensity, &truth.x_m, &truth.y_m, &truth.z_m, &truth.range_m,
                                 &truth.incidence_rad, &truth.received_db})
    column_of_floats->clear();
  for (auto* column_of_indices : {&row, &column, &product, &material}) column_of_indices->clear();
  for (auto* column_of_bytes : {&red, &green, &blue, &channel, &return_number, &return_count, &truth.flags})
    column_of_bytes->clear();
  time_s.clear();
}

}  // namespace standpoint
