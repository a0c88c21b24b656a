// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <limits>

#include "pointclouds/files/cloud_format.h"

namespace standpoint {

// Sinks that keep no points, only what they come to.

class PointCounter final : public PointSink {
 public:
  std::vector<ScanInfo> scans;
  Result<void> begin(const ScanHeader& header) override { return scans.push_back({header, 0}), Result<void>{}; }
  Result<void> write(const PointBlock& block) override { return scans.back().points += block.size(), Result<void>{}; }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
};

class IntensityRange final : public PointSink {
 public:
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock& block) override {
    for (const float value : block.intensity) add(value);
    return {};
  }
  void add(float value) { low = std::min(low, value), high = std::max(high, value); }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  // Formats that state no limits get those of the points; equal ones would say that there is no intensity.
  void putInto(ScanHeader& header) const {
    if (low > high) return;
    header.intensity_min = low;
    header.intensity_max = high > low ? high : low + 1;
  }
};

}  // namespace standpoint
