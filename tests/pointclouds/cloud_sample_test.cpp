// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/statistics/cloud_sample.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

TEST(CloudSample, OfASmallCloudIsAllOfIt) {
  std::string text;
  for (int i = 0; i < 100; ++i) text += std::to_string(i) + " 0 0\n";
  Progress progress;
  const TemporaryFolder folder;
  const auto sample = sampleCloud(folder.write("sample-small.xyz", text), 1000, progress);
  ASSERT_TRUE(sample) << describe(sample.error());
  ASSERT_EQ(sample->position.size(), 100U);
  EXPECT_EQ(sample->position[42].x(), 42);
  EXPECT_FALSE(sample->scans.at(0).station) << "a list of points does not say where the scanner stood";
  EXPECT_TRUE(sample->intensity.empty());
}

TEST(CloudSample, OfALargeCloudIsBoundedEvenAndTheSameEachTime) {
  std::string text;
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) text += std::to_string(i) + " 0 0\n";
  const TemporaryFolder folder;
  const auto file = folder.write("sample-large.xyz", text);
  Progress progress;
  const auto sample = sampleCloud(file, 1000, progress), again = sampleCloud(file, 1000, progress);
  ASSERT_TRUE(sample && again);
  EXPECT_EQ(sample->points, static_cast<std::uint64_t>(kPoints));
  EXPECT_LE(sample->position.size(), 1000U);
  EXPECT_GE(sample->position.size(), 500U);
  EXPECT_EQ(sample->position, again->position);
  std::size_t first_half = 0;
  for (const auto& p : sample->position) first_half += p.x() < kPoints / 2.0 ? 1 : 0;
  const double n = static_cast<double>(sample->position.size());
  EXPECT_NEAR(static_cast<double>(first_half), n / 2, 3 * std::sqrt(n / 4));
}

TEST(CloudSample, KnowsTheStationOfAScanWithAGrid) {
  const TemporaryFolder folder;
  const auto file = folder.write("sample-grid.ptx",
                                 "2\n2\n10 20 1.5\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n10 20 1.5 1\n"
                                 "1 0 0 0.5\n1 0 1 0.25\n0 0 0 0.5\n2 1 1 0.75\n");
  Progress progress;
  const auto sample = sampleCloud(file, 1000, progress);
  ASSERT_TRUE(sample) << describe(sample.error());
  ASSERT_TRUE(sample->scans.at(0).station);
  EXPECT_EQ(*sample->scans[0].station, Eigen::Vector3d(10, 20, 1.5));
  EXPECT_EQ(sample->position.at(2), Eigen::Vector3d(12, 21, 2.5));
  EXPECT_EQ(sample->max_intensity, 0.75F);
}

TEST(CloudSample, ThinsAHeapToOnePlace) {
  std::vector<Eigen::Vector3d> places(100000, Eigen::Vector3d(1, 2, 3));
  places.emplace_back(1.2, 2, 3);
  EXPECT_EQ(thinned(places, 0.05, 1000), (std::vector<std::size_t>{0, 100000}));
  EXPECT_EQ(thinned(places, 0.05, 1).size(), 1U);
}

}  // namespace
}  // namespace standpoint
