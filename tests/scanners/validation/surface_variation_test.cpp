// SPDX-License-Identifier: GPL-3.0-or-later
// Two surfaces of one material are not alike: ρ = ρ̄ exp(σ g - σ²/2), σ² = ln(1 + CV²), g one normal number a surface.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// 400 boards of half a metre side by side, 10 m away.
struct Boards {
  static constexpr int kSide = 20;
  SceneBuilder scene;
  explicit Boards(bool with_ids = true) {
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const auto product =
            scene.quad({10, 0.5 * (i - kSide / 2) + 0.5, 0.5 * (j - kSide / 2)}, {0, -0.5, 0}, {0, 0, 0.5});
        if (with_ids)
          const_cast<Environment&>(*scene.environment()).products[product].global_id = fmt::format("board {} {}", i, j);
      }
  }
};

// The mean over each board of what it sends back over a white Lambert one, by its GlobalId or number.
std::map<std::uint32_t, double> reflectances(const Boards& boards, const PhysicalMaterial& material, Effects effects,
                                             const Pose& pose = {}, std::uint64_t seed = 1) {
  const auto rtc = testing::instrument("leica-rtc360");
  ScanOptions options;
  options.effects = effects;
  options.channels.truth = true;
  options.seed = seed;
  const auto points = scanned(*boards.scene.build(), allOf(*boards.scene.environment(), material), rtc,
                              window(rtc, -30, 30, -30, 30, 300, 300), options, pose)
                          .points;
  std::map<std::uint32_t, double> sums, counts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto range = static_cast<double>(points.truth.range_m[i]);
    const double cosine = std::cos(static_cast<double>(points.truth.incidence_rad[i]));
    sums[points.product[i]] +=
        std::pow(10, static_cast<double>(points.truth.received_db[i]) / 10) * range * range / cosine;
    ++counts[points.product[i]];
  }
  for (auto& [product, sum] : sums) sum /= counts[product];
  return sums;
}

struct Spread {
  double mean = 0, relative = 0;
};
Spread spreadOf(const std::map<std::uint32_t, double>& values) {
  Spread spread;
  double square = 0;
  const auto count = static_cast<double>(values.size());
  for (const auto& [product, value] : values) spread.mean += value / count;
  for (const auto& [product, value] : values) square += std::pow(value / spread.mean - 1, 2) / count;
  spread.relative = std::sqrt(square);
  return spread;
}

constexpr Effects kOnly = Effects::none().with(Effect::variation);

TEST(SurfaceVariation, SpreadsTheMeansOfManyWallsAsTheMaterialSays) {
  const Boards boards;
  auto painted = lambert(0.3);
  painted.surface_variation = 0.33;
  const auto spread = spreadOf(reflectances(boards, painted, kOnly));
  EXPECT_NEAR(spread.relative, 0.33, 0.04);  // of 400: ± 3 × 0.013
  EXPECT_NEAR(spread.mean, 0.3, 0.015);
}

// Without a figure of its own: what the variation on one surface, half of the class's, leaves of the class's variance.
TEST(SurfaceVariation, IsByTheClassWhereNobodyMeasuredIt) {
  const Boards boards;
  auto material = lambert(0.3);
  material.variation = 0.2;
  material.texture_scale_m = 0.004;  // so fine that it averages out on a board
  EXPECT_NEAR(spreadOf(reflectances(boards, material, kOnly)).relative, std::sqrt(0.75) * 0.2, 0.02);
}

TEST(SurfaceVariation, BelongsToTheSurfaceAndNotToTheScan) {
  const Boards boards;
  auto painted = lambert(0.3);
  painted.surface_variation = 0.33;
  Pose elsewhere;
  elsewhere.translation = {1, 0.5, 0.2};
  const auto one = reflectances(boards, painted, kOnly), other = reflectances(boards, painted, kOnly, elsewhere, 99);
  ASSERT_GT(one.size(), 300U);
  for (const auto& [product, value] : one)
    if (other.contains(product)) {
      EXPECT_NEAR(other.at(product) / value, 1, 1e-3) << product;
    }
  EXPECT_NEAR(spreadOf(reflectances(Boards(false), painted, kOnly)).relative, 0.33, 0.04);  // without GlobalIds, too
}

TEST(SurfaceVariation, NeverMakesAWallSendBackMoreThanAllLightAndIsLeftOutByName) {
  const Boards boards;
  auto white = lambert(0.8);
  white.surface_variation = 0.33;
  for (const auto& [product, value] : reflectances(boards, white, kOnly)) EXPECT_LT(value, 1.001);
  EXPECT_LT(spreadOf(reflectances(boards, white, Effects::none())).relative, 1e-3);
}

}  // namespace
}  // namespace standpoint
