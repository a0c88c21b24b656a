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

  const Pulse& pulse(std::uint32_t row) const { return pulses_[row]; }
  std::uint32_t measured() const { return measured_; }  // how many of the pulses
  std::uint32_t firing(std::uint32_t row) const;        // its number, modulo 2^32; of a grid the column
  // Of the directions in the device's frame.
  const double* sines() const { return sine_.data(); }
  const double* cosines() const { return cosine_.data(); }
  // Horizontal unit vectors of the device's frame: along the direction, and to its right.
  Eigen::Vector3d ahead(std::uint32_t row) const { return {ahead_x_[row], ahead_y_[row], 0}; }
  Eigen::Vector3d lateral(std::uint32_t row) const { return {ahead_y_[row], -ahead_x_[row], 0}; }
  // As it truly is, local frame.
  Pose localFromDevice(std::uint32_t row) const;
  const Eigen::Vector3d& origin(std::uint32_t row) const { return origins_[row]; }
  const Eigen::Vector3d& direction(std::uint32_t row) const { return directions_[row]; }
  // In the points' frame what the device sees at `from_origin` of the pulse's origin.
  Eigen::Vector3d placed(std::uint32_t row, const Eigen::Vector3d& from_origin) const;

 private:
  void setPulses();

  const ScanPlan& plan_;
  std::uint32_t column_ = 0, measured_ = 0;
  PoseWindow way_;
  PointPlacing placing_;
  std::vector<Pulse> pulses_;
  std::vector<double> sine_, cosine_, ahead_x_, ahead_y_;
  std::vector<Eigen::Vector3d> origins_, directions_;
};

}  // namespace standpoint
