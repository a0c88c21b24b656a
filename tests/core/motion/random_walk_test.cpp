// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/random_walk.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

constexpr int kSeeds = 4000;

template <class Of>
double meanOverSeeds(Of of) {
  double sum = 0;
  for (int seed = 0; seed < kSeeds; ++seed) sum += of(MotionKey{static_cast<std::uint64_t>(seed), 3});
  return sum / kSeeds;
}

TEST(RandomWalk, HasTheVarianceOfItsLength) {
  for (const std::uint32_t n : {1U, 7U, 100U, 1600U, 65536U, 1U << 20U}) {
    const double variance = meanOverSeeds([&](const MotionKey& key) {
      const double w = RandomWalk(key).at(n);
      return w * w;
    });
    EXPECT_NEAR(variance / n, 1, 4 * std::sqrt(2.0 / kSeeds)) << n;
  }
}

TEST(RandomWalk, HasIncrementsThatAreNotCorrelated) {
  for (const std::uint32_t n : {5U, 64U, 1023U}) {  // 64 and 1024 are seams of the construction
    const double product = meanOverSeeds([&](const MotionKey& key) {
      const RandomWalk w(key);
      return (w.at(n) - w.at(n - 1)) * (w.at(n + 1) - w.at(n));
    });
    EXPECT_NEAR(product, 0, 4 / std::sqrt(kSeeds)) << n;
  }
}

TEST(RandomWalk, IsTheSameWhateverWasAskedBeforeAndHoweverLongItGets) {
  const RandomWalk walk({42, 1, MotionProcess::drift, 2});
  const auto short_walk = walk.first(1000), long_walk = walk.first(70001);
  ASSERT_EQ(short_walk.size(), 1000U);
  ASSERT_EQ(long_walk.size(), 70001U);
  EXPECT_EQ(std::memcmp(short_walk.data(), long_walk.data(), 1000 * sizeof(double)), 0);
  for (std::uint32_t i = 70001; i > 0;) {
    i -= std::min(i, 313U);
    ASSERT_EQ(walk.at(i), long_walk[i]) << i;
  }
  EXPECT_EQ(walk.at(0), 0);
  const auto whole = walk.first(RandomWalk::kLastKnot + 1);
  EXPECT_EQ(whole.back(), walk.at(RandomWalk::kLastKnot));
  EXPECT_EQ(whole[RandomWalk::kLastKnot - 1], walk.at(RandomWalk::kLastKnot - 1));
  EXPECT_TRUE(walk.first(0).empty());
}

// Bits that are known, on whatever processor.
TEST(RandomWalk, OfAKeyIsKnown) {
  const RandomWalk walk({42, 1, MotionProcess::drift, 2});
  EXPECT_EQ(walk.at(1), 0x1.eac98b6ccffe3p-1);
  EXPECT_EQ(walk.at(12345), 0x1.51a58ce1d376bp+6);
}

TEST(GaussMarkov, HasVarianceOneAndAnExponentialCorrelation) {
  for (const std::uint32_t n : {0U, 5U, 1000U})
    for (const std::uint32_t lag : {0U, 1U, 40U, 160U}) {
      const double product = meanOverSeeds([&](const MotionKey& key) {
        const GaussMarkov process(key, 0.0125);
        return process.at(n) * process.at(n + lag);
      });
      EXPECT_NEAR(product, std::exp(-0.0125 * lag), 4 * std::sqrt(2.0 / kSeeds)) << n << " " << lag;
    }
}

TEST(BandNoise, HasVarianceOneAndNearlyNormalTails) {
  double squares = 0, beyond_two = 0;
  for (const double t : {0.0, 17.3, 3600.0})
    squares += meanOverSeeds([&](const MotionKey& key) {
                 const double x = BandNoise(key, 0.3, 1).at(t);
                 beyond_two += std::abs(x) > 2 ? 1 : 0;
                 return x * x;
               }) /
               3;
  EXPECT_NEAR(squares, 1, 0.03);
  EXPECT_NEAR(beyond_two / (3 * kSeeds), 0.0455, 0.01);
}

TEST(BandNoise, StaysInItsBand) {
  // Its turning points count its frequency: about twice the band's middle a second.
  const BandNoise noise({9, 0, MotionProcess::hand}, 3, 10);
  int turns = 0;
  for (double t = 0; t < 100; t += 0.001)
    turns += (noise.at(t) - noise.at(t - 0.001)) * (noise.at(t + 0.001) - noise.at(t)) < 0 ? 1 : 0;
  EXPECT_GT(turns, 2 * 100 * 6);
  EXPECT_LT(turns, 2 * 100 * 9);
}

}  // namespace
}  // namespace standpoint
