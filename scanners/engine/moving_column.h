// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/point_placing.h"
#include "scanners/engine/scan_plan.h"

namespace standpoint {

// The pulses of one column of a scanner that moves: where they start and where they go, and where their points are
// placed. A column is a block of the pattern, or one of a tripod's grid that is carried. A row is a pulse.
class MovingColumn {
 public:
  explicit MovingColumn(const ScanPlan& plan);
  void begin(std::uint32_t column);

  // Of the row's pulse, since the first firing.
  double time_s(std::uint32_t row) const { return pulses_[row / kPacket].time_s[row % kPacket]; }
  std::uint32_t channel(std::uint32_t row) const { return plan_.pattern ? plan_.pattern->channelOf(row) : row; }
  std::uint32_t measured() const { return measured_; }  // how many of the pulses
  // Of the sixteen rows from `first_row` on, as bits.
  std::uint32_t measured(std::uint32_t first_row) const { return pulses_[first_row / kPacket].measured; }
  std::uint32_t firing(std::uint32_t row) const;  // its number, modulo 2^32; of a grid the column
  // Of the directions in the device's frame.
  const double* sines() const { return sine_.data(); }
  const double* cosines() const { return cosine_.data(); }
  // Horizontal unit vectors of the device's frame: along the direction, and to its right.
  const double* aheadX() const { return ahead_x_.data(); }
  const double* aheadY() const { return ahead_y_.data(); }
  Eigen::Vector3d ahead(std::uint32_t row) const { return {ahead_x_[row], ahead_y_[row], 0}; }
  Eigen::Vector3d lateral(std::uint32_t row) const { return {ahead_y_[row], -ahead_x_[row], 0}; }
  // Axes of the beams of sixteen rows from `first_row` on, and where the device is meanwhile; local frame.
  const RayLanes& axes(std::uint32_t first_row) const { return axes_[first_row / kPacket]; }
  const PoseLanes& localFromDevice(std::uint32_t first_row) const { return poses_[first_row / kPacket]; }
  // In the points' frame what the device sees at `from_origin` of the pulse's origin.
  Eigen::Vector3d placed(std::uint32_t row, const Eigen::Vector3d& from_origin) const;

 private:
  void setPulses();
  std::uint32_t rowsFrom(std::uint32_t first_row) const;  // sixteen, or what is left of them

  const ScanPlan& plan_;
  std::uint32_t column_ = 0, measured_ = 0;
  PoseWindow way_;
  PointPlacing placing_;
  std::vector<PulseLanes> pulses_;  // sixteen rows each, as these
  std::vector<PoseLanes> poses_;
  std::vector<RayLanes> axes_;
  std::vector<double> sine_, cosine_, ahead_x_, ahead_y_;
};

}  // namespace standpoint
