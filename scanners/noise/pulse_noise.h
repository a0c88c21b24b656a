// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "core/random.h"

namespace standpoint {

// What a Philox block is for: one channel each.
enum class NoiseChannel : std::uint32_t { pulse = 0, scan = 1 };

constexpr int kNoiseLanes = 16;

// Four independent standard normal numbers for each of sixteen consecutive pulses of a column.
struct PulseNoise {
  float range[kNoiseLanes], lateral[kNoiseLanes], elevation[kNoiseLanes], detection[kNoiseLanes];
};

// The same block that core/random.h's philox() gives for (column, row, channel), sixteen rows at a time; 24 bits of
// each word make the uniform numbers, so a normal number is at most 5.9. The same numbers by AVX-512, by AVX2 and
// without.
void pulseNoise(const RandomKey& key, std::uint32_t column, std::uint32_t first_row, NoiseChannel channel,
                PulseNoise& noise);

}  // namespace standpoint
