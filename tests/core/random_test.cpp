// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

// Known answers of Philox4x32-10 from the Random123 distribution (kat_vectors).
TEST(Philox, GivesTheKnownAnswers) {
  const auto zero = philox({0, 0}, 0, 0, 0);
  EXPECT_EQ(zero, (std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const auto ones = philox({~0ULL, ~0U}, ~0U, ~0U, ~0U);
  EXPECT_EQ(ones, (std::array<std::uint32_t, 4>{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
}

TEST(Uniform, NeverReachesZeroOrOne) {
  EXPECT_GT(uniform(0), 0);
  EXPECT_LT(uniform(~0U), 1);
}

TEST(Normals, HaveMeanZeroVarianceOneAndTheRightTails) {
  double sum = 0;
  double squares = 0;
  int beyond_two = 0;
  constexpr int kBlocks = 100000;
  for (std::uint32_t i = 0; i < kBlocks; ++i)
    for (const double x : normals(philox({7, 3}, i, 0, 0))) {
      sum += x;
      squares += x * x;
      beyond_two += std::abs(x) > 2 ? 1 : 0;
    }
  constexpr double n = 4.0 * kBlocks;
  EXPECT_NEAR(sum / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(beyond_two / n, 0.0455003, 5 * std::sqrt(0.0455 / n));
}

TEST(StableHash, IsFnv1a) { EXPECT_EQ(stableHash("foobar"), 0x85944171f73967e8ULL); }

}  // namespace
}  // namespace standpoint
