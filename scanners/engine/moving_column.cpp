// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/moving_column.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// The parts of the directions in the device's frame.
STANDPOINT_CLONES void split(const VectorLanes& direction, double* sine, double* cosine, double* ahead_x,
                             double* ahead_y) {
  for (int k = 0; k < kPacket; ++k) {
    const double x = direction.x[k], y = direction.y[k], across = std::sqrt(x * x + y * y);
    sine[k] = direction.z[k], cosine[k] = across;
    ahead_x[k] = across > 0 ? x / across : 1, ahead_y[k] = across > 0 ? y / across : 0;
  }
}

// By the poses, as matrices.
STANDPOINT_CLONES void carry(const PoseLanes& poses, const RayLanes& device, RayLanes& local) {
  for (int k = 0; k < kPacket; ++k) {
    const double x = poses.qx[k], y = poses.qy[k], z = poses.qz[k], w = poses.qw[k];
    const double tx = 2 * x, ty = 2 * y, tz = 2 * z;
    const double twx = tx * w, twy = ty * w, twz = tz * w, txx = tx * x, txy = ty * x, txz = tz * x;
    const double tyy = ty * y, tyz = tz * y, tzz = tz * z;
    const double a[3] = {1 - (tyy + tzz), txy - twz, txz + twy};
    const double b[3] = {txy + twz, 1 - (txx + tzz), tyz - twx};
    const double c[3] = {txz - twy, tyz + twx, 1 - (txx + tyy)};
    const double ox = device.origin.x[k], oy = device.origin.y[k], oz = device.origin.z[k];
    local.origin.x[k] = dotOf(a[0], a[1], a[2], ox, oy, oz) + poses.translation.x[k];
    local.origin.y[k] = dotOf(b[0], b[1], b[2], ox, oy, oz) + poses.translation.y[k];
    local.origin.z[k] = dotOf(c[0], c[1], c[2], ox, oy, oz) + poses.translation.z[k];
    const double dx = device.direction.x[k], dy = device.direction.y[k], dz = device.direction.z[k];
    local.direction.x[k] = dotOf(a[0], a[1], a[2], dx, dy, dz);
    local.direction.y[k] = dotOf(b[0], b[1], b[2], dx, dy, dz);
    local.direction.z[k] = dotOf(c[0], c[1], c[2], dx, dy, dz);
  }
}

}  // namespace

MovingColumn::MovingColumn(const ScanPlan& plan) : plan_(plan), placing_(*plan.motion, plan.settings.rotation_hz) {
  const std::size_t packets = plan.settings.rows / kPacket + 1;
  PulseLanes at_rest;
  std::fill_n(at_rest.rays.direction.x, kPacket, 1);
  pulses_.assign(packets, at_rest);
  axes_.assign(packets, at_rest.rays);
  PoseLanes unturned;
  std::fill_n(unturned.qw, kPacket, 1);
  poses_.assign(packets, unturned);
  for (auto* figures : {&sine_, &cosine_, &ahead_x_, &ahead_y_}) figures->assign(packets * kPacket, 0);
}

std::uint32_t MovingColumn::rowsFrom(std::uint32_t first_row) const {
  return std::min<std::uint32_t>(kPacket, plan_.settings.rows - first_row);
}

void MovingColumn::begin(std::uint32_t column) {
  const ScanMotion& motion = *plan_.motion;
  column_ = column;
  setPulses();
  double first_s = pulses_[0].time_s[0], last_s = first_s;
  measured_ = 0;
  for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket) {
    PulseLanes& pulses = pulses_[first / kPacket];
    for (std::uint32_t k = 0; k < rowsFrom(first); ++k) {
      if (!(motion.from_s + pulses.time_s[k] < motion.to_s)) pulses.measured &= ~(1U << k);
      first_s = std::min(first_s, pulses.time_s[k]), last_s = std::max(last_s, pulses.time_s[k]);
    }
    measured_ += static_cast<std::uint32_t>(std::popcount(pulses.measured));
  }
  const double true_s = motion.from_s + motion.truth.clock_ahead_s;
  way_.sample(motion.true_pose, motion.truth.body_from_device, true_s + first_s, true_s + last_s);
  placing_.begin(first_s, last_s);
  for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket) {
    const std::uint32_t packet = first / kPacket;
    const PulseLanes& pulses = pulses_[packet];
    double times_s[kPacket];
    for (int k = 0; k < kPacket; ++k) times_s[k] = true_s + pulses.time_s[k];
    split(pulses.rays.direction, &sine_[first], &cosine_[first], &ahead_x_[first], &ahead_y_[first]);
    way_.at(times_s, (1U << rowsFrom(first)) - 1, poses_[packet]);
    carry(poses_[packet], pulses.rays, axes_[packet]);
  }
}

void MovingColumn::setPulses() {
  if (plan_.pattern) {
    for (std::uint32_t first = 0; first < plan_.settings.rows; first += kPacket)
      plan_.pattern->pulses(column_, first, pulses_[first / kPacket]);
    return;
  }
  double sine = 0, cosine = 0;  // clockwise seen from above
  portable::sinCos(plan_.azimuth_rad(column_), sine, cosine);
  for (std::uint32_t row = 0; row < plan_.settings.rows; ++row) {
    PulseLanes& pulses = pulses_[row / kPacket];
    const std::uint32_t lane = row % kPacket;
    pulses.time_s[lane] = plan_.clock.time_s(column_, plan_.elevation_rad(row));
    pulses.rays.direction.set(lane, {plan_.cosine[row] * cosine, -plan_.cosine[row] * sine, plan_.sine[row]});
    pulses.measured |= 1U << lane;
  }
}

Eigen::Vector3d MovingColumn::placed(std::uint32_t row, const Eigen::Vector3d& from_origin) const {
  const double firing_s = plan_.pattern ? plan_.pattern->firingTime_s(plan_.pattern->firingOf(column_, row)) : 0;
  return placing_.at(time_s(row), firing_s) * (pulses_[row / kPacket].rays.origin.at(row % kPacket) + from_origin);
}

std::uint32_t MovingColumn::firing(std::uint32_t row) const {
  return plan_.pattern ? static_cast<std::uint32_t>(plan_.pattern->firingOf(column_, row)) : column_;
}

}  // namespace standpoint
