// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "emulated-ui/device/sounds.h"

namespace standpoint {

// The tones one after the other as samples of one channel at `rate_hz`. Each swells and fades within five milliseconds,
// so that none clicks; what is above half of the rate is silent.
std::vector<std::int16_t> samplesOf(std::span<const Beep> tones, int rate_hz);

}  // namespace standpoint
