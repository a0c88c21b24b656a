// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/pulse_noise.h"

#include "scanners/portable_math.h"
#include "scanners/target_clones.h"

namespace standpoint {

namespace {

struct Lanes {
  std::uint32_t word[4][kNoiseLanes];
};

// Philox4x32-10, Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3"; the test holds it against Random123.
STANDPOINT_INLINE void philoxRounds(Lanes& lanes, std::uint32_t key0, std::uint32_t key1) {
  for (int round = 0; round < 10; ++round) {
    for (int k = 0; k < kNoiseLanes; ++k) {
      const std::uint64_t a = std::uint64_t{0xD2511F53U} * lanes.word[0][k];
      const std::uint64_t b = std::uint64_t{0xCD9E8D57U} * lanes.word[2][k];
      const std::uint32_t word1 = lanes.word[1][k];
      const std::uint32_t word3 = lanes.word[3][k];
      lanes.word[0][k] = static_cast<std::uint32_t>(b >> 32U) ^ word1 ^ key0;
      lanes.word[1][k] = static_cast<std::uint32_t>(b);
      lanes.word[2][k] = static_cast<std::uint32_t>(a >> 32U) ^ word3 ^ key1;
      lanes.word[3][k] = static_cast<std::uint32_t>(a);
    }
    key0 += 0x9E3779B9U;
    key1 += 0xBB67AE85U;
  }
}

STANDPOINT_INLINE float unit(std::uint32_t word) {
  return (static_cast<float>(static_cast<std::int32_t>(word >> 8U)) + 0.5F) * 0x1p-24F;
}

// Box–Muller on the words (a, b).
STANDPOINT_INLINE void normalPair(const std::uint32_t* a, const std::uint32_t* b, float* first, float* second) {
  for (int k = 0; k < kNoiseLanes; ++k) {
    const float log2_u = portable::log2(unit(a[k]));
    const float radius = std::sqrt(log2_u < 0 ? -1.3862943611198906F * log2_u : 0.0F);   // -2 ln 2 log2 u
    float sine, cosine;
    portable::sinCosTurn(unit(b[k]), sine, cosine);
    first[k] = radius * cosine;
    second[k] = radius * sine;
  }
}

}  // namespace

STANDPOINT_CLONES void pulseNoise(const RandomKey& key, std::uint32_t column, std::uint32_t first_row, NoiseChannel channel,
                                  PulseNoise& noise) {
  Lanes lanes;
  for (int k = 0; k < kNoiseLanes; ++k) {
    lanes.word[0][k] = column;
    lanes.word[1][k] = first_row + static_cast<std::uint32_t>(k);
    lanes.word[2][k] = static_cast<std::uint32_t>(channel);
    lanes.word[3][k] = key.station;
  }
  philoxRounds(lanes, static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32U));
  normalPair(lanes.word[0], lanes.word[1], noise.range, noise.detection);
  normalPair(lanes.word[2], lanes.word[3], noise.lateral, noise.elevation);
}

}  // namespace standpoint
