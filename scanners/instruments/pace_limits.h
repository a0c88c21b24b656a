// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/instruments/instrument.h"

namespace standpoint {

// Above which a device tells whoever carries it to slow down; 0: it does not.
struct PaceLimits {
  double speed_mps = 0, turn_radps = 0;
  bool tooFast(double walks_mps) const { return speed_mps > 0 && walks_mps > speed_mps; }
  bool turnsTooFast(double turns_radps) const { return turn_radps > 0 && turns_radps > turn_radps; }
};

// Those of the instrument's file.
inline PaceLimits paceLimits(const Instrument& instrument) {
  if (!instrument.moving) return {};
  return {instrument.moving->most_speed_mps, instrument.moving->most_turn_radps};
}

}  // namespace standpoint
