// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "scanners/engine/beam_paths.h"
#include "scanners/noise/pulse_noise.h"
#include "scanners/radiometry/signal_lanes.h"
#include "scanners/radiometry/waveform.h"

namespace standpoint {

constexpr int kReturnLanes = kSignalLanes;
static_assert(kReturnLanes == kPacket && kReturnLanes == kNoiseLanes);

// Sixteen returns of one column side by side, on their way from surface to point. Lanes in which there is none are
// computed with the others, whatever they hold, and left out when points are written.
struct alignas(64) ReturnLanes {
  std::uint32_t row[kReturnLanes] = {};
  double cosine[kReturnLanes] = {}, sine[kReturnLanes] = {};  // of the row's elevation
  double range_m[kReturnLanes] = {};                          // as the light takes it, glass included
  float place_x[kReturnLanes] = {}, place_y[kReturnLanes] = {},
        place_z[kReturnLanes] = {};                                        // on the surface, local frame
  const Optics* optics[kReturnLanes] = {};                                 // whose figures `signal` has …
  float factor[kReturnLanes] = {};                                         // … with this factor
  float variation[kReturnLanes] = {}, texture_scale_m[kReturnLanes] = {};  // of the optics
  std::uint32_t product[kReturnLanes] = {}, material[kReturnLanes] = {};
  std::uint8_t red[kReturnLanes] = {}, green[kReturnLanes] = {}, blue[kReturnLanes] = {};
  std::uint8_t flags[kReturnLanes] = {};
  float deviation_m[kReturnLanes] = {};  // of an echo of several surfaces
  float normal_x[kReturnLanes] = {}, normal_y[kReturnLanes] = {},
        normal_z[kReturnLanes] = {};  // of the surface, towards the light; where there is daylight
  PulseNoise noise{};
  float along[kReturnLanes] = {}, wobble[kReturnLanes] = {};  // of the row
  SignalLanes signal;
  float x_m[kReturnLanes] = {}, y_m[kReturnLanes] = {}, z_m[kReturnLanes] = {};  // the point
  bool marked = false;  // a lane holds what only echoes and flags have

  ReturnLanes();
  // The rows from `first_row` on, a lane each, with the sines and cosines of their elevations.
  void begin(std::uint32_t first_row, const double* sines, const double* cosines);
  // `scale`: of the diffuse reflectance.
  void setOptics(int lane, const Optics& of, float scale);
  // The surface that the lanes `from` to `to` meet, but for where they do.
  void setSurface(const ScanPlan& plan, int from, int to, const MetFacet& met);
  void flag(int lane, std::uint8_t bits) {
    flags[lane] |= bits;
    marked = true;
  }
  void setEcho(const ScanPlan& plan, int lane, const PathEnd& end, const Echo& echo);
};

}  // namespace standpoint
