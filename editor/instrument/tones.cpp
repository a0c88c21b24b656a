// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/instrument/tones.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

constexpr double kPeak = 0.25 * 32767;
constexpr double kSwell_s = 0.005;

void append(std::vector<std::int16_t>& samples, const Beep& tone, int rate_hz) {
  const auto count = static_cast<std::size_t>(std::lround(tone.milliseconds / 1000 * rate_hz));
  const bool silent = tone.hertz <= 0 || tone.hertz >= 0.5 * rate_hz;
  const double swell = std::min(kSwell_s * rate_hz, 0.5 * static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto from_start = static_cast<double>(i), from_end = static_cast<double>(count - i);
    const double loudness = silent ? 0 : std::clamp(std::min(from_start, from_end) / swell, 0.0, 1.0);
    const double turns = tone.hertz * from_start / rate_hz;
    samples.push_back(
        static_cast<std::int16_t>(std::lround(kPeak * loudness * std::sin(2 * std::numbers::pi * turns))));
  }
}

}  // namespace

std::vector<std::int16_t> samplesOf(std::span<const Beep> tones, int rate_hz) {
  std::vector<std::int16_t> samples;
  for (const auto& tone : tones) append(samples, tone, rate_hz);
  return samples;
}

}  // namespace standpoint
