// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/number_breaks.h"

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(NumberBreaks, KeepANumberWholeAndBesideItsUnit) {
  EXPECT_EQ(beginOfNumber("too near by 0.08 m", 14), 12U);  // within the number
  EXPECT_EQ(beginOfNumber("too near by 0.08 m", 17), 12U);  // between the two
  EXPECT_EQ(beginOfNumber("6 mm @ 10 m, high", 10), 7U);    // with what ends a clause
  EXPECT_EQ(beginOfNumber("лишилося 3 хв", 17 + 2), 17U);   // of two bytes a letter
}

TEST(NumberBreaks, LeaveEverythingElse) {
  EXPECT_EQ(beginOfNumber("too near by 0.08 m", 12), 12U);  // before the number
  EXPECT_EQ(beginOfNumber("3 stations", 2), 2U);            // no unit
  EXPECT_EQ(beginOfNumber("scan me", 5), 5U);               // no number
  EXPECT_EQ(beginOfNumber("scanner", 4), 4U);               // a word that is longer than its line
  EXPECT_EQ(beginOfNumber("10 m", 4), 4U);                  // its end
  EXPECT_EQ(beginOfNumber("", 0), 0U);
}

}  // namespace
}  // namespace standpoint
