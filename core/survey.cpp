// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/survey.h"

#include <algorithm>

#include "core/physical_material.h"
#include "core/points.h"

namespace standpoint {

Pose at(const Trajectory& trajectory, double time_s) {
  const auto& times = trajectory.time_s;
  if (trajectory.pose.size() == 1 || time_s <= times.front()) return trajectory.pose.front();
  if (time_s >= times.back()) return trajectory.pose.back();
  const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
  const double share = (time_s - times[next - 1]) / (times[next] - times[next - 1]);
  const Pose& a = trajectory.pose[next - 1];
  const Pose& b = trajectory.pose[next];
  return {a.rotation.slerp(share, b.rotation), a.translation + share * (b.translation - a.translation)};
}

void PointBlock::clear() {
  for (auto* column_of_floats : {&x_m, &y_m, &z_m, &intensity}) column_of_floats->clear();
  for (auto* column_of_indices : {&row, &column, &product, &material}) column_of_indices->clear();
  for (auto* column_of_bytes : {&red, &green, &blue}) column_of_bytes->clear();
}

double atWavelength(const std::vector<std::pair<double, double>>& table, double wavelength_nm) {
  if (table.empty()) return 0;
  if (wavelength_nm <= table.front().first) return table.front().second;
  if (wavelength_nm >= table.back().first) return table.back().second;
  const auto next = std::upper_bound(table.begin(), table.end(), wavelength_nm,
                                     [](double w, const auto& entry) { return w < entry.first; });
  const auto& [w0, r0] = *(next - 1);
  const auto& [w1, r1] = *next;
  return r0 + (r1 - r0) * (wavelength_nm - w0) / (w1 - w0);
}

std::int32_t materialOf(const MaterialAssignment& assignment, std::uint32_t product, std::uint32_t surface) {
  const auto less = [](const AssignedSurface& a, const std::pair<std::uint32_t, std::uint32_t>& key) {
    return std::pair(a.product, a.surface) < key;
  };
  const auto found = std::lower_bound(assignment.surfaces.begin(), assignment.surfaces.end(), std::pair(product, surface), less);
  if (found == assignment.surfaces.end() || found->product != product || found->surface != surface) return -1;
  return found->material;
}

}  // namespace standpoint
