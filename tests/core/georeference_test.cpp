// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/georeference.h"

#include <cmath>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

TEST(MapConversion, TurnsCounterClockwiseAndScales) {
  MapConversion c{500000, 5700000, 100, std::cos(0.5), std::sin(0.5), 0.9996};
  const Eigen::Vector3d map = mapFromFile(c, {10, 0, 1});
  EXPECT_NEAR(map.x(), 500000 + 9.996 * std::cos(0.5), 1e-9);
  EXPECT_NEAR(map.y(), 5700000 + 9.996 * std::sin(0.5), 1e-8);
  EXPECT_NEAR(map.z(), 100.9996, 1e-12);
}

TEST(MapConversion, IsUndoneByItsInverse) {
  const MapConversion c{76670, 77179, 293.7, 0.3256, -0.9455, 1.0002};
  const Eigen::Vector3d file(12.5, -7.25, 3);
  EXPECT_LT((fileFromMap(c, mapFromFile(c, file)) - file).norm(), 1e-9);
}

TEST(MapConversion, StretchesTheFilesAxesBeforeItTurnsThem) {
  MapConversion c{1000, 2000, 30, 0, 1, 2};  // a quarter turn: the file's x is the map's north
  c.factors = {1, 2, 3};
  const Eigen::Vector3d map = mapFromFile(c, {10, 100, 5});
  EXPECT_NEAR(map.x(), 1000 - 2 * 2 * 100, 1e-9);
  EXPECT_NEAR(map.y(), 2000 + 2 * 10, 1e-9);
  EXPECT_NEAR(map.z(), 30 + 2 * 3 * 5, 1e-9);
  EXPECT_LT((fileFromMap(c, map) - Eigen::Vector3d(10, 100, 5)).norm(), 1e-9);
}

TEST(GlobalShift, OfWholeMetresComesBackToTheLastBit) {
  const double file = 5012345.678901234;
  const double shift = std::round(file);
  EXPECT_EQ((file - shift) + shift, file);
}

}  // namespace
}  // namespace standpoint
