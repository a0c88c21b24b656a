// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "scanners/instrument.h"

namespace standpoint {

// Light that comes back from one surface to the receiver.
struct Contribution {
  double range_m = 0;        // one way along the light's path, as the instrument measures it
  float x = 0;               // received power, radiometry.h
};

// What the receiver makes of the light that comes back from one pulse.
struct Echo {
  double range_m = 0;
  float x = 0;
  int strongest = 0;         // index of the contribution that gave most
  float spread_m = 0;        // from the nearest to the farthest contribution that went into it
};

// Time of flight (physics.md §4.4): contributions nearer to each other than c τ / 2.355 are one echo at the mean by power,
// others an echo each; of too many the strongest are kept. Phase shift (§4.3): all contributions add as phasors of the
// fine tone, the range is that of the strongest plus the phase of the sum. `contributions` is sorted by range on the way;
// echoes rise with range.
void receiveEchoes(const Waveform& waveform, std::vector<Contribution>& contributions, std::vector<int>& order,
                   std::vector<Echo>& echoes);

}  // namespace standpoint
