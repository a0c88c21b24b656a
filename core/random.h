// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

namespace standpoint {

// A random number belongs to what it is for, never to a thread: Philox4x32-10 (Salmon et al. 2011, Random123) keyed by
// the seed and counted by (station, column, row, channel). Same arguments, same numbers, on every machine.
struct RandomKey {
  std::uint64_t seed = 0;
  std::uint32_t station = 0;
};

std::array<std::uint32_t, 4> philox(const RandomKey& key, std::uint32_t column, std::uint32_t row,
                                    std::uint32_t channel);

// Uniform in (0, 1): (x + 0.5) / 2^32.
double uniform(std::uint32_t x);

// Four independent standard normal numbers from one Philox block, by the Box–Muller transform.
std::array<double, 4> normals(const std::array<std::uint32_t, 4>& block);

// 64-bit hash of a text that is the same everywhere (FNV-1a), for station names and guids.
std::uint64_t stableHash(const char* text, std::uint64_t start = 0xcbf29ce484222325ULL);

}  // namespace standpoint
