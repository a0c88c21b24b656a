// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "core/random.h"
#include "pointclouds/files/number_line.h"

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

// The same as std::from_chars of each word, or none where it takes none.
TEST(NumberLine, ReadsEachWordToTheLastBit) {
  const auto expectAsFromChars = [](const std::string& word) {
    using Words = NumberLine<Between::blanks_and_commas>;
    const std::string text = word + " 7";
    Words line(text);
    double read = 0;
    const auto found = line.next(read);
    double right = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), right);
    if (error != std::errc{} || end != word.data() + word.size()) {
      EXPECT_EQ(found, Words::Word::none) << word;
    } else {
      ASSERT_EQ(found, Words::Word::number) << word;
      ASSERT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(right)) << word;
    }
    EXPECT_EQ(line.next(read), Words::Word::number);
    EXPECT_EQ(read, 7);
    EXPECT_EQ(line.next(read), Words::Word::end);
  };
  for (std::uint32_t i = 0; i < 200000; ++i) {
    const auto random = philox({8, 0}, i, 0, 0);
    char text[64];
    const double value = (uniform(random[0]) - 0.5) * std::pow(10.0, static_cast<int>(random[1] % 24) - 8);
    std::snprintf(text, sizeof text, random[2] % 2 ? "%.*f" : "%.*e", static_cast<int>(random[3] % 18), value);
    expectAsFromChars(text);
  }
  for (const char* word : {"0",
                           "-0",
                           "-0.0",
                           "5.",
                           ".5",
                           "-.5e3",
                           ".",
                           "-",
                           "--1",
                           "1-",
                           "1.2.3",
                           "1e",
                           "1e+",
                           "1e-",
                           "1e5x",
                           "e5",
                           "1E5",
                           "1e+22",
                           "1e-22",
                           "1e23",
                           "1e-23",
                           "9007199254740992",
                           "9007199254740993",
                           "9007199254740992e22",
                           "123456789012345678",
                           "1234567890123456789",
                           "18446744073709551617",
                           "340282366920938463463374607431768211456",
                           "0.000000000000000000000001234",
                           "1e308",
                           "1e309",
                           "1e-400",
                           "1e99999999999",
                           "inf",
                           "nan",
                           "-nan",
                           "0x10",
                           "1_000",
                           "١",
                           "1e0000000000000000005",
                           "00000000000000000000000001.5"})
    expectAsFromChars(word);
}

TEST(NumberLine, TakesAPlusAndWhatStandsBetweenNumbers) {
  std::vector<double> numbers;
  EXPECT_TRUE(numbersOf("  +1.5,,2;\t-3e1 \r", 3, numbers));
  EXPECT_EQ(numbers, (std::vector<double>{1.5, 2, -30}));
  EXPECT_FALSE(numbersOf("1 2 3 4", 3, numbers));
  EXPECT_FALSE(numbersOf("1 x", 3, numbers));
  EXPECT_TRUE(numbersOf(" \r", 3, numbers));
  EXPECT_TRUE(numbers.empty());
  double value = 0;
  NumberLine<Between::blanks> decimal_comma("1,5 2");
  EXPECT_EQ(decimal_comma.next(value), NumberLine<Between::blanks>::Word::none);
}

}  // namespace
}  // namespace standpoint
