// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/moving_column.h"

#include <algorithm>
#include <cmath>

#include "core/portable_math.h"

namespace standpoint {

MovingColumn::MovingColumn(const ScanPlan& plan)
    : plan_(plan), placing_(*plan.motion, plan.settings.rotation_hz), pulses_(plan.settings.rows + kPacket) {
  for (auto* figures : {&sine_, &cosine_, &ahead_x_, &ahead_y_}) figures->assign(pulses_.size(), 0);
  origins_.assign(pulses_.size(), Eigen::Vector3d::Zero());
  directions_.assign(pulses_.size(), Eigen::Vector3d::UnitX());
}

void MovingColumn::begin(std::uint32_t column) {
  const ScanMotion& motion = *plan_.motion;
  column_ = column;
  setPulses();
  double first_s = pulses_[0].time_s, last_s = first_s;
  measured_ = 0;
  for (std::uint32_t row = 0; row < plan_.settings.rows; ++row) {
    Pulse& pulse = pulses_[row];
    if (!(motion.from_s + pulse.time_s < motion.to_s)) pulse.measured = false;
    measured_ += pulse.measured ? 1 : 0;
    first_s = std::min(first_s, pulse.time_s), last_s = std::max(last_s, pulse.time_s);
  }
  const double true_s = motion.from_s + motion.truth.clock_ahead_s;
  way_.sample(motion.true_pose, motion.truth.body_from_device, true_s + first_s, true_s + last_s);
  placing_.begin(first_s, last_s);
  for (std::uint32_t row = 0; row < plan_.settings.rows; ++row) {
    const Pulse& pulse = pulses_[row];
    const double x = pulse.direction.x(), y = pulse.direction.y();
    const double across = std::sqrt(x * x + y * y);
    sine_[row] = pulse.direction.z(), cosine_[row] = across;
    ahead_x_[row] = across > 0 ? x / across : 1, ahead_y_[row] = across > 0 ? y / across : 0;
    const Pose pose = localFromDevice(row);
    const Eigen::Matrix3d turned = pose.rotation.toRotationMatrix();
    origins_[row] = turned * pulse.origin + pose.translation;
    directions_[row] = turned * pulse.direction;
  }
}

void MovingColumn::setPulses() {
  if (plan_.pattern) {
    for (std::uint32_t row = 0; row < plan_.settings.rows; ++row)
      pulses_[row] = plan_.pattern->pulse(plan_.pattern->firingOf(column_, row), plan_.pattern->channelOf(row));
    return;
  }
  double sine = 0, cosine = 0;  // clockwise seen from above
  portable::sinCos(plan_.azimuth_rad(column_), sine, cosine);
  for (std::uint32_t row = 0; row < plan_.settings.rows; ++row) {
    pulses_[row].time_s = plan_.clock.time_s(column_, plan_.elevation_rad(row));
    pulses_[row].direction = {plan_.cosine[row] * cosine, -plan_.cosine[row] * sine, plan_.sine[row]};
    pulses_[row].channel = row;
    pulses_[row].measured = true;
  }
}

Pose MovingColumn::localFromDevice(std::uint32_t row) const {
  return way_.at(plan_.motion->from_s + plan_.motion->truth.clock_ahead_s + pulses_[row].time_s);
}

Eigen::Vector3d MovingColumn::placed(std::uint32_t row, const Eigen::Vector3d& from_origin) const {
  const Pulse& pulse = pulses_[row];
  const double firing_s = plan_.pattern ? plan_.pattern->firingTime_s(plan_.pattern->firingOf(column_, row)) : 0;
  return placing_.at(pulse.time_s, firing_s) * (pulse.origin + from_origin);
}

std::uint32_t MovingColumn::firing(std::uint32_t row) const {
  return plan_.pattern ? static_cast<std::uint32_t>(plan_.pattern->firingOf(column_, row)) : column_;
}

}  // namespace standpoint
