// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/effects.h"
#include "scanners/radiometry.h"

namespace standpoint {

constexpr int kSignalLanes = 16;

// Received power and range noise of sixteen returns at once; the same laws as in radiometry.h, in float.
struct SignalLanes {
  float range_m[kSignalLanes];      // in
  float cosine[kSignalLanes];       // in: of the incidence
  float diffuse[kSignalLanes], oren_a[kSignalLanes], oren_b[kSignalLanes];   // in: as in Optics
  float glint[kSignalLanes], steepness[kSignalLanes];                        // in: F0 / 4m² and 1 / m²
  float gain[kSignalLanes];         // in: two ways, of what lies between
  float variation[kSignalLanes];    // in: of the material at this place
  float known_x[kSignalLanes];      // in: the power of an echo of several surfaces; below 0 where there is but one
  float equivalent[kSignalLanes];   // out: ρ_eq(θ)
  float x[kSignalLanes];            // out
  float intensity[kSignalLanes];    // out: 10 lg x between the instrument's limits as 0..1, in its levels; raw: falls with range
  float sigma_m[kSignalLanes];      // out
};

// What an instrument makes of them. An effect that is off has the figure that does nothing.
struct Receiver {
  float near_range_m = 0;
  int near_range_power = 2;
  float decay_per_m = 0;            // log2 of what the air leaves of two ways, negative
  float low_db = 0, high_db = 1;    // of the stored intensity
  float levels = 0;                 // less one; 0 = stored as it is
  const RangeNoiseLaw::Curve* curves = nullptr;
  int curve_count = 0;
};

// `law` must outlive it.
Receiver receiverOf(const Instrument& instrument, const RangeNoiseLaw& law, Effects effects, double extinction_per_m);

void receive(SignalLanes& lanes, const Receiver& receiver);

}  // namespace standpoint
