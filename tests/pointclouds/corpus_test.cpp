// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <sstream>

#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

using testing::KeptScans;

// Points that the manifest states for a file, scan by scan.
std::vector<std::uint64_t> stated(const std::string& points) {
  std::vector<std::uint64_t> counts;
  std::istringstream stream(points);
  for (std::string part; std::getline(stream, part, '+');) counts.push_back(std::stoull(part));
  return counts;
}

class RealClouds : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = testing::sharedFolder() / "corpus" / "pointcloud";
    if (!std::filesystem::exists(folder / "manifest.tsv")) GTEST_SKIP() << "the shared corpus is not here";
  }
  std::filesystem::path folder;
};

TEST_F(RealClouds, HaveThePointsThatTheirManifestStates) {
  std::ifstream manifest(folder / "manifest.tsv");
  std::string line;
  std::getline(manifest, line);
  int files = 0;
  while (std::getline(manifest, line)) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, '\t');) cells.push_back(cell);
    const CloudFormat* format = cloudFormatFor(cells.at(0));
    if (!format || cells.at(4).empty()) continue;
    SCOPED_TRACE(cells[0]);
    KeptScans kept;
    if (cells[0] == "las/PDAL_garbage_nVariableLength.las") {  // six bytes of its last point are missing
      const auto cut = readAll(folder / cells[0], kept);
      ASSERT_FALSE(cut.has_value());
      EXPECT_THAT(describe(cut.error()), ::testing::HasSubstr("space for 718 of 719 points"));
      continue;
    }
    const auto report = readAll(folder / cells[0], kept);
    ASSERT_OK(report);
    const auto info = format->info(folder / cells[0]);
    ASSERT_OK(info);
    const auto counts = stated(cells[4]);
    ASSERT_EQ(kept.scans.size(), counts.size());
    ASSERT_EQ(info->scans.size(), counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i) EXPECT_EQ(kept.scans[i].points.size(), counts[i]);
    ++files;
  }
  EXPECT_EQ(files, 39);
}

TEST_F(RealClouds, PumpLiesWithinTheBoundsThatItsFileStates) {
  KeptScans kept;
  ASSERT_OK(readAll(folder / "e57" / "pumpA_leica_tls_structured_image.e57", kept));
  const auto& [header, points, ended] = kept.scans.at(0);
  EXPECT_EQ(header.rows, 1074u);
  EXPECT_EQ(header.columns, 345u);
  // The file's integers have steps of 1e-6 m and were cut off; a float adds 1e-7.
  const auto [x0, x1] = std::minmax_element(points.x_m.begin(), points.x_m.end());
  const auto [z0, z1] = std::minmax_element(points.z_m.begin(), points.z_m.end());
  EXPECT_NEAR(*x0, -2.903764, 2e-6);
  EXPECT_NEAR(*x1, 1.721604, 2e-6);
  EXPECT_NEAR(*z0, -1.899705, 2e-6);
  EXPECT_NEAR(*z1, 1.843003, 2e-6);
  EXPECT_EQ(*std::max_element(points.row.begin(), points.row.end()), 1073u);
  std::vector<float> intensity = points.intensity;
  std::nth_element(intensity.begin(), intensity.begin() + static_cast<std::ptrdiff_t>(intensity.size() / 2),
                   intensity.end());
  EXPECT_NEAR(intensity[intensity.size() / 2], 0.474, 0.0005);  // measured with another reader
}

TEST_F(RealClouds, BunnyIsTheSameStoredAsDoublesAndAsScaledIntegers) {
  KeptScans doubles, integers;
  ASSERT_OK(readAll(folder / "e57" / "libE57Format_bunnyDouble.e57", doubles));
  ASSERT_OK(readAll(folder / "e57" / "libE57Format_bunnyInt32.e57", integers));
  const PointBlock &a = doubles.scans.at(0).points, &b = integers.scans.at(0).points;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a.x_m[i], b.x_m[i], 2e-6);
}

TEST_F(RealClouds, WithADamagedPageAreRefusedWithItsNumber) {
  KeptScans kept;
  const auto read = readAll(folder / "e57" / "libE57Format_bad-crc.e57", kept);
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().kind, ErrorKind::unusable);
  EXPECT_THAT(describe(read.error()), ::testing::HasSubstr("page 0"));
}

TEST_F(RealClouds, FarFromTheirOriginKeepTheirMillimetres) {
  KeptScans kept;
  const auto report = readAll(folder / "ptx" / "PDAL_1.2-with-color.ptx", kept);
  ASSERT_OK(report);
  const auto& [header, points, ended] = kept.scans.at(0);
  const Eigen::Vector3d first = header.file_from_scanner * Eigen::Vector3d(points.x_m[0], points.y_m[0], points.z_m[0]);
  EXPECT_NEAR(first.x(), 637012.24, 1e-3);
  EXPECT_NEAR(first.y(), 849028.31, 1e-3);
  EXPECT_THAT(testing::said(*report), ::testing::HasSubstr("pose moved by 637012, 849028, 432"));
}

}  // namespace
}  // namespace standpoint
