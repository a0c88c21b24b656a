// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/column_hits.h"

#include <algorithm>
#include <cmath>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// Directions cosine · ahead + sine · up of sixteen rows.
STANDPOINT_CLONES void turn(const double* cosine, const double* sine, const double* ahead, const double* up,
                            AxisLanes& lanes) {
  for (int k = 0; k < kPacket; ++k) {
    lanes.direction_x[k] = cosine[k] * ahead[0] + sine[k] * up[0];
    lanes.direction_y[k] = cosine[k] * ahead[1] + sine[k] * up[1];
    lanes.direction_z[k] = cosine[k] * ahead[2] + sine[k] * up[2];
  }
}

STANDPOINT_CLONES void roundOrigins(const AxisLanes& lanes, RayPacket& rays) {
  for (int k = 0; k < kPacket; ++k) {
    rays.origin_x[k] = static_cast<float>(lanes.origin_x[k]);
    rays.origin_y[k] = static_cast<float>(lanes.origin_y[k]);
    rays.origin_z[k] = static_cast<float>(lanes.origin_z[k]);
  }
}

STANDPOINT_CLONES void roundDirections(const AxisLanes& lanes, RayPacket& rays) {
  for (int k = 0; k < kPacket; ++k) {
    rays.direction_x[k] = static_cast<float>(lanes.direction_x[k]);
    rays.direction_y[k] = static_cast<float>(lanes.direction_y[k]);
    rays.direction_z[k] = static_cast<float>(lanes.direction_z[k]);
  }
}

}  // namespace

ColumnHits::ColumnHits(const ScanPlan& plan, TimedScene& scene)
    : plan_(plan),
      scene_(scene),
      facets_(plan.settings.rows + kPacket, kNoFacet),
      ranges_(plan.settings.rows + kPacket, static_cast<float>(plan.farthest_m)),
      near_bodies_(plan.settings.rows / kPacket + 1) {
  if (plan.moves()) {
    moving_ = std::make_unique<MovingColumn>(plan);
    return;
  }
  // As the packets have it.
  seen_ = std::make_unique<SeenFaces>(plan.start.translation.cast<float>().cast<double>());
  rays_.one_origin = true;
  rays_.seen = seen_.get();
}

// Clockwise seen from above.
void ColumnHits::begin(std::uint32_t column) {
  column_ = column;
  if (moving_) return moving_->begin(column);
  double sine = 0, cosine = 0;
  portable::sinCos(plan_.azimuth_rad(column), sine, cosine);
  ahead_ = {cosine, -sine, 0};
  lateral_ = {-sine, -cosine, 0};
  const Pose& pose = plan_.start;
  still_ = {pose.translation, pose.rotation * ahead_, pose.rotation * lateral_,
            pose.rotation * Eigen::Vector3d::UnitZ()};
  std::fill_n(lanes_.origin_x, kPacket, still_.origin.x());
  std::fill_n(lanes_.origin_y, kPacket, still_.origin.y());
  std::fill_n(lanes_.origin_z, kPacket, still_.origin.z());
  roundOrigins(lanes_, rays_);
}

void ColumnHits::trace(std::uint32_t column) {
  begin(column);
  for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket) traceRows(first);
}

void ColumnHits::traceRows(std::uint32_t first_row) {
  const int count = static_cast<int>(std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row));
  axes(first_row);
  if (moving_) roundOrigins(lanes_, rays_);
  roundDirections(lanes_, rays_);
  if (scene_.moves())
    for (int k = 0; k < count; ++k) rays_.time_s[k] = bodiesTime_s(first_row + static_cast<std::uint32_t>(k));
  near_bodies_[first_row / kPacket].clear();
  scene_.intersect(rays_, count, static_cast<float>(plan_.farthest_m), facets_.data() + first_row,
                   ranges_.data() + first_row, &near_bodies_[first_row / kPacket]);
  if (moving_)
    for (int k = 0; k < count; ++k)
      if (!moving_->pulse(first_row + static_cast<std::uint32_t>(k)).measured)
        facets_[first_row + static_cast<std::uint32_t>(k)] = kNoFacet;
}

double ColumnHits::bodiesTime_s(std::uint32_t row) const {
  const double since_first_s = moving_ ? plan_.motion->from_s + moving_->pulse(row).time_s
                                       : plan_.clock.time_s(column_, plan_.elevation_rad(row));
  return since_first_s + plan_.options.bodies_ahead_s;
}

const AxisLanes& ColumnHits::axes(std::uint32_t first_row) {
  if (!moving_) {
    turn(plan_.cosine.data() + first_row, plan_.sine.data() + first_row, still_.ahead.data(), still_.up.data(), lanes_);
    return lanes_;
  }
  for (std::uint32_t k = 0; k < std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row); ++k) {
    const Eigen::Vector3d &origin = moving_->origin(first_row + k), &direction = moving_->direction(first_row + k);
    lanes_.origin_x[k] = origin.x(), lanes_.direction_x[k] = direction.x();
    lanes_.origin_y[k] = origin.y(), lanes_.direction_y[k] = direction.y();
    lanes_.origin_z[k] = origin.z(), lanes_.direction_z[k] = direction.z();
  }
  return lanes_;
}

RayLine ColumnHits::axis(std::uint32_t row) const {
  if (moving_) return {moving_->origin(row), moving_->direction(row)};
  return {still_.origin, plan_.cosine[row] * still_.ahead + plan_.sine[row] * still_.up};
}

std::uint32_t ColumnHits::measured(std::uint32_t first_row, std::uint32_t rows) const {
  std::uint32_t lanes = (1U << rows) - 1;
  if (moving_)
    for (std::uint32_t k = 0; k < rows; ++k)
      if (!moving_->pulse(first_row + k).measured) lanes &= ~(1U << k);
  return lanes;
}

Beam ColumnHits::beam(std::uint32_t row) const {
  if (!moving_)
    return {still_.origin, plan_.cosine[row] * still_.ahead + plan_.sine[row] * still_.up, still_.across,
            plan_.cosine[row] * still_.up - plan_.sine[row] * still_.ahead};
  const Eigen::Quaterniond turn = moving_->localFromDevice(row).rotation;
  const double sine = moving_->sines()[row], cosine = moving_->cosines()[row];
  Eigen::Vector3d upward = -sine * moving_->ahead(row);
  upward.z() = cosine;
  return {moving_->origin(row), moving_->direction(row), turn * moving_->lateral(row), turn * upward};
}

}  // namespace standpoint
