// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/octree/cloud_point.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace standpoint {
namespace {

ScanHeader labelledScan(std::vector<std::string> materials) {
  ScanHeader scan;
  scan.name = "S1";
  scan.intensity_min = 100;
  scan.intensity_max = 300;
  scan.has_colour = scan.has_labels = scan.has_truth = true;
  scan.products = {{"#1", "", "IfcWall", "Wall"}};
  scan.materials = std::move(materials);
  scan.file_from_scanner.translation = {5000000, 0, 2};
  return scan;
}

PointBlock onePoint() {
  PointBlock block;
  block.x_m = {3};
  block.y_m = {4};
  block.z_m = {0};
  block.intensity = {200};
  block.red = {10};
  block.green = {20};
  block.blue = {30};
  block.product = {0};
  block.material = {0};
  block.truth.x_m = {3};
  block.truth.y_m = {3.99875F};
  block.truth.z_m = {0};
  block.truth.range_m = {4.999F};
  block.truth.incidence_rad = {static_cast<float>(std::numbers::pi / 3)};
  block.truth.received_db = {0};
  block.truth.flags = {point_flag::kMixed};
  return block;
}

TEST(CloudPointMaker, KeepsWhatAPointIsKnownBy) {
  CloudPointMaker maker({5000000, 0, 0});
  maker.begin(labelledScan({"brick"}));
  const CloudPoint p = maker.make(onePoint(), 0);
  EXPECT_EQ(p.position_m, (std::array<float, 3>{3, 4, 2}));
  EXPECT_EQ(p.colour, (std::array<std::uint8_t, 3>{10, 20, 30}));
  EXPECT_EQ(p.intensity, 32768);
  EXPECT_EQ(p.station, 0);
  EXPECT_EQ(p.product, 0);
  EXPECT_EQ(p.flags, point_flag::kMixed);
  EXPECT_EQ(p.incidence_deg, 60);
  EXPECT_EQ(p.residual_tenth_mm, 10);
  EXPECT_TRUE(std::isnan(p.time_s));
  EXPECT_EQ(maker.header().channels,
            cloud_channel::kColour | cloud_channel::kIntensity | cloud_channel::kLabels | cloud_channel::kTruth);
}

TEST(CloudPointMaker, JoinsTheTablesOfItsScans) {
  CloudPointMaker maker(Eigen::Vector3d::Zero());
  maker.begin(labelledScan({"brick"}));
  maker.begin(labelledScan({"glass", "brick"}));
  auto block = onePoint();
  EXPECT_EQ(maker.header().materials, (std::vector<std::string>{"brick", "glass"}));
  EXPECT_EQ(maker.header().products.size(), 1U);
  EXPECT_EQ(maker.make(block, 0).material, 1);
  EXPECT_EQ(maker.make(block, 0).station, 1);
  block.material = {1};
  EXPECT_EQ(maker.make(block, 0).material, 0);
  block.material = {2};
  EXPECT_EQ(maker.make(block, 0).material, kNoLabel) << "beyond the table";
}

TEST(CloudPointMaker, SaysWhatIsNotKnown) {
  CloudPointMaker maker(Eigen::Vector3d::Zero());
  ScanHeader bare;
  bare.intensity_max = bare.intensity_min = 0;
  maker.begin(bare);
  PointBlock block;
  block.x_m = block.y_m = block.z_m = {1};
  block.intensity = {NAN};
  const CloudPoint p = maker.make(block, 0);
  EXPECT_EQ(p.product, kNoLabel);
  EXPECT_EQ(p.material, kNoLabel);
  EXPECT_EQ(p.incidence_deg, kNoIncidence);
  EXPECT_EQ(p.residual_tenth_mm, kNoResidual);
  EXPECT_EQ(p.intensity, 32768) << "in the middle: neither dark nor bright";
  EXPECT_EQ(maker.header().channels, 0U);
}

// By way of a mirror the place is not as far away as the light's way is long.
TEST(CloudPointMaker, KnowsNoResidualOfWhatIsNotAlongItsBeam) {
  CloudPointMaker maker(Eigen::Vector3d::Zero());
  maker.begin(labelledScan({"brick"}));
  auto block = onePoint();
  block.truth.range_m = {9};
  EXPECT_EQ(maker.make(block, 0).residual_tenth_mm, kNoResidual);
}

}  // namespace
}  // namespace standpoint
