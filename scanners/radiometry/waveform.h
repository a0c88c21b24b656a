// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/instruments/instrument.h"

namespace standpoint {

// Light that comes back from one surface to the receiver.
struct Contribution {
  double range_m = 0;  // one way along the light's path, as the instrument measures it
  float x = 0;         // received power, radiometry.h
  int index = 0;       // by which it is told from the others of its pulse
};

// Whether the sum of two Gaussians, `distance` times 2σ apart, has two maxima: |ln (x1 / x2)| below
// 2 ln(d - √(d² - 1)) + 2 d √(d² - 1) (de Helguero 1904; Holzmann and Vollmer 2008, AStA 92:57).
bool standApart(double distance, double power_ratio);

// What the receiver makes of the light that comes back from one pulse.
struct Echo {
  double range_m = 0;
  float x = 0;
  int strongest = 0;      // `index` of the contribution that gave most
  float spread_m = 0;     // from the nearest to the farthest contribution that went into it
  float deviation_m = 0;  // σ of their ranges, by power
};

// Time of flight (physics.md §4.4): contributions nearer to each other than c τ / 2.355 = 2σ are one echo at the mean
// by power, and so are groups of unlike power farther apart as long as their sum has one maximum only; others are an
// echo each; of too many the strongest are kept. Phase shift (§4.3): all contributions add as phasors of the fine tone,
// the range is that of the strongest plus the phase of the sum. `contributions` is sorted by range and index on the
// way, and what sends nothing back leaves it; echoes rise with range.
void receiveEchoes(const Waveform& waveform, std::vector<Contribution>& contributions, std::vector<Echo>& echoes);

}  // namespace standpoint
