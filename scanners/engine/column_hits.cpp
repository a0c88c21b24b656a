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
                            VectorLanes& direction) {
  for (int k = 0; k < kPacket; ++k) {
    direction.x[k] = cosine[k] * ahead[0] + sine[k] * up[0];
    direction.y[k] = cosine[k] * ahead[1] + sine[k] * up[1];
    direction.z[k] = cosine[k] * ahead[2] + sine[k] * up[2];
  }
}

STANDPOINT_CLONES void round(const VectorLanes& from, float* x, float* y, float* z) {
  for (int k = 0; k < kPacket; ++k) {
    x[k] = static_cast<float>(from.x[k]);
    y[k] = static_cast<float>(from.y[k]);
    z[k] = static_cast<float>(from.z[k]);
  }
}

void roundOrigins(const RayLanes& lanes, RayPacket& rays) {
  round(lanes.origin, rays.origin_x, rays.origin_y, rays.origin_z);
}

// The axes across beams of a scanner that moves: horizontal and upward in the device's frame.
STANDPOINT_CLONES void turnAcross(const PoseLanes& poses, const double* sine, const double* cosine,
                                  const double* ahead_x, const double* ahead_y, BeamLanes& beams) {
  for (int k = 0; k < kPacket; ++k) {
    const double qx = poses.qx[k], qy = poses.qy[k], qz = poses.qz[k], qw = poses.qw[k];
    double x = ahead_y[k], y = -ahead_x[k], z = 0;
    turnBy(qx, qy, qz, qw, x, y, z);
    beams.across.x[k] = x, beams.across.y[k] = y, beams.across.z[k] = z;
    x = -sine[k] * ahead_x[k], y = -sine[k] * ahead_y[k], z = cosine[k];
    turnBy(qx, qy, qz, qw, x, y, z);
    beams.upward.x[k] = x, beams.upward.y[k] = y, beams.upward.z[k] = z;
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
  for (std::uint32_t row = 0; row < plan.settings.rows; ++row) elevations_rad_.push_back(plan.elevation_rad(row));
}

// Clockwise seen from above.
void ColumnHits::begin(std::uint32_t column) {
  column_ = column;
  if (moving_) return moving_->begin(column);
  plan_.clock.times(column, elevations_rad_, times_s_);
  double sine = 0, cosine = 0;
  portable::sinCos(plan_.azimuth_rad(column), sine, cosine);
  ahead_ = {cosine, -sine, 0};
  lateral_ = {-sine, -cosine, 0};
  const Pose& pose = plan_.start;
  still_ = {pose.translation, pose.rotation * ahead_, pose.rotation * lateral_,
            pose.rotation * Eigen::Vector3d::UnitZ()};
  for (std::uint32_t k = 0; k < kPacket; ++k) lanes_.origin.set(k, still_.origin);
  roundOrigins(lanes_, rays_);
}

void ColumnHits::trace(std::uint32_t column) {
  begin(column);
  for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket) traceRows(first);
}

void ColumnHits::traceRows(std::uint32_t first_row) {
  const int count = static_cast<int>(std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row));
  const RayLanes& lanes = axes(first_row);
  if (moving_) roundOrigins(lanes, rays_);
  round(lanes.direction, rays_.direction_x, rays_.direction_y, rays_.direction_z);
  if (scene_.moves())
    for (int k = 0; k < count; ++k) rays_.time_s[k] = bodiesTime_s(first_row + static_cast<std::uint32_t>(k));
  near_bodies_[first_row / kPacket].clear();
  scene_.intersect(rays_, count, static_cast<float>(plan_.farthest_m), facets_.data() + first_row,
                   ranges_.data() + first_row, &near_bodies_[first_row / kPacket]);
  if (!moving_) return;
  const std::uint32_t all = (1U << static_cast<unsigned>(count)) - 1;
  forLanes(all & ~moving_->measured(first_row), [&](std::uint32_t k) { facets_[first_row + k] = kNoFacet; });
}

double ColumnHits::bodiesTime_s(std::uint32_t row) const {
  return (moving_ ? plan_.motion->from_s + moving_->time_s(row) : times_s_[row]) + plan_.options.bodies_ahead_s;
}

const RayLanes& ColumnHits::axes(std::uint32_t first_row) {
  if (moving_) return moving_->axes(first_row);
  turn(plan_.cosine.data() + first_row, plan_.sine.data() + first_row, still_.ahead.data(), still_.up.data(),
       lanes_.direction);
  return lanes_;
}

RayLine ColumnHits::axis(std::uint32_t row) const {
  if (!moving_) return {still_.origin, plan_.cosine[row] * still_.ahead + plan_.sine[row] * still_.up};
  const RayLanes& axes = moving_->axes(row);
  return {axes.origin.at(row % kPacket), axes.direction.at(row % kPacket)};
}

std::uint32_t ColumnHits::measured(std::uint32_t first_row, std::uint32_t rows) const {
  const std::uint32_t lanes = (1U << rows) - 1;
  return moving_ ? lanes & moving_->measured(first_row) : lanes;
}

Beam ColumnHits::beam(std::uint32_t row) const {
  if (!moving_)
    return {still_.origin, plan_.cosine[row] * still_.ahead + plan_.sine[row] * still_.up, still_.across,
            plan_.cosine[row] * still_.up - plan_.sine[row] * still_.ahead};
  const RayLine line = axis(row);
  const Eigen::Quaterniond turn = moving_->localFromDevice(row).rotation(row % kPacket);
  const double sine = moving_->sines()[row], cosine = moving_->cosines()[row];
  Eigen::Vector3d upward = -sine * moving_->ahead(row);
  upward.z() = cosine;
  return {line.origin, line.direction, turn * moving_->lateral(row), turn * upward};
}

void ColumnHits::beams(std::uint32_t first_row, BeamLanes& beams) const {
  if (moving_) {
    beams.axes = moving_->axes(first_row);
    return turnAcross(moving_->localFromDevice(first_row), sines(first_row), cosines(first_row),
                      moving_->aheadX() + first_row, moving_->aheadY() + first_row, beams);
  }
  const std::uint32_t rows = std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row);
  for (std::uint32_t k = 0; k < rows; ++k) beams.set(k, beam(first_row + k));
}

}  // namespace standpoint
