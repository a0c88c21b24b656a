// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/pulse_noise.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "scanners/portable_math.h"
#include "scanners/target_clones.h"

namespace standpoint {

namespace {

struct Lanes {
  std::uint32_t word[4][kNoiseLanes];
};

#if defined(__SSE2__)

// Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3"), two counters in each register. Only
// the low halves of the 64-bit lanes count; what the products leave in the high halves is never looked at.
void philoxLanes(Lanes& lanes, std::uint32_t column, std::uint32_t first_row, std::uint32_t channel, const RandomKey& key) {
  constexpr int kStep = 4;
  const __m128i multiplier_0 = _mm_set1_epi64x(0xD2511F53);
  const __m128i multiplier_2 = _mm_set1_epi64x(0xCD9E8D57);
  for (int from = 0; from < kNoiseLanes; from += kStep) {
    __m128i word[4][2];
    for (int half = 0; half < 2; ++half) {
      const auto row = static_cast<long long>(first_row) + from + 2 * half;
      word[0][half] = _mm_set1_epi64x(column);
      word[1][half] = _mm_set_epi64x(row + 1, row);
      word[2][half] = _mm_set1_epi64x(channel);
      word[3][half] = _mm_set1_epi64x(key.station);
    }
    auto key_0 = static_cast<std::uint32_t>(key.seed);
    auto key_1 = static_cast<std::uint32_t>(key.seed >> 32U);
    for (int round = 0; round < 10; ++round, key_0 += 0x9E3779B9U, key_1 += 0xBB67AE85U)
      for (int half = 0; half < 2; ++half) {
        const __m128i a = _mm_mul_epu32(word[0][half], multiplier_0);
        const __m128i b = _mm_mul_epu32(word[2][half], multiplier_2);
        word[0][half] = _mm_xor_si128(_mm_xor_si128(_mm_srli_epi64(b, 32), word[1][half]), _mm_set1_epi64x(key_0));
        word[1][half] = b;
        word[2][half] = _mm_xor_si128(_mm_xor_si128(_mm_srli_epi64(a, 32), word[3][half]), _mm_set1_epi64x(key_1));
        word[3][half] = a;
      }
    for (int k = 0; k < 4; ++k) {
      const __m128 low = _mm_shuffle_ps(_mm_castsi128_ps(word[k][0]), _mm_castsi128_ps(word[k][1]), _MM_SHUFFLE(2, 0, 2, 0));
      _mm_storeu_si128(reinterpret_cast<__m128i*>(&lanes.word[k][from]), _mm_castps_si128(low));
    }
  }
}

#else

void philoxLanes(Lanes& lanes, std::uint32_t column, std::uint32_t first_row, std::uint32_t channel, const RandomKey& key) {
  for (int k = 0; k < kNoiseLanes; ++k) {
    const auto block = philox(key, column, first_row + static_cast<std::uint32_t>(k), channel);
    for (int n = 0; n < 4; ++n) lanes.word[n][k] = block[n];
  }
}

#endif

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

STANDPOINT_CLONES void normalLanes(const Lanes& lanes, PulseNoise& noise) {
  normalPair(lanes.word[0], lanes.word[1], noise.range, noise.detection);
  normalPair(lanes.word[2], lanes.word[3], noise.lateral, noise.elevation);
}

}  // namespace

void pulseNoise(const RandomKey& key, std::uint32_t column, std::uint32_t first_row, NoiseChannel channel, PulseNoise& noise) {
  Lanes lanes;
  philoxLanes(lanes, column, first_row, static_cast<std::uint32_t>(channel), key);
  normalLanes(lanes, noise);
}

}  // namespace standpoint
