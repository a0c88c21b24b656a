// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/engine/column_hits.h"
#include "scanners/engine/return_lanes.h"

namespace standpoint {

// The receiver of one column's returns: which of them are detected, and where the instrument believes them to be.
class PointLanes {
 public:
  explicit PointLanes(const ScanPlan& plan);
  void begin(const ColumnHits& column);
  // Range noise along the column and the mirror's wobble of the rows from a multiple of sixteen on, a lane each.
  void drawRows(std::uint32_t first_row, ReturnLanes& returns) const;
  // The same for one more return of a pulse, which has a lane in `first`.
  void drawFurther(const ReturnLanes& first, int pulse, NoiseChannel channel, ReturnLanes& returns, int lane) const;
  // From what is met to the points, in the scanner's frame, or that of a motion; the lanes detected of the first
  // `count` are the bits of the result.
  std::uint32_t receive(ReturnLanes& returns, int count) const;

  // Constant, but for a rise over `width` from `from` on.
  struct Ramp {
    float from = 0, width = 0, slope = 0;
  };

  // What all lanes of a column share.
  struct Figures {
    double ahead_x = 1, ahead_y = 0, lateral_x = 0, lateral_y = -1;
    double jitter_rad = 0;
    double lateral_rad = 0, azimuth_rad = 0;  // that does not, and that does shrink towards the zenith
    double trunnion_rad = 0;                  // that grows towards it
    double lift_rad = 0, lift_by_wobble_rad = 0;
    double lift_cosine_rad = 0, lift_sine_rad = 0, lift_cosine2_rad = 0, lift_sine2_rad = 0;  // of v and 2v
    double scale = 1, bias_m = 0, bias_sine_m = 0;
    double noise_scale = 0, white_fraction = 0, along_fraction = 0, common = 0;
    double extra_m = 0, wobble_m = 0;
    Ramp offset[kMostOffsets];  // of the range, by log2 of the power: what the table has, and the walk above saturation
    float least_offset_m = 0;
  };

 private:
  void setOffsets();
  std::uint32_t detected(const ReturnLanes& returns, int count) const;
  bool faulted(const ReturnLanes& returns, int lane, const PointFilters& filters) const;
  std::uint32_t filtered(ReturnLanes& returns, std::uint32_t lanes) const;
  void foldBack(ReturnLanes& returns) const;
  void moveBack(ReturnLanes& returns, int count) const;

  const ScanPlan& plan_;
  std::uint32_t column_ = 0;
  Figures figures_;
  std::vector<float> along_;
  const MovingColumn* moving_ = nullptr;
};

}  // namespace standpoint
