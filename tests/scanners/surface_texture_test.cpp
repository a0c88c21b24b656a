// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/surface_texture.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "scanners/math/value_noise.h"

namespace standpoint {
namespace {

struct Places {
  float x[kTextureLanes], y[kTextureLanes], z[kTextureLanes], coefficient[kTextureLanes], scale[kTextureLanes];
};

std::vector<double> factorsOf(const Places& p) {
  float factor[kTextureLanes];
  variation(p.x, p.y, p.z, p.coefficient, p.scale, factor);
  return {factor, factor + kTextureLanes};
}

// Far from one another, so that their factors are independent; then each with a neighbour at `lag_m`.
struct Pairs {
  double mean = 0, deviation = 0, correlation = 0;  // of the factor, of the factor, of its logarithm
};

Pairs pairsAt(double lag_m, float coefficient, float scale_m) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> place(-40, 40);
  std::normal_distribution<double> normal;
  constexpr int kBlocks = 4000;
  double n = 0, sum = 0, squares = 0, log_sum = 0, log_squares = 0, products = 0;
  for (int block = 0; block < kBlocks; ++block) {
    Places here{}, there{};
    for (int k = 0; k < kTextureLanes; ++k) {
      here.x[k] = place(generator), here.y[k] = place(generator), here.z[k] = place(generator);
      here.coefficient[k] = coefficient, here.scale[k] = scale_m;
    }
    there = here;
    for (int k = 0; k < kTextureLanes; ++k) {
      const double a = normal(generator), b = normal(generator), c = normal(generator);
      const double to = lag_m / std::hypot(a, b, c);
      there.x[k] += static_cast<float>(to * a);
      there.y[k] += static_cast<float>(to * b);
      there.z[k] += static_cast<float>(to * c);
    }
    const auto first = factorsOf(here), second = factorsOf(there);
    for (int k = 0; k < kTextureLanes; ++k) {
      const double f = first[static_cast<std::size_t>(k)], half = std::pow(coefficient, 2) / 2;
      const double g = std::log(f) + half, h = std::log(second[static_cast<std::size_t>(k)]) + half;
      n += 1, sum += f, squares += f * f, log_sum += g, log_squares += g * g, products += g * h;
    }
  }
  const double mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean), products / log_squares};
}

TEST(Texture, KeepsTheMeanAndHasTheVariationThatIsAsked) {
  for (const double cv : {0.1, 0.3, 0.5}) {
    const auto pairs = pairsAt(0, static_cast<float>(cv), 0.5F);
    EXPECT_NEAR(pairs.mean, 1, 0.012 * cv / 0.3);
    EXPECT_NEAR(pairs.deviation / std::sqrt(std::expm1(cv * cv)), 1, 0.02) << cv;  // of a log-normal number
  }
}

// Two octaves with 0.64 and 0.36 of the variance, each at 1/e at its own length.
TEST(Texture, HasTheCorrelationLengthsOfWeatheringAndGrain) {
  EXPECT_NEAR(pairsAt(0.5, 0.3F, 0.5F).correlation, 0.64 * std::exp(-1), 0.02);
  EXPECT_NEAR(pairsAt(2, 0.3F, 2).correlation, 0.64 * std::exp(-1), 0.02);
  EXPECT_NEAR(pairsAt(0.05, 0.3F, 0.5F).correlation, 0.64 * 0.985 + 0.36 * std::exp(-1), 0.02);
  EXPECT_GT(pairsAt(0.002, 0.3F, 0.5F).correlation, 0.99);
  EXPECT_NEAR(pairsAt(3, 0.3F, 0.5F).correlation, 0, 0.02);
}

TEST(Texture, HasTheSameVarianceBetweenTheCornersAsAtThem) {
  for (const float t : {-0.5F, -0.25F, 0.0F, 0.1F, 0.49F}) {
    double sum = 0, squares = 0, n = 0;
    for (int i = 0; i < 30; ++i)
      for (int j = 0; j < 30; ++j)
        for (int k = 0; k < 30; ++k) {
          const auto at = [t](int c) { return static_cast<float>(c) + t; };
          const float x = at(i), y = at(j), z = at(k);
          float value = 0;
          value_noise::fieldLanes<1>(&x, &y, &z, 7, &value);
          const auto g = static_cast<double>(value);
          sum += g, squares += g * g, n += 1;
        }
    EXPECT_NEAR(squares / n, 1, 0.04) << t;
    EXPECT_NEAR(sum / n, 0, 0.04) << t;
  }
}

TEST(Texture, VariesNothingWithoutAScaleOrACoefficient) {
  Places p{};
  for (int k = 0; k < kTextureLanes; ++k) {
    p.x[k] = static_cast<float>(k);
    p.coefficient[k] = k % 2 == 0 ? 0.4F : 0;
    p.scale[k] = k % 2 == 0 ? 0 : 0.4F;
  }
  for (const double f : factorsOf(p)) EXPECT_EQ(f, 1);
}

// This file is compiled for any processor of its kind; the module for AVX2, too. Places that cannot be stay harmless.
TEST(Texture, HasTheSameBitsWithAndWithoutWiderRegisters) {
  Places p{};
  std::mt19937 generator(9);
  std::uniform_real_distribution<float> place(-500, 500);
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNone = std::numeric_limits<float>::quiet_NaN();
  const float strange[] = {1e30F, -1e30F, kInfinity, kNone, 0.0F, -0.0F};
  for (int block = 0; block < 200; ++block) {
    const bool together = block % 2 == 1;  // in one cell, mostly
    for (int k = 0; k < kTextureLanes; ++k) {
      p.x[k] = block < 6 ? strange[block] : place(generator), p.y[k] = place(generator), p.z[k] = place(generator);
      p.coefficient[k] = 0.3F, p.scale[k] = together ? 0.5F : 0.2F + 0.1F * static_cast<float>(k);
      if (together && k > 0) p.x[k] = p.x[0] + 0.001F * static_cast<float>(k), p.y[k] = p.y[0], p.z[k] = p.z[0];
    }
    float factor[kTextureLanes];
    variation(p.x, p.y, p.z, p.coefficient, p.scale, factor);
    for (int k = 0; k < kTextureLanes; ++k) {
      float alone = 0;
      textureFactors<1>(p.x + k, p.y + k, p.z + k, p.coefficient + k, p.scale + k, &alone);
      EXPECT_EQ(factor[k], alone);
      EXPECT_TRUE(factor[k] > 0.05F && factor[k] < 10);
    }
  }
}

}  // namespace
}  // namespace standpoint
