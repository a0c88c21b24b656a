// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cmath>
#include <functional>

#include "pointclouds/e57/e57.h"
#include "pointclouds/ptx/ptx.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"
#include "tests/pointclouds/same_points.h"

namespace standpoint {
namespace {

using testing::allPoints;
using testing::appendColumn;
using testing::bits;
using testing::expectSameHeader;
using testing::expectSameLabels;
using testing::expectSamePoints;
using testing::KeptScans;
using testing::madeUpHeader;
using testing::ScanKind;
using testing::writeFile;
using testing::writeScan;

TEST(E57, ReturnsThreeScansBitForBit) {
  const TemporaryFolder folder;
  std::vector<ScanHeader> headers = {madeUpHeader({100, 50, true, true, "A"}),
                                     madeUpHeader({70, 40, false, false, "B ü"}),
                                     madeUpHeader({90, 30, false, true, "C"})};
  for (auto& header : headers) header.coordinate_metadata = "PROJCRS[\"made up\"]";
  headers[2].intensity_min = -3.5;
  headers[2].intensity_max = 2048.25;
  writeFile(folder / "three.e57", headers);
  KeptScans kept;
  const auto report = readAll(folder / "three.e57", kept);
  ASSERT_OK(report);
  EXPECT_TRUE(report->issues.empty()) << testing::said(*report);
  ASSERT_EQ(kept.scans.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const PointBlock points = allPoints(headers[i]);
    EXPECT_TRUE(kept.scans[i].ended);
    EXPECT_EQ(kept.scans[i].header.rows, headers[i].rows);
    EXPECT_EQ(kept.scans[i].header.columns, headers[i].columns);
    expectSameHeader(kept.scans[i].header, headers[i]);
    expectSamePoints(kept.scans[i].points, points);
    expectSameLabels(kept.scans[i], headers[i], points);
  }
}

TEST(E57, HasTheSameBytesHoweverThePointsAreSplitIntoBlocks) {
  const TemporaryFolder folder;
  writeFile(folder / "a.e57", {madeUpHeader({})}, 1);
  writeFile(folder / "b.e57", {madeUpHeader({})}, 50);
  EXPECT_EQ(testing::bytesOf(folder / "a.e57"), testing::bytesOf(folder / "b.e57"));
}

// A packet of this layout holds some 2,500 records: sizes on both sides of one and of two packets, and of 8 and 32
// records.
TEST(E57, HoldsAnyNumberOfPointsAroundPacketsAndWords) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({1, 8000, true, true, "S"});
  PointBlock all;
  for (std::uint32_t c = 0; c < header.columns; ++c) appendColumn(all, header, c);
  ASSERT_GT(all.size(), 6000u);
  std::vector<std::size_t> sizes = {0, 1, 2, 7, 8, 9, 31, 32, 33};
  for (std::size_t n = 2400; n <= 2720; n += 32)
    for (const std::size_t near : {n - 1, n, n + 1, 2 * n}) sizes.push_back(near);
  for (const std::size_t n : sizes) {
    PointBlock some = all;
    for (auto* v : {&some.x_m, &some.y_m, &some.z_m, &some.intensity}) v->resize(n);
    for (auto* v : {&some.row, &some.column, &some.product, &some.material}) v->resize(n);
    for (auto* v : {&some.red, &some.green, &some.blue}) v->resize(n);
    auto writer = e57::createWriter(folder / "n.e57");
    ASSERT_OK(writer);
    ASSERT_OK((*writer)->begin(header));
    ASSERT_OK((*writer)->write(some));
    ASSERT_OK((*writer)->end());
    ASSERT_OK((*writer)->close());
    KeptScans kept;
    ASSERT_OK(readAll(folder / "n.e57", kept));
    ASSERT_EQ(kept.scans.at(0).points.size(), n);
    expectSamePoints(kept.scans[0].points, some);
    ASSERT_EQ(kept.scans[0].points.material, some.material) << n;
  }
}

TEST(E57, KeepsAPoseToTheLastBit) {
  const TemporaryFolder folder;
  std::vector<ScanHeader> headers;
  const double extremes[] = {5000000.000000001, -4999999.9999999991, 1e-300, 0.1 + 0.2, 123456.78901234567};
  for (std::size_t i = 0; i < std::size(extremes); ++i) {
    ScanHeader header = madeUpHeader({3, 3, false, false, "S" + std::to_string(i)});
    header.file_from_scanner.translation = {extremes[i], -extremes[i], std::nextafter(extremes[i], 1e9)};
    const double t = static_cast<double>(i);
    header.file_from_scanner.rotation =
        Eigen::Quaterniond(std::cos(t / 3), 0.3 * std::sin(t), -std::sin(t / 3), 1e-9 * t).normalized();
    headers.push_back(header);
  }
  headers[0].file_from_scanner.rotation = Eigen::Quaterniond(0, 1, 0, 0);
  writeFile(folder / "poses.e57", headers);
  KeptScans kept;
  ASSERT_OK(readAll(folder / "poses.e57", kept));
  ASSERT_EQ(kept.scans.size(), headers.size());
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const Pose& pose = kept.scans[i].header.file_from_scanner;
    EXPECT_EQ(pose.translation, headers[i].file_from_scanner.translation);
    Eigen::Vector4d written = headers[i].file_from_scanner.rotation.coeffs();
    if (written.w() < 0) written = -written;
    // "normalized" leaves an error of up to two units, which the writer takes out.
    EXPECT_LE((pose.rotation.coeffs() - written).cwiseAbs().maxCoeff(), 0x4p-53);
    EXPECT_GE(pose.rotation.w(), 0);
  }
}

TEST(E57, WithoutAGridOrIntensityHasNoSuchFields) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({10, 10, false, false, "S"});
  PointBlock points = allPoints(header);
  header.rows = header.columns = 0;
  header.intensity_min = header.intensity_max = 0;
  auto writer = e57::createWriter(folder / "bare.e57");
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  ASSERT_OK((*writer)->write(points));
  ASSERT_OK((*writer)->end());
  ASSERT_OK((*writer)->close());
  KeptScans kept;
  ASSERT_OK(readAll(folder / "bare.e57", kept));
  EXPECT_EQ(kept.scans.at(0).header.rows, 0u);
  EXPECT_EQ(kept.scans[0].header.intensity_max, kept.scans[0].header.intensity_min);
  EXPECT_EQ(bits(kept.scans[0].points.x_m), bits(points.x_m));
}

TEST(E57, RefusesPointsThatBreakThePromisesOfTheHeader) {
  const TemporaryFolder folder;
  const ScanHeader header = madeUpHeader({10, 10, true, true, "S"});
  const PointBlock good = allPoints(header);
  const std::vector<std::pair<const char*, std::function<void(PointBlock&)>>> faults = {
      {"row", [](PointBlock& b) { b.row[5] = 10; }},
      {"column", [](PointBlock& b) { b.column[5] = 4000000000u; }},
      {"label", [](PointBlock& b) { b.material[5] = 5; }},
      {"not finite", [](PointBlock& b) { b.y_m[5] = NAN; }},
      {"not finite", [](PointBlock& b) { b.intensity[5] = INFINITY; }},
      {"differ in size", [](PointBlock& b) { b.red.pop_back(); }}};
  for (const auto& [word, spoil] : faults) {
    PointBlock bad = good;
    spoil(bad);
    auto writer = e57::createWriter(folder / "bad.e57");
    ASSERT_OK(writer);
    ASSERT_OK((*writer)->begin(header));
    const auto written = (*writer)->write(bad);
    ASSERT_FALSE(written.has_value()) << word;
    EXPECT_THAT(written.error().message, ::testing::HasSubstr(word));
  }
}

TEST(CloudWriters, RefuseAHeaderWithoutAPose) {
  const TemporaryFolder folder;
  for (auto& format : cloudFormats()) {
    if (!format.writer) continue;
    ScanHeader header = madeUpHeader({});
    header.file_from_scanner.translation.y() = NAN;
    auto writer = format.writer(folder / (std::string("bad") + format.extension));
    ASSERT_OK(writer);
    EXPECT_FALSE((*writer)->begin(header).has_value()) << format.name;
  }
}

TEST(Ptx, ReturnsWhatATextOfTheGridCanHold) {
  const TemporaryFolder folder;
  std::vector<ScanHeader> headers = {madeUpHeader({100, 50, true, false, "A"}),
                                     madeUpHeader({70, 40, false, false, "B"}), madeUpHeader({1, 1, true, false, "C"})};
  writeFile(folder / "three.ptx", headers);
  KeptScans kept;
  ASSERT_OK(readAll(folder / "three.ptx", kept));
  ASSERT_EQ(kept.scans.size(), 3u);
  for (std::size_t i = 0; i < 2; ++i) {
    expectSamePoints(kept.scans[i].points, allPoints(headers[i]));
    EXPECT_EQ(kept.scans[i].header.rows, headers[i].rows);
    EXPECT_EQ(kept.scans[i].header.columns, headers[i].columns);
    const Pose &read = kept.scans[i].header.file_from_scanner, &written = headers[i].file_from_scanner;
    EXPECT_EQ(read.translation, written.translation);
    EXPECT_LT((read.rotation.coeffs() - written.rotation.coeffs()).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(Ptx, CountsTheReturnsThatShareACell) {
  const TemporaryFolder folder;
  const ScanHeader header = madeUpHeader({4, 4, false, false, "S"});
  PointBlock points;
  for (const std::uint32_t row : {0u, 0u, 2u, 2u, 2u}) {
    points.x_m.push_back(1), points.y_m.push_back(2), points.z_m.push_back(3);
    points.intensity.push_back(0.25f), points.row.push_back(row), points.column.push_back(1);
  }
  auto writer = ptx::createWriter(folder / "s.ptx");
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  ASSERT_OK((*writer)->write(points));
  ASSERT_OK((*writer)->end());
  ASSERT_OK((*writer)->close());
  EXPECT_EQ((*writer)->report().losses(), 1u);
  EXPECT_THAT(testing::said((*writer)->report()), ::testing::HasSubstr("3 additional returns"));
  KeptScans kept;
  ASSERT_OK(readAll(folder / "s.ptx", kept));
  EXPECT_THAT(kept.scans.at(0).points.row, ::testing::ElementsAre(0u, 2u));
}

TEST(Ptx, DoesNotFillTheDiskWithAGridThatIsAllButEmpty) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({4, 4, false, false, "S"});
  header.rows = header.columns = 60000;
  PointBlock point;
  point.x_m = point.y_m = point.z_m = {1.f};
  point.intensity = {0.5f};
  point.row = point.column = {59999};
  auto writer = ptx::createWriter(folder / "s.ptx");
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  const auto written = (*writer)->write(point);
  ASSERT_FALSE(written.has_value());
  EXPECT_EQ(written.error().kind, ErrorKind::unusable);
}

TEST(Ptx, OfAScanWithoutAGridIsOneRow) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({10, 10, true, false, "S"});
  const PointBlock points = allPoints(header);
  header.rows = header.columns = 0;
  auto writer = ptx::createWriter(folder / "s.ptx");
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  ASSERT_OK((*writer)->write(points));
  ASSERT_OK((*writer)->end());
  ASSERT_OK((*writer)->close());
  KeptScans kept;
  ASSERT_OK(readAll(folder / "s.ptx", kept));
  EXPECT_EQ(kept.scans.at(0).header.columns, points.size());
  EXPECT_EQ(kept.scans[0].header.rows, 1u);
  EXPECT_EQ(bits(kept.scans[0].points.z_m), bits(points.z_m));
}

}  // namespace
}  // namespace standpoint
