// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/number_text.h"

#include <gtest/gtest.h>

namespace standpoint {
namespace {

constexpr NumberKind kMetres{.unit = "m"}, kMillimetres{.unit = "mm"}, kDegrees{.unit = "°"};

double read(std::string_view text, const NumberKind& kind = {}) {
  const auto number = numberFromText(text, kind);
  EXPECT_TRUE(number) << text << ": " << (number ? "" : number.error().message);
  return number.value_or(-12345);
}

std::string refused(std::string_view text, const NumberKind& kind = {}) {
  const auto number = numberFromText(text, kind);
  EXPECT_FALSE(number) << text << " was read as " << number.value_or(0);
  return number ? std::string() : number.error().message;
}

TEST(NumberText, ReadsBothDecimalSigns) {
  EXPECT_EQ(read("2,5"), 2.5);
  EXPECT_EQ(read("2.5"), 2.5);
  EXPECT_EQ(read("1,234"), 1.234) << "a lone sign is decimal";
  EXPECT_EQ(read("1.234,5"), 1234.5) << "of two the last one";
  EXPECT_EQ(read("1,234.5"), 1234.5);
  EXPECT_EQ(read("1.234.567,25"), 1234567.25);
  EXPECT_EQ(read(",5"), 0.5);
  EXPECT_EQ(read("5."), 5);
}

TEST(NumberText, RefusesWhatHasTwoDecimalSigns) {
  refused("1.2.3");
  refused("1,234,567");
  refused("12.34,5");
  refused(".123,5");
  refused(".");
}

TEST(NumberText, Calculates) {
  EXPECT_DOUBLE_EQ(read("3.4-0.35"), 3.05);
  EXPECT_DOUBLE_EQ(read("2*(3+4)/7"), 2);
  EXPECT_DOUBLE_EQ(read("(1,2 + 0,4) / 2"), 0.8);
  EXPECT_DOUBLE_EQ(read("-0.5"), -0.5);
  EXPECT_DOUBLE_EQ(read("+0.5"), 0.5) << "not relative to what was there";
  EXPECT_DOUBLE_EQ(read("2--3"), 5);
  EXPECT_DOUBLE_EQ(read("−2×3"), -6) << "as typeset";
  EXPECT_DOUBLE_EQ(read("10/4/5"), 0.5);
  EXPECT_DOUBLE_EQ(read("1e-3+1E3"), 1000.001);
}

TEST(NumberText, ConvertsUnitsIntoItsOwn) {
  EXPECT_DOUBLE_EQ(read("35cm", kMetres), 0.35);
  EXPECT_DOUBLE_EQ(read("1 m + 20 mm", kMetres), 1.02);
  EXPECT_DOUBLE_EQ(read("3.4-35cm", kMetres), 3.05) << "a number without a unit has the field's";
  EXPECT_DOUBLE_EQ(read("10 ft", kMetres), 3.048);
  EXPECT_DOUBLE_EQ(read("0.5 m", kMillimetres), 500);
  EXPECT_DOUBLE_EQ(read("2 * 3 mm", kMillimetres), 6);
  EXPECT_DOUBLE_EQ(read("(1+2)cm", kMillimetres), 30);
  EXPECT_DOUBLE_EQ(read("45°", kDegrees), 45);
  EXPECT_DOUBLE_EQ(read("45 deg", kDegrees), 45);
  EXPECT_DOUBLE_EQ(read("10 mm/h", {.unit = "mm/h"}), 10);
  EXPECT_DOUBLE_EQ(read("80 %", {.unit = "%"}), 80);
}

TEST(NumberText, SaysWhyAUnitDoesNotFit) {
  EXPECT_EQ(refused("2 furlongs", kMetres), "Unknown unit 'furlongs'");
  EXPECT_EQ(refused("2°", kMetres), "'°' does not fit: the unit is m");
  EXPECT_EQ(refused("2 m"), "A plain number is expected, without 'm'");
  EXPECT_EQ(refused("2 m * 3 m", kMetres), "Two units cannot be multiplied");
  refused("2 / 3 m", kMetres);
  refused("2 m cm", kMetres);
}

TEST(NumberText, SaysWhatCannotBeRead) {
  EXPECT_EQ(refused(""), "Enter a number");
  EXPECT_EQ(refused("  "), "Enter a number");
  EXPECT_EQ(refused("abc"), "Cannot read 'abc'");
  EXPECT_EQ(refused("2+"), "Incomplete: a number is missing at the end");
  EXPECT_EQ(refused("(2"), "A ')' is missing");
  refused("2 3");
  refused("1/0");
  refused("1e999");
  refused("nan");
  refused("inf");
  refused(std::string(1'000'000, '('));
}

TEST(NumberText, KeepsToTheRange) {
  const NumberKind walker{.unit = "m", .least = 0.05, .most = 1};
  EXPECT_EQ(read("0.05", walker), 0.05);
  EXPECT_EQ(read("1", walker), 1);
  EXPECT_EQ(refused("1.01", walker), "Allowed: 0.05 to 1 m");
  EXPECT_EQ(refused("-1", {.unit = "mm", .least = 0}), "Allowed: 0 mm or more");
  EXPECT_EQ(refused("2.5", {.whole = true}), "Whole numbers only");
  EXPECT_EQ(rangeText({.least = -1e300, .most = 1e300}), "");
}

TEST(NumberText, WritesWhatReadsAsTheSameNumber) {
  EXPECT_EQ(exactText(0.1), "0.1");
  EXPECT_EQ(exactText(25), "25");
  EXPECT_EQ(exactText(9007199254740991.0), "9007199254740991");
  for (const double number : {1.0 / 3, 0.1 + 0.2, 4321987.123456789, -1e-9}) EXPECT_EQ(read(exactText(number)), number);
}

}  // namespace
}  // namespace standpoint
