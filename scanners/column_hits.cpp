// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/column_hits.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

ColumnHits::ColumnHits(const ScanPlan& plan)
    : plan_(&plan), facets_(plan.settings.rows + kPacket + 2 * kMostReach, kNoFacet), ranges_(plan.settings.rows + kPacket, 0) {}

// Clockwise seen from above.
void ColumnHits::trace(std::uint32_t column) {
  column_ = column;
  const double azimuth = plan_->azimuth_rad(column);
  ahead_ = {std::cos(azimuth), -std::sin(azimuth), 0};
  lateral_ = {-std::sin(azimuth), -std::cos(azimuth), 0};
  const Pose pose = at(plan_->trajectory, 0);
  still_ = {pose.translation, pose.rotation * ahead_, pose.rotation * lateral_, pose.rotation * Eigen::Vector3d::UnitZ()};
  RayPacket rays;
  NearestHit hits[kPacket];
  for (std::uint32_t first = 0; first < plan_->settings.rows; first += kPacket) {
    const int count = static_cast<int>(std::min<std::uint32_t>(kPacket, plan_->settings.rows - first));
    for (int k = 0; k < count; ++k) {
      const std::uint32_t row = first + static_cast<std::uint32_t>(k);
      const Axes axes = this->axes(row);
      const Eigen::Vector3d direction = plan_->cosine[row] * axes.ahead + plan_->sine[row] * axes.up;
      rays.origin_x[k] = static_cast<float>(axes.origin.x());
      rays.origin_y[k] = static_cast<float>(axes.origin.y());
      rays.origin_z[k] = static_cast<float>(axes.origin.z());
      rays.direction_x[k] = static_cast<float>(direction.x());
      rays.direction_y[k] = static_cast<float>(direction.y());
      rays.direction_z[k] = static_cast<float>(direction.z());
    }
    plan_->scene.intersect(rays, count, static_cast<float>(plan_->farthest_m), hits);
    for (int k = 0; k < count; ++k) {
      facets_[first + static_cast<std::uint32_t>(k) + kMostReach] = hits[k].facet;
      ranges_[first + static_cast<std::uint32_t>(k)] = hits[k].range_m;
    }
  }
}

ColumnHits::Axes ColumnHits::axes(std::uint32_t row) const {
  if (!plan_->moves()) return still_;
  const Pose pose = at(plan_->trajectory, plan_->clock.time_s(column_, plan_->elevation_rad(row)));
  return {pose.translation, pose.rotation * ahead_, pose.rotation * lateral_, pose.rotation * Eigen::Vector3d::UnitZ()};
}

RayLine ColumnHits::axis(std::uint32_t row) const {
  if (plan_->moves()) {
    const Beam moved = beam(row);
    return {moved.origin, moved.direction};
  }
  return {still_.origin, plan_->cosine[row] * still_.ahead + plan_->sine[row] * still_.up};
}

Beam ColumnHits::beam(std::uint32_t row) const {
  const Axes axes = this->axes(row);
  return {axes.origin, plan_->cosine[row] * axes.ahead + plan_->sine[row] * axes.up, axes.across,
          plan_->cosine[row] * axes.up - plan_->sine[row] * axes.ahead};
}

}  // namespace standpoint
