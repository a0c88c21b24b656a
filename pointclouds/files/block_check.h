// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

#include "core/points.h"
#include "core/report.h"

namespace standpoint {

// Bounds of points, indices and labels of one block, for a writer that must know that they are what the header says.
struct BlockExtent {
  std::array<float, 3> low{}, high{};
  std::uint32_t row = 0, column = 0;  // largest
};

// Pose, limits and times are numbers.
Result<void> checkHeader(const ScanHeader& header);

// The block is not empty. An error says what in it breaks the promises of ScanHeader and PointBlock.
Result<BlockExtent> checkBlock(const ScanHeader& header, const PointBlock& block);

// What of a scan a format has a place for, beside coordinates and intensity.
struct Channels {
  bool colour = true, labels = false, time = false, channel = false, returns = false, truth = false, crs = false;
};
// Lists as a warning what the header has and the format has not.
void listUnheld(const ScanHeader& header, const char* format, const Channels& held, Report& report);

inline bool hasGrid(const ScanHeader& header) { return header.rows > 0 && header.columns > 0; }
inline bool hasIntensity(const ScanHeader& header) { return header.intensity_max > header.intensity_min; }

}  // namespace standpoint
