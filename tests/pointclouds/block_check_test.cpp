// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/files/block_check.h"

#include <limits>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

PointBlock blockOf(std::size_t points) {
  PointBlock block;
  for (auto* column : {&block.x_m, &block.y_m, &block.z_m, &block.intensity}) column->assign(points, 0.5F);
  for (auto* column : {&block.row, &block.column}) column->assign(points, 3);
  return block;
}

ScanHeader gridOf() {
  ScanHeader header;
  header.rows = header.columns = 10;
  return header;
}

// Values are looked at sixteen at a time: each place of full and partial sixteens counts.
TEST(BlockCheck, FindsTheExtremeWhereverItIs) {
  for (const std::size_t points : {1, 15, 16, 17, 40})
    for (std::size_t i = 0; i < points; ++i) {
      PointBlock block = blockOf(points);
      block.y_m[i] = -2;
      block.z_m[i] = 7;
      block.row[i] = 9;
      const auto extent = checkBlock(gridOf(), block);
      ASSERT_TRUE(extent) << points << " " << i;
      EXPECT_EQ(extent->low[1], -2.0F);
      EXPECT_EQ(extent->high[1], points > 1 ? 0.5F : -2.0F);
      EXPECT_EQ(extent->low[2], points > 1 ? 0.5F : 7.0F);
      EXPECT_EQ(extent->high[2], 7.0F);
      EXPECT_EQ(extent->row, 9U);
    }
}

TEST(BlockCheck, RefusesANumberThatIsNoneWhereverItIs) {
  for (const float wrong : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    for (std::size_t i = 0; i < 40; ++i)
      for (auto column : {&PointBlock::x_m, &PointBlock::z_m, &PointBlock::intensity}) {
        PointBlock block = blockOf(40);
        (block.*column)[i] = wrong;
        EXPECT_FALSE(checkBlock(gridOf(), block)) << i;
      }
}

TEST(BlockCheck, RefusesARowOutsideTheGrid) {
  PointBlock block = blockOf(40);
  block.row[39] = 10;
  EXPECT_FALSE(checkBlock(gridOf(), block));
}

}  // namespace
}  // namespace standpoint
