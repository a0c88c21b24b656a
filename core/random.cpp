// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/random.h"

#include <cmath>
#include <numbers>

#include <Random123/philox.h>

namespace standpoint {

std::array<std::uint32_t, 4> philox(const RandomKey& key, std::uint32_t column, std::uint32_t row,
                                    std::uint32_t channel) {
  using Generator = r123::Philox4x32;
  const Generator::ctr_type counter = {{column, row, channel, key.station}};
  const Generator::key_type generator_key = {
      {static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32U)}};
  const auto block = Generator()(counter, generator_key);
  return {block[0], block[1], block[2], block[3]};
}

double uniform(std::uint32_t x) { return (static_cast<double>(x) + 0.5) * 0x1p-32; }

std::array<double, 4> normals(const std::array<std::uint32_t, 4>& block) {
  std::array<double, 4> result{};
  for (int i = 0; i < 4; i += 2) {
    const double radius = std::sqrt(-2 * std::log(uniform(block[i])));
    const double angle = 2 * std::numbers::pi * uniform(block[i + 1]);
    result[i] = radius * std::cos(angle);
    result[i + 1] = radius * std::sin(angle);
  }
  return result;
}

std::uint64_t stableHash(const char* text, std::uint64_t start) {
  for (; *text != 0; ++text) start = (start ^ static_cast<unsigned char>(*text)) * 0x100000001b3ULL;
  return start;
}

}  // namespace standpoint
