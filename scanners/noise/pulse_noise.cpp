// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/pulse_noise.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

struct Lanes {
  std::uint32_t word[4][kNoiseLanes];
};

void philoxOneByOne(Lanes& lanes, std::uint32_t column, std::uint32_t first_row, std::uint32_t channel,
                    const RandomKey& key) {
  for (int k = 0; k < kNoiseLanes; ++k) {
    const auto block = philox(key, column, first_row + static_cast<std::uint32_t>(k), channel);
    for (int n = 0; n < 4; ++n) lanes.word[n][k] = block[n];
  }
}

#if defined(__x86_64__)

constexpr std::uint32_t kWeyl_0 = 0x9E3779B9U, kWeyl_1 = 0xBB67AE85U;

// Philox4x32-10 (Salmon et al. 2011, "Parallel random numbers: as easy as 1, 2, 3"), a counter in each 64-bit lane.
// Only the low halves of the lanes count; what the products leave in the high halves is never looked at.
__attribute__((target("avx2"))) void philoxByFours(Lanes& lanes, std::uint32_t column, std::uint32_t first_row,
                                                   std::uint32_t channel, const RandomKey& key) {
  constexpr int kStep = 8;
  const __m256i multiplier_0 = _mm256_set1_epi64x(0xD2511F53);
  const __m256i multiplier_2 = _mm256_set1_epi64x(0xCD9E8D57);
  // Rows so that the low halves of two registers come out in order: 0 1 4 5 and 2 3 6 7.
  const __m256i rows[2] = {_mm256_set_epi64x(5, 4, 1, 0), _mm256_set_epi64x(7, 6, 3, 2)};
  for (int from = 0; from < kNoiseLanes; from += kStep) {
    __m256i word[4][2];
    for (int half = 0; half < 2; ++half) {
      word[0][half] = _mm256_set1_epi64x(column);
      word[1][half] = _mm256_add_epi64(_mm256_set1_epi64x(static_cast<long long>(first_row) + from), rows[half]);
      word[2][half] = _mm256_set1_epi64x(channel);
      word[3][half] = _mm256_set1_epi64x(key.station);
    }
    auto key_0 = static_cast<std::uint32_t>(key.seed);
    auto key_1 = static_cast<std::uint32_t>(key.seed >> 32U);
    for (int round = 0; round < 10; ++round, key_0 += kWeyl_0, key_1 += kWeyl_1)
      for (int half = 0; half < 2; ++half) {
        const __m256i a = _mm256_mul_epu32(word[0][half], multiplier_0);
        const __m256i b = _mm256_mul_epu32(word[2][half], multiplier_2);
        word[0][half] =
            _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(b, 32), word[1][half]), _mm256_set1_epi64x(key_0));
        word[1][half] = b;
        word[2][half] =
            _mm256_xor_si256(_mm256_xor_si256(_mm256_srli_epi64(a, 32), word[3][half]), _mm256_set1_epi64x(key_1));
        word[3][half] = a;
      }
    for (int k = 0; k < 4; ++k) {
      const __m256 low =
          _mm256_shuffle_ps(_mm256_castsi256_ps(word[k][0]), _mm256_castsi256_ps(word[k][1]), _MM_SHUFFLE(2, 0, 2, 0));
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(&lanes.word[k][from]), _mm256_castps_si256(low));
    }
  }
}

// The same, eight in a register and both registers at once.
__attribute__((target("avx512f"))) void philoxByEights(Lanes& lanes, std::uint32_t column, std::uint32_t first_row,
                                                       std::uint32_t channel, const RandomKey& key) {
  const __m512i multiplier_0 = _mm512_set1_epi64(0xD2511F53);
  const __m512i multiplier_2 = _mm512_set1_epi64(0xCD9E8D57);
  const __m512i eight_rows = _mm512_set_epi64(7, 6, 5, 4, 3, 2, 1, 0);
  __m512i word[4][2];
  for (int half = 0; half < 2; ++half) {
    word[0][half] = _mm512_set1_epi64(column);
    word[1][half] = _mm512_add_epi64(_mm512_set1_epi64(static_cast<long long>(first_row) + 8 * half), eight_rows);
    word[2][half] = _mm512_set1_epi64(channel);
    word[3][half] = _mm512_set1_epi64(key.station);
  }
  auto key_0 = static_cast<std::uint32_t>(key.seed);
  auto key_1 = static_cast<std::uint32_t>(key.seed >> 32U);
  for (int round = 0; round < 10; ++round, key_0 += kWeyl_0, key_1 += kWeyl_1)
    for (int half = 0; half < 2; ++half) {
      constexpr int kXorOfThree = 0x96;
      const __m512i a = _mm512_mul_epu32(word[0][half], multiplier_0);
      const __m512i b = _mm512_mul_epu32(word[2][half], multiplier_2);
      word[0][half] =
          _mm512_ternarylogic_epi64(_mm512_srli_epi64(b, 32), word[1][half], _mm512_set1_epi64(key_0), kXorOfThree);
      word[1][half] = b;
      word[2][half] =
          _mm512_ternarylogic_epi64(_mm512_srli_epi64(a, 32), word[3][half], _mm512_set1_epi64(key_1), kXorOfThree);
      word[3][half] = a;
    }
  for (int k = 0; k < 4; ++k)
    for (int half = 0; half < 2; ++half)
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(&lanes.word[k][8 * half]), _mm512_cvtepi64_epi32(word[k][half]));
}

#endif

void philoxLanes(Lanes& lanes, std::uint32_t column, std::uint32_t first_row, std::uint32_t channel,
                 const RandomKey& key) {
#if defined(__x86_64__)
  static const bool has_eights = __builtin_cpu_supports("avx512f"), has_fours = __builtin_cpu_supports("avx2");
  if (has_eights) return philoxByEights(lanes, column, first_row, channel, key);
  if (has_fours) return philoxByFours(lanes, column, first_row, channel, key);
#endif
  philoxOneByOne(lanes, column, first_row, channel, key);
}

STANDPOINT_INLINE float unit(std::uint32_t word) {
  return (static_cast<float>(static_cast<std::int32_t>(word >> 8U)) + 0.5F) * 0x1p-24F;
}

// Box–Muller on the words (a, b).
STANDPOINT_INLINE void normalPair(const std::uint32_t* a, const std::uint32_t* b, float* first, float* second) {
  for (int k = 0; k < kNoiseLanes; ++k) {
    const float log2_u = portable::log2(unit(a[k]));
    const float radius = std::sqrt(log2_u < 0 ? -1.3862943611198906F * log2_u : 0.0F);  // -2 ln 2 log2 u
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

void pulseNoise(const RandomKey& key, std::uint32_t column, std::uint32_t first_row, NoiseChannel channel,
                PulseNoise& noise) {
  Lanes lanes;
  philoxLanes(lanes, column, first_row, static_cast<std::uint32_t>(channel), key);
  normalLanes(lanes, noise);
}

}  // namespace standpoint
