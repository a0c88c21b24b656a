// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "core/random.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// What an instrument gets wrong in the same way all through a scan: the terms of a panoramic scanner's calibration
// (physics.md §3.3, after Lichti and Licht 2006 and NIST), hz and v as it turns and lifts its beam:
//   Δρ  = a0 + a1 ρ + a2 sin v + a3 sin(2πρ/L) + a4 cos(2πρ/L)     L: the fine tone of a phase-shift instrument
//   Δhz = ±(b1 sec v + b2 tan v) + b3 sin hz + b4 cos hz + b5 sin 2hz + b6 cos 2hz
//   Δv  = ±c0 + c1 cos v + c2 sin v + c3 cos 2v + c4 sin 2v
// b1 collimation, b2 trunnion axis, b3 to b6 and c1 to c4 eccentricity and encoder, c0 index; ± is - in the second
// face.
struct SystematicErrors {
  double offset_m = 0, scale = 1, lift_m = 0;                  // a0, 1 + a1, a2
  double cyclic_sine_m = 0, cyclic_cosine_m = 0, cycle_m = 0;  // a3, a4, L; 0 = no cycle
  double collimation_rad = 0, trunnion_rad = 0;                // b1, b2
  std::array<double, 4> azimuth_rad{};                         // b3 … b6
  double index_rad = 0;                                        // c0
  std::array<double, 4> elevation_rad{};                       // c1 … c4

  // One draw of each for a scan. Angles: all terms of one angle have the same σ, so that their sum has the sheet's
  // accuracy less the jitter (Δv everywhere, Δhz cos v at the horizon). Range: a0 and a1 as the sheet has them, a2, a3
  // and a4 a third of a0, which makes up for a3 and a4; nobody states shares (engineering).
  static SystematicErrors drawn(const Instrument& instrument, const RandomKey& key);

  // The part of Δρ that repeats with the fine tone.
  double cyclic_m(double range_m) const;
  double range_m(double range_m, double sine_v) const {
    return range_m * scale + offset_m + lift_m * sine_v + cyclic_m(range_m);
  }
  // Δhz without the terms of the face, of a column; times cos v it is the way across the beam.
  double azimuthError_rad(double hz_rad) const;
  // The face's part of Δhz cos v; `face` is 1 or -1.
  double faceLateral_rad(double face, double sine_v) const { return face * (collimation_rad + trunnion_rad * sine_v); }
  double elevationError_rad(double face, double sine_v, double cosine_v) const;
};

}  // namespace standpoint
