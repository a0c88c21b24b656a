// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "core/random.h"
#include "pointclouds/number_text.h"

namespace standpoint {
namespace {

// Floats of every size, and those beside the sizes where the number of decimals changes.
TEST(NumberText, OfAFloatReadsBackToTheLastBit) {
  std::string text;
  const auto expectBack = [&](float value) {
    text.clear();
    appendFloat(text, value);
    const auto read = numberFrom<float>(text);
    ASSERT_TRUE(read.has_value()) << text;
    ASSERT_EQ(std::bit_cast<std::uint32_t>(*read), std::bit_cast<std::uint32_t>(value)) << text;
  };
  for (std::uint32_t i = 0; i < 200000; ++i) {
    const auto random = philox({5, 0}, i, 0, 0);
    const float any = std::bit_cast<float>(random[0]);
    if (std::isfinite(any)) expectBack(any);
    expectBack(std::ldexp(static_cast<float>(1 + uniform(random[1])), static_cast<int>(random[2] % 30) - 9));
  }
  for (int power = -8; power < 22; ++power)
    for (float value = std::ldexp(1.0F, power), step = 0; step < 100; ++step) {
      expectBack(value);
      expectBack(-value);
      value = std::nextafter(value, 1e9F);
    }
  for (const float edge : {0.0F, -0.0F, 16.0F, 128.0F, 1024.0F})
    for (const float toward : {0.0F, 1e9F}) expectBack(std::nextafter(edge, toward));
}

TEST(NumberText, OfFixedDecimalsIsThatOfPrintf) {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const auto random = philox({6, 0}, i, 0, 0);
    const double value = (uniform(random[0]) - 0.5) * std::pow(10.0, random[1] % 9);
    char printed[64];
    std::snprintf(printed, sizeof printed, "%.5f", value);
    std::string text;
    appendFixed(text, value, 5);
    EXPECT_NEAR(*numberFrom<double>(text), std::atof(printed),
                1.01e-5 * (std::fmod(std::abs(value) * 1e5, 1) > 0.4999999))
        << text;
  }
  std::string text;
  appendFixed(text, -0.000001, 5);
  EXPECT_EQ(text, "0.00000");
  text.clear();
  appendFixed(text, -1e300, 5);
  EXPECT_EQ(*numberFrom<double>(text), -1e300);
}

}  // namespace
}  // namespace standpoint
