// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "editor/points/cloud_colours.h"

namespace standpoint {
namespace {

std::vector<CloudPoint> hundredPoints() {
  std::vector<CloudPoint> points(101);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].position_m = {0, 0, static_cast<float>(i) / 10};
    points[i].intensity = static_cast<std::uint16_t>(1000 + i);
    points[i].colour = {255, 255, 255};
  }
  points.back().intensity = 65535;  // one retroreflector
  return points;
}

TEST(CloudColours, SpreadWhatNearlyAllPointsHaveOverTheGreys) {
  const auto points = hundredPoints();
  const auto colouring = colouringOf(points, cloud_channel::kIntensity);
  EXPECT_FALSE(colouring.by_height);
  EXPECT_EQ(colouring.low, 1002);
  EXPECT_EQ(colouring.high, 1098) << "one that dazzles leaves the others as bright as they were";
  const auto dark = colourOf(points[0], 0, colouring), bright = colourOf(points[100], 0, colouring);
  EXPECT_LT(dark[0], 130);
  EXPECT_EQ(bright, (PointColour{255, 255, 255, 255}));
}

TEST(CloudColours, TakeHeightWhereThereIsNoIntensity) {
  const auto points = hundredPoints();
  const auto colouring = colouringOf(points, 0);
  EXPECT_TRUE(colouring.by_height);
  EXPECT_FLOAT_EQ(colouring.high, 9.8F);
  EXPECT_LT(colourOf(points[100], 0, colouring)[0], colourOf(points[0], 10, colouring)[0])
      << "the height that is stated counts, not the one from the node's origin";
}

TEST(CloudColours, KeepTheScansOwnHue) {
  CloudPoint p;
  p.colour = {200, 100, 0};
  p.intensity = 65535;
  EXPECT_EQ(colourOf(p, 0, CloudColouring()), (PointColour{200, 100, 0, 255}));
}

TEST(CloudColours, OfNoPointsAreNoTrouble) { EXPECT_TRUE(colouringOf({}, 0).by_height); }

}  // namespace
}  // namespace standpoint
