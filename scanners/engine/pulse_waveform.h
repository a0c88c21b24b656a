// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/engine/ray_engine.h"
#include "scanners/radiometry/waveform.h"

namespace standpoint {

// What a time-of-flight receiver gets of one pulse over time, without noise: P(r) = Σ x_k exp(-(r - r_k)² / 2s²),
// s = c τ / 2 over 2.355, of all that 64 rays of the beam meet, by panes and mirrors, too. Over surfaces of the pulse's
// own power, so that one surface has x at its maximum (radiometry.h).
struct PulseWaveform {
  double first_m = 0, bin_m = 0;  // the range of the first bin's middle, and from one to the next
  std::vector<double> power;
  std::vector<Echo> echoes;  // that the receiver makes of it, by range; `strongest` is of no use
};

struct WaveformRequest {
  double azimuth_rad = 0, elevation_rad = 0;  // clockwise from +X of the scanner's frame
  double bin_m = 0;                           // 0 = a twentieth of the pulse
};

constexpr std::size_t kMostWaveformBins = 1U << 20U;

// Of a pulse from `local_from_scanner`; weather is left out. A phase-shift instrument, and bins so narrow that there
// are more than kMostWaveformBins, are errors of usage.
Result<PulseWaveform> pulseWaveform(const RayScene& scene, const MaterialAssignment& assignment,
                                    const Instrument& instrument, const ScanSettings& settings,
                                    const Pose& local_from_scanner, const ScanOptions& options,
                                    const WaveformRequest& request);

}  // namespace standpoint
