// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/pulse_noise.h"

#include <cmath>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(PulseNoise, IsMadeOfTheBlocksOfRandom123) {
  const RandomKey key{0x123456789ABCDEF0ULL, 77};
  for (const std::uint32_t row : {0U, 8320U, 0xFFFFFFE0U}) {
    PulseNoise noise;
    pulseNoise(key, 4711, row, NoiseChannel::pulse, noise);
    for (int k = 0; k < kNoiseLanes; ++k) {
      const auto expected = normals(philox(key, 4711, row + static_cast<std::uint32_t>(k), 0));
      EXPECT_NEAR(noise.range[k], expected[0], 1e-4);  // 24 of the 32 bits
      EXPECT_NEAR(noise.detection[k], expected[1], 1e-4);
      EXPECT_NEAR(noise.lateral[k], expected[2], 1e-4);
      EXPECT_NEAR(noise.elevation[k], expected[3], 1e-4);
    }
  }
}

TEST(PulseNoise, IsNormalAndWhite) {
  double sum = 0, square = 0, fourth = 0, neighbours = 0, last = 0, cross = 0;
  int beyond_three = 0;
  constexpr int kColumns = 400, kRows = 2048;
  for (std::uint32_t column = 0; column < kColumns; ++column)
    for (std::uint32_t row = 0; row < kRows; row += kNoiseLanes) {
      PulseNoise noise;
      pulseNoise({9, 1}, column, row, NoiseChannel::pulse, noise);
      for (int k = 0; k < kNoiseLanes; ++k) {
        const double z = static_cast<double>(noise.range[k]);
        sum += z, square += z * z, fourth += z * z * z * z;
        neighbours += z * last, last = z;
        cross += z * static_cast<double>(noise.detection[k]);
        beyond_three += std::abs(z) > 3 ? 1 : 0;
      }
    }
  const double n = static_cast<double>(kColumns) * kRows;
  const double five_sigma = 5 / std::sqrt(n);
  EXPECT_NEAR(sum / n, 0, five_sigma);
  EXPECT_NEAR(square / n, 1, five_sigma * std::sqrt(2.0));
  EXPECT_NEAR(fourth / n, 3, five_sigma * std::sqrt(96.0));
  EXPECT_NEAR(neighbours / n, 0, five_sigma);
  EXPECT_NEAR(cross / n, 0, five_sigma);
  EXPECT_NEAR(beyond_three / n, 0.0026998, 5 * std::sqrt(0.0027 / n));
}

}  // namespace
}  // namespace standpoint
