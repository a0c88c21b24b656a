// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/preview.h"

#include <limits>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

using Pixel = std::array<std::uint8_t, 3>;

// One cell that was measured and one that was not.
ScanPreview twoCells(bool colours) {
  ScanPreview preview;
  preview.columns = 2, preview.rows = 1;
  preview.x_m = {1, std::numeric_limits<float>::quiet_NaN()};
  preview.y_m = preview.z_m = {0, 0};
  preview.grey = {100, 0};
  if (colours) preview.red = {10, 0}, preview.green = {20, 0}, preview.blue = {30, 0};
  return preview;
}

TEST(Preview, IsColouredAsTheUserChose) {
  const auto coloured = twoCells(true);
  EXPECT_EQ(pixelOf(coloured, 0, "luminance"), (Pixel{100, 100, 100}));
  EXPECT_EQ(pixelOf(coloured, 0, "true_colour"), (Pixel{10, 20, 30}));
  EXPECT_EQ(pixelOf(coloured, 0, "panorama"), (Pixel{10, 20, 30}));
  for (const char* red : {"luminance", "true_colour"})
    EXPECT_GT(pixelOf(coloured, 1, red)[0], 100) << red << ": what was not measured";
  EXPECT_EQ(pixelOf(coloured, 1, "panorama"), (Pixel{0, 0, 0}));
}

TEST(Preview, IsGreyWithoutAChoiceOrWithoutColours) {
  EXPECT_EQ(pixelOf(twoCells(true), 0, ""), (Pixel{100, 100, 100}));
  EXPECT_EQ(pixelOf(twoCells(false), 0, "true_colour"), (Pixel{100, 100, 100}));
  EXPECT_EQ(pixelOf(twoCells(false), 1, ""), (Pixel{0, 0, 0}));
}

}  // namespace
}  // namespace standpoint
