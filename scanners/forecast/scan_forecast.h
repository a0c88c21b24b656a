// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "scanners/forecast/expectation.h"
#include "scanners/forecast/surface_samples.h"

namespace standpoint {

// From when on a surface counts as seen.
struct SeenWhen {
  double max_spacing_m = 1e300;  // √ of the area for which one point stands
  double max_incidence_rad = 1.5708;
  double max_range_m = 1e300;
  bool operator==(const SeenWhen&) const = default;
};

// What a scan would bring, without scanning. `local_from_scanner` may lean.
struct ScanForecast {
  std::vector<std::uint8_t> seen;  // of each sample: it is exposed and would return points as wanted
  double points = 0;               // of the whole scan, one return of a pulse
  double seconds = 0;              // of the instrument, with its pictures
};
ScanForecast forecastScan(const Expectation& expectation, const Pose& local_from_scanner, const SurfaceSamples& samples,
                          const SeenWhen& wanted);

// Of each sample a 1 where it is exposed and would return points as wanted, else a 0.
std::vector<std::uint8_t> seenSamples(const Expectation& expectation, const Pose& local_from_scanner,
                                      const SurfaceSamples& samples, const SeenWhen& wanted);

// Would the place return points as wanted?
bool isSeen(const Expectation& expectation, const Pose& local_from_scanner, SurfacePlace place, const SeenWhen& wanted);

// √ of the area of a surface for which one point stands; `elevation_rad` is the beam's in the scanner's frame.
double spacingOf(const ScanSettings& settings, double range_m, double elevation_rad, double incidence_rad);
double spacingAt(const ScanSettings& settings, const Pose& local_from_scanner, const SurfacePlace& place);

}  // namespace standpoint
