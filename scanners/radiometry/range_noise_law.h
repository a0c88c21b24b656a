// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/instruments/instrument.h"

namespace standpoint {

// σ of a range by received power x, with a floor (physics.md §3.1): σ² = floor + shot / x + amplifier / x². None of the
// three is negative, so σ never rises with power, whatever sent it back.
struct RangeNoiseParts {
  double floor_m2 = 0;      // what the instrument has in any light: clock, digitiser
  double shot_m2 = 0;       // of the light itself
  double amplifier_m2 = 0;  // of the dark receiver
};

// Where the sheet has figures at three powers or more, the parts that come nearest to all of them, by the least sum of
// squares of ln σ. Two powers give two parts, exactly: the floor and the one that limits the technology's class, which
// is the amplifier for phase shift and shot for time of flight. One power cannot tell these two apart: the range on
// white at which σ has risen to √2 of the floor is that of the file (noise_knee_m) or of the class, and at most half of
// the figure's variance falls with power.
RangeNoiseParts rangeNoiseParts(const Instrument& instrument);

double sigma_m(const RangeNoiseParts& parts, double x);

// x of a figure: of its reflectivity at its range, with the instrument's near range.
double powerOf(const Instrument& instrument, const RangeNoise& figure);

// noise_knee_m of the class, from the sheets of instruments with several figures (docs/reference/instruments.md).
double classNoiseKnee_m(const Instrument& instrument);

}  // namespace standpoint
