// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/device/format.h"

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(Format, TellsSizesInTheUnitOneSays) {
  EXPECT_EQ(bytesText(136.4e6), "136.4 MB");
  EXPECT_EQ(bytesText(127.7e9), "127.7 GB");
  EXPECT_EQ(bytesText(1e12), "1.0 TB");
}

TEST(Format, TellsLengthsInFeetAndInches) {
  EXPECT_EQ(lengthText(0.3048, true), "1.00 ft");
  EXPECT_EQ(smallLengthText(0.0254, true), "1.000 in");
  EXPECT_EQ(smallLengthText(0.0061, false), "6.1 mm");
}

}  // namespace
}  // namespace standpoint
