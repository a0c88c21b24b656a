// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/inspection/panorama.h"

#include <cmath>
#include <numbers>

#include "pointclouds/e57/e57.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

constexpr std::uint32_t kColumns = 128, kRows = 64;

// A ball of 4 m around the station, farther where the azimuth is near 90°, in grey and colour by its height.
PointBlock ball() {
  PointBlock block;
  for (std::uint32_t column = 0; column < kColumns; ++column)
    for (std::uint32_t row = 0; row < kRows; ++row) {
      const double azimuth = (column + 0.5) / kColumns * 2 * std::numbers::pi - std::numbers::pi;
      const double elevation = (row + 0.5) / kRows * std::numbers::pi - std::numbers::pi / 2;
      const double range = std::abs(azimuth - std::numbers::pi / 2) < 0.3 ? 7 : 4;
      block.x_m.push_back(static_cast<float>(range * std::cos(elevation) * std::cos(azimuth)));
      block.y_m.push_back(static_cast<float>(range * std::cos(elevation) * std::sin(azimuth)));
      block.z_m.push_back(static_cast<float>(range * std::sin(elevation)));
      block.intensity.push_back(static_cast<float>(row) / kRows);
      block.row.push_back(row), block.column.push_back(column);
      block.red.push_back(static_cast<std::uint8_t>(row)), block.green.push_back(7), block.blue.push_back(9);
    }
  return block;
}

// A scan of it from each of the poses: S1, S2, …
void writeBalls(const std::filesystem::path& file, const std::vector<Pose>& poses) {
  auto writer = e57::createWriter(file);
  ASSERT_OK(writer);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto header = testing::madeUpHeader({kRows, kColumns, true, false, "S" + std::to_string(i + 1)});
    header.file_from_scanner = poses[i];
    ASSERT_OK((*writer)->begin(header));
    ASSERT_OK((*writer)->write(ball()));
    ASSERT_OK((*writer)->end());
  }
  ASSERT_OK((*writer)->close());
}

Pose turned() {
  Pose pose;
  pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  pose.translation = {10.5, -3, 1.7};
  return pose;
}

TEST(Panorama, PixelsAndDirectionsAreInversesOfEachOther) {
  Panorama p;
  p.width = 64, p.height = 32;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) EXPECT_EQ(p.pixel(p.direction(x, y)), Eigen::Vector2i(x, y));
}

TEST(Panorama, ShowsWhatLiesAheadInTheMiddleAndWhatLiesToTheLeftOnTheLeft) {
  Panorama p;
  p.width = 64, p.height = 32;
  EXPECT_EQ(p.pixel({1, 0, 0}).x(), 32);
  EXPECT_LT(p.pixel({1, 1, 0}).x(), 32);
  EXPECT_LT(p.pixel({1, 0, 1}).y(), 16);
}

TEST(Panorama, KeepsRangeIntensityAndColourAndLeadsBackToThePoint) {
  const TemporaryFolder folder;
  writeBalls(folder / "ball.e57", {turned()});
  Progress progress;
  const auto panorama = readPanorama(folder / "ball.e57", {.scan = {}, .width = 128}, progress);
  ASSERT_OK(panorama);
  EXPECT_EQ(panorama->scans, std::vector<std::string>{"S1"});
  EXPECT_EQ(panorama->points, kColumns * kRows);
  const auto left = panorama->pixel({0, 1, 0}), ahead = panorama->pixel({1, 0.01, 0.01});
  EXPECT_NEAR(panorama->range_m[panorama->at(left.x(), left.y())], 7, 0.01);
  EXPECT_NEAR(panorama->range_m[panorama->at(ahead.x(), ahead.y())], 4, 0.01);
  EXPECT_EQ(panorama->colour[panorama->at(ahead.x(), ahead.y())][1], 7);
  const auto point = panorama->point(ahead.x(), ahead.y());
  ASSERT_TRUE(point);
  EXPECT_LT((*point - turned() * Eigen::Vector3d(4, 0, 0)).norm(), 0.3);
  EXPECT_FALSE(panorama->point(-1, 0));
}

TEST(Panorama, IsAsFineAsThePointsAllow) {
  const TemporaryFolder folder;
  writeBalls(folder / "ball.e57", {turned()});
  Progress progress;
  const auto panorama = readPanorama(folder / "ball.e57", {}, progress);
  ASSERT_OK(panorama);
  EXPECT_EQ(panorama->width, 256);  // the least
}

TEST(Panorama, ShadesFromWhatNearlyAllHaveAtLeastToWhatNearlyAllHaveAtMost) {
  const TemporaryFolder folder;
  writeBalls(folder / "ball.e57", {turned()});
  Progress progress;
  const auto panorama = readPanorama(folder / "ball.e57", {.scan = {}, .width = 128}, progress);
  ASSERT_OK(panorama);
  const auto shades = shadesOf(*panorama, PanoramaChannel::range);
  EXPECT_NEAR(shades.low, 4, 0.01);
  EXPECT_NEAR(shades.high, 7, 0.01);
  const auto intensity = shadesOf(*panorama, PanoramaChannel::intensity);
  EXPECT_LT(intensity.low, 0.05);
  EXPECT_GT(intensity.high, 0.9);
  const auto low = panorama->pixel({1, 0.02, -1}), high = panorama->pixel({1, 0.02, 1});
  EXPECT_LT(intensity.shade[panorama->at(low.x(), low.y())], intensity.shade[panorama->at(high.x(), high.y())]);
}

TEST(Panorama, IsOfAnyScanOfAFile) {
  const TemporaryFolder folder;
  Pose other;
  other.translation = {3, 2, 1};
  writeBalls(folder / "balls.e57", {turned(), other});
  Progress progress;
  const auto first = readPanorama(folder / "balls.e57", {.scan = {}, .width = 128}, progress);
  ASSERT_OK(first);
  EXPECT_EQ(first->scan, 0U);
  EXPECT_EQ(first->scans, (std::vector<std::string>{"S1", "S2"}));
  EXPECT_EQ(first->file_from_scanner.translation, turned().translation);
  const auto second = readPanorama(folder / "balls.e57", {.scan = 1, .width = 128}, progress);
  ASSERT_OK(second);
  EXPECT_EQ(second->scan, 1U);
  EXPECT_EQ(second->points, kColumns * kRows);
  EXPECT_EQ(second->file_from_scanner.translation, other.translation);
}

TEST(Panorama, RefusesAScanThatIsNotThereAndAFileThatIsNone) {
  const TemporaryFolder folder;
  writeBalls(folder / "ball.e57", {turned()});
  Progress progress;
  EXPECT_FALSE(readPanorama(folder / "ball.e57", {.scan = 1, .width = 128}, progress));
  EXPECT_FALSE(readPanorama(folder / "gone.e57", {}, progress));
  EXPECT_FALSE(readPanorama(folder / "ball.txt", {}, progress));
}

}  // namespace
}  // namespace standpoint
