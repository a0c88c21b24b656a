// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scanners/engine/footprint.h"

namespace standpoint {

struct ScanPlan;

// Wings of the beam: a pedestal of the instrument's share of the power out to 8 w, in four rings of eight rays with
// equal power for equal area (physics.md §4.9). They matter where they meet a retroreflector beside the beam.
constexpr int kWingRays = 32;
const std::array<SubRay, kWingRays>& wingRays();  // weights add up to 1: times the pedestal

// Pulses whose wings may meet a retroreflector; empty where the scene has none, and of a scanner that moves.
class ReflectorHalo {
 public:
  explicit ReflectorHalo(const ScanPlan& plan);
  bool empty() const { return columns_.empty(); }
  bool reaches(std::uint32_t column, std::uint32_t row) const {
    for (const Rows& rows : columns_[column])
      if (row >= rows.from && row < rows.to) return true;
    return false;
  }

 private:
  struct Rows {
    std::uint32_t from, to;
  };
  void add(const ScanPlan& plan, const std::array<Eigen::Vector3d, 3>& corners);
  void mergeRows();

  std::vector<std::vector<Rows>> columns_;
};

}  // namespace standpoint
