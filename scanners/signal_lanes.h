// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/radiometry.h"

namespace standpoint {

constexpr int kSignalLanes = 16;

// Received power and range noise of sixteen returns at once; the same law as RangeNoiseLaw::sigma, in float.
struct SignalLanes {
  float range_m[kSignalLanes];      // in
  float equivalent[kSignalLanes];   // in: ρ_eq(θ)
  float gain[kSignalLanes];         // in: two-way transmittance of what lies between
  float x[kSignalLanes];            // out
  float log2_x[kSignalLanes];       // out
  float sigma_m[kSignalLanes];      // out
};

void receive(SignalLanes& lanes, const Instrument& instrument, const RangeNoiseLaw& law);

}  // namespace standpoint
