// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "scanners/engine/footprint.h"
#include "scanners/engine/moving_column.h"
#include "scanners/engine/scan_plan.h"
#include "scanners/engine/timed_scene.h"

namespace standpoint {

// The beams of one column: where they start and what their axes meet first.
class ColumnHits {
 public:
  ColumnHits(const ScanPlan& plan, TimedScene& scene);
  void trace(std::uint32_t column);
  std::uint32_t column() const { return column_; }
  NearestHit hit(std::uint32_t row) const { return {facets_[row], ranges_[row]}; }
  // From a row on; there is a whole packet's worth, beyond the last row without a facet and at the longest range.
  const std::uint64_t* facets(std::uint32_t row) const { return facets_.data() + row; }
  const float* ranges_m(std::uint32_t row) const { return ranges_.data() + row; }
  RayLine axis(std::uint32_t row) const;
  // The same of sixteen rows from `first_row` on; good until others are asked for.
  const RayLanes& axes(std::uint32_t first_row);
  Beam beam(std::uint32_t row) const;
  void beams(std::uint32_t first_row, BeamLanes& beams) const;  // those of sixteen rows
  // When a row's pulse is sent, by the clock of what moves.
  double bodiesTime_s(std::uint32_t row) const;
  // The same by the scanner's clock, since its first pulse.
  double time_s(std::uint32_t row) const { return moving_ ? moving_->time_s(row) : times_s_[row]; }
  // What moves near the beams of sixteen rows from `first_row` on.
  const std::vector<NearBody>& nearBodies(std::uint32_t first_row) const { return near_bodies_[first_row / kPacket]; }
  // For other rays from about where the axes begin; null of a scanner that moves.
  SeenFaces* seen() const { return seen_.get(); }
  const MovingColumn* moving() const { return moving_.get(); }  // null of a scanner that stands
  // Those of `rows` rows from one on whose pulses are measured, as bits.
  std::uint32_t measured(std::uint32_t first_row, std::uint32_t rows) const;
  std::uint32_t pulses() const { return moving_ ? moving_->measured() : plan_.settings.rows; }
  // Of the directions in the scanner's frame, from a row on.
  const double* sines(std::uint32_t row) const { return (moving_ ? moving_->sines() : plan_.sine.data()) + row; }
  const double* cosines(std::uint32_t row) const { return (moving_ ? moving_->cosines() : plan_.cosine.data()) + row; }
  // Of a scanner that stands: horizontal unit vectors of its frame.
  const Eigen::Vector3d& ahead() const { return ahead_; }
  const Eigen::Vector3d& lateral() const { return lateral_; }

 private:
  struct Axes {
    Eigen::Vector3d origin, ahead, across, up;
  };
  void begin(std::uint32_t column);
  void traceRows(std::uint32_t first_row);

  const ScanPlan& plan_;
  TimedScene& scene_;
  std::uint32_t column_ = ~0U;
  Eigen::Vector3d ahead_, lateral_;  // up is the scanner's z
  Axes still_;                       // of a scanner that does not move
  RayLanes lanes_;                   // of the rows looked at last, of a scanner that does not move
  std::unique_ptr<SeenFaces> seen_;
  std::unique_ptr<MovingColumn> moving_;
  RayPacket rays_{};
  std::vector<double> elevations_rad_, times_s_;  // of the rows of a scanner that does not move
  std::vector<std::uint64_t> facets_;
  std::vector<float> ranges_;
  std::vector<std::vector<NearBody>> near_bodies_;
};

}  // namespace standpoint
