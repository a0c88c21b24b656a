// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/surface_texture.h"

#include <algorithm>

#include "scanners/math/target_clones.h"
#include "scanners/math/value_noise.h"

namespace standpoint {

STANDPOINT_CLONES void variation(const float* x_m, const float* y_m, const float* z_m, const float* coefficient,
                                 const float* scale_m, float* factor) {
  float result[kTextureLanes];
  textureFactors<kTextureLanes>(x_m, y_m, z_m, coefficient, scale_m, result);
  std::copy(result, result + kTextureLanes, factor);
}

// Eight halves of a word: the sum of so many even numbers, each of variance (2³² - 1) / 12.
float surfaceFactor(std::uint64_t key, float spread) {
  if (!(spread > 0)) return 1;
  std::int64_t sum = 0;
  for (int word = 0; word < 2; ++word) {
    key += 0x9E3779B97F4A7C15ULL;  // SplitMix64 (Steele et al. 2014)
    std::uint64_t mixed = (key ^ (key >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94D049BB133111EBULL;
    mixed ^= mixed >> 31U;
    for (int part = 0; part < 4; ++part)
      sum += static_cast<std::int64_t>(mixed >> (16U * static_cast<unsigned>(part)) & 0xFFFFU);
  }
  constexpr float kPerUnit = 1.8688e-5F;  // 1 / √(8 (2³² - 1) / 12)
  const float normal = kPerUnit * static_cast<float>(sum - 4 * 0xFFFF);
  return portable::exp2(1.4426950408889634F * spread * (normal - spread / 2));  // 1 / ln 2
}

}  // namespace standpoint
