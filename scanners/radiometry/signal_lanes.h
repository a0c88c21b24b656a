// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "scanners/radiometry/effects.h"
#include "scanners/radiometry/radiometry.h"
#include "scanners/radiometry/range_noise_law.h"

namespace standpoint {

constexpr int kSignalLanes = 16;

// Received power and range noise of sixteen returns at once; the same laws as in radiometry.h, in float.
struct SignalLanes {
  float range_m[kSignalLanes];                           // in
  float cosine[kSignalLanes];                            // in: of the incidence
  float diffuse[kSignalLanes], roughness[kSignalLanes];  // in: as in Optics
  float glint[kSignalLanes], steepness[kSignalLanes];    // in: F0 / 4m² and 1 / m²
  float gain[kSignalLanes];                              // in: two ways, of what lies between
  float variation[kSignalLanes];                         // in: of the material at this place
  float known_x[kSignalLanes];      // in: the power of an echo of several surfaces; below 0 where there is but one
  float background[kSignalLanes];   // in: variance that daylight adds to the dark receiver's, in its units
  float fluctuation[kSignalLanes];  // in: standard normal
  float equivalent[kSignalLanes];   // out: ρ_eq(θ)
  float x[kSignalLanes];            // out
  float intensity[kSignalLanes];    // out: 10 lg of x as measured, between the instrument's limits as 0..1, in its
                                    // levels; raw: falls with range
  float sigma_m[kSignalLanes];      // out: of the receiver
  float spread_m[kSignalLanes];     // out: σ of the range by speckle on a slanted surface
};

// How a measured amplitude strays, as a share of x: σ² = jitter² + ½ / (1 + K (D / R)²) + (dark / x)². The second is
// speckle: so many grains, K (D / R)² = A_receiver A_spot / (λ R)² with the beam's diameter D, lie side by side on the
// receiver's opening that their contrast averages to 1/√M (Goodman 2007, Speckle Phenomena in Optics, ch. 4), and a
// surface that is not smooth makes two independent patterns, one of each polarisation.
struct Fluctuation {
  bool any = false;  // whether the amplitude strays at all
  float jitter2 = 0;
  float speckle2 = 0;               // ½, or less where passes are averaged
  float grains = 0;                 // K
  float exit2_m2 = 0, spread2 = 0;  // D² = D0² + (γR)²
  float dark = 0;                   // σ of x without any light
  // The same grains move the centre of the footprint, and on a slanted surface the range: by first order in their
  // contrast σ² = (D / 2)² tan² θ / 8M, of a Gaussian beam of the diameter D (1/e²), whose square has a variance of
  // (D / 2)² / 8 across (docs/explanation/physics.md).
  bool slants = false;
};

// What an instrument makes of them. An effect that is off has the figure that does nothing.
struct Receiver {
  float near_range_m = 0;
  int near_range_power = 2;
  float near_curve_below_m = 0;  // instead, where there is one: nearRangePolynomial
  std::array<float, 4> near_curve{};
  float decay_per_m = 0;          // log2 of what the air leaves of two ways, negative
  float low_db = 0, high_db = 1;  // of the stored intensity
  float levels = 0;               // less one; 0 = stored as it is
  float noise_floor_m2 = 0, noise_shot_m2 = 0, noise_amplifier_m2 = 0;  // as in RangeNoiseParts
  Fluctuation fluctuation;
};

Receiver receiverOf(const Instrument& instrument, Effects effects, double extinction_per_m);

// `dark` is the σ of x that the receiver has without any light: that of the detection threshold.
Fluctuation fluctuationOf(const Instrument& instrument, Effects effects, double dark, int passes);

// σ of the range by speckle on a slanted surface, as the lanes have it.
double slantSpread_m(const Fluctuation& fluctuation, double range_m, double cosine);

void receive(SignalLanes& lanes, const Receiver& receiver);
// Only x, and 0 instead of its least.
void receivePower(SignalLanes& lanes, const Receiver& receiver, float* x);

}  // namespace standpoint
