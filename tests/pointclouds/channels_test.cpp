// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "pointclouds/e57/e57.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_picture.h"
#include "tests/pointclouds/made_up_scan.h"
#include "tests/pointclouds/same_points.h"

namespace standpoint {
namespace {

using testing::allPoints;
using testing::expectPlacesWithin;
using testing::expectSameLabels;
using testing::expectSamePoints;
using testing::KeptScans;
using testing::madeUpHeader;
using testing::madeUpPicture;
using testing::writeFile;
using testing::writeScan;
using Projection = StationPicture::Projection;

TEST(E57, ReturnsTimesReturnsAndTruthBitForBit) {
  const TemporaryFolder folder;
  const std::vector<ScanHeader> headers = {madeUpHeader({100, 50, true, true, "A", true}),
                                           madeUpHeader({70, 40, false, false, "B", true}),
                                           madeUpHeader({70, 40, false, false, "C", false})};
  writeFile(folder / "a.e57", headers);
  KeptScans kept;
  const auto report = readAll(folder / "a.e57", kept);
  ASSERT_OK(report);
  EXPECT_TRUE(report->issues.empty()) << testing::said(*report);
  ASSERT_EQ(kept.scans.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(kept.scans[i].header.has_truth, headers[i].has_truth);
    expectSamePoints(kept.scans[i].points, allPoints(headers[i]));
  }
}

TEST(E57, ReturnsThePicturesOfEachStation) {
  const TemporaryFolder folder;
  auto writer = e57::createWriter(folder / "a.e57");
  ASSERT_OK(writer);
  const StationPicture panorama = madeUpPicture(Projection::spherical),
                       front = madeUpPicture(Projection::pinhole, 4003);
  for (const char* name : {"A", "B"}) {
    ScanHeader header = madeUpHeader({20, 30, true, true, name});
    ASSERT_OK((*writer)->begin(header));
    ASSERT_OK((*writer)->picture(panorama));
    ASSERT_OK((*writer)->write(allPoints(header)));
    if (*name == 'B') ASSERT_OK((*writer)->picture(front));
    ASSERT_OK((*writer)->end());
  }
  ASSERT_OK((*writer)->close());
  KeptScans kept;
  const auto report = readAll(folder / "a.e57", kept);
  ASSERT_OK(report);
  EXPECT_TRUE(report->issues.empty()) << testing::said(*report);
  ASSERT_EQ(kept.pictures.size(), 2u);
  ASSERT_EQ(kept.pictures[0].size(), 1u);
  ASSERT_EQ(kept.pictures[1].size(), 2u);
  const auto expectSame = [](const StationPicture& a, const StationPicture& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.projection, b.projection);
    EXPECT_EQ(a.media_type, b.media_type);
    EXPECT_EQ(a.bytes, b.bytes);
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.pixel_width, b.pixel_width);
    EXPECT_EQ(a.pixel_height, b.pixel_height);
    EXPECT_EQ(a.focal_length_m, b.focal_length_m);
    EXPECT_EQ(a.principal_x, b.principal_x);
    EXPECT_EQ(a.principal_y, b.principal_y);
    EXPECT_EQ(a.file_from_camera.translation, b.file_from_camera.translation);
    EXPECT_EQ(a.file_from_camera.rotation.coeffs(), b.file_from_camera.rotation.coeffs());
    EXPECT_EQ(a.acquired_gps_s, b.acquired_gps_s);
  };
  expectSame(kept.pictures[0][0], panorama);
  expectSame(kept.pictures[1][0], panorama);
  expectSame(kept.pictures[1][1], front);
  expectSamePoints(kept.scans[1].points, allPoints(madeUpHeader({20, 30, true, true, "B"})));
}

void writeAs(const std::filesystem::path& file, e57::Coordinates kind, const ScanHeader& header) {
  auto writer = e57::createWriter(file, kind);
  ASSERT_OK(writer);
  ASSERT_OK(writeScan(**writer, header));
  ASSERT_OK((*writer)->close());
}

TEST(E57, OfScaledIntegersIsRightToHalfAStepAndSmaller) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({100, 500, true, true, "A", false});
  header.intensity_min = -2;
  writeAs(folder / "scaled.e57", e57::Coordinates::scaled, header);
  writeFile(folder / "floats.e57", {header});
  KeptScans kept;
  ASSERT_OK(readAll(folder / "scaled.e57", kept));
  const PointBlock points = allPoints(header);
  const auto& scan = kept.scans.at(0);
  ASSERT_EQ(scan.points.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_NEAR(scan.points.x_m[i], points.x_m[i], 0.51e-4);
    ASSERT_NEAR(scan.points.z_m[i], points.z_m[i], 0.51e-4);
    ASSERT_NEAR(scan.points.intensity[i], points.intensity[i], 3 / 65535.0);
  }
  EXPECT_EQ(scan.points.row, points.row);
  EXPECT_EQ(scan.header.intensity_min, -2);
  expectSameLabels(scan, header, points);
  EXPECT_LT(std::filesystem::file_size(folder / "scaled.e57"),
            0.85 * std::filesystem::file_size(folder / "floats.e57"));
}

TEST(E57, OfScaledIntegersRefusesWhatTheyDoNotReach) {
  const TemporaryFolder folder;
  const ScanHeader header = madeUpHeader({4, 4, false, false, "far"});
  PointBlock points = allPoints(header);
  points.y_m[3] = 3400;
  auto writer = e57::createWriter(folder / "a.e57", e57::Coordinates::scaled);
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  const auto written = (*writer)->write(points);
  ASSERT_FALSE(written.has_value());
  EXPECT_THAT(describe(written.error()), ::testing::HasSubstr("more than 3355 m"));
}

TEST(E57, OfSphericalCoordinatesIsRightToAMicrometre) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({100, 50, true, true, "A", true});
  header.file_from_scanner = {};
  writeAs(folder / "a.e57", e57::Coordinates::spherical, header);
  KeptScans kept;
  const auto report = readAll(folder / "a.e57", kept);
  ASSERT_OK(report);
  const PointBlock points = allPoints(header);
  expectPlacesWithin(kept.scans.at(0), header, points, 3e-6);
  EXPECT_EQ(kept.scans[0].points.truth.x_m, points.truth.x_m);
  EXPECT_EQ(kept.scans[0].points.time_s, points.time_s);
}

// Whole scans out of a format that stores places in the file's frame: half a step of 0.1 mm.
void expectBack(const std::filesystem::path& file, const std::vector<ScanHeader>& headers) {
  KeptScans kept;
  const auto report = readAll(file, kept);
  ASSERT_OK(report);
  EXPECT_EQ(report->losses(), 0u) << testing::said(*report);
  ASSERT_EQ(kept.scans.size(), headers.size());
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const PointBlock points = allPoints(headers[i]);
    const KeptScans::Scan& scan = kept.scans[i];
    ASSERT_EQ(scan.points.size(), points.size());
    testing::expectSameHeader(scan.header, headers[i]);
    expectPlacesWithin(scan, headers[i], points, 0.51e-4);
    EXPECT_EQ(scan.points.row, points.row);
    EXPECT_EQ(scan.points.column, points.column);
    EXPECT_EQ(scan.points.red, points.red);
    EXPECT_EQ(scan.points.blue, points.blue);
    EXPECT_EQ(scan.points.channel, points.channel);
    EXPECT_EQ(scan.points.return_number, points.return_number);
    EXPECT_EQ(scan.points.return_count, points.return_count);
    EXPECT_EQ(scan.points.truth.flags, points.truth.flags);
    EXPECT_EQ(scan.points.truth.incidence_rad, points.truth.incidence_rad);
    EXPECT_EQ(scan.points.truth.received_db, points.truth.received_db);
    ASSERT_EQ(scan.points.time_s.size(), points.time_s.size());
    for (std::size_t k = 0; k < points.time_s.size(); ++k) {
      ASSERT_NEAR(scan.points.time_s[k], points.time_s[k], 1e-7);  // a double of 4e8 s has steps of 6e-8
      ASSERT_NEAR(scan.points.truth.x_m[k], points.truth.x_m[k], 1e-4);
      ASSERT_NEAR(scan.points.truth.z_m[k], points.truth.z_m[k], 1e-4);
    }
    for (std::size_t k = 0; k < points.size(); ++k)
      ASSERT_NEAR(scan.points.intensity[k], points.intensity[k], 1.0 / 65535);
    if (headers[i].has_labels) expectSameLabels(scan, headers[i], points);
  }
}

TEST(Las, ReturnsTheStationsOfAFileOfOurs) {
  const TemporaryFolder folder;
  std::vector<ScanHeader> headers = {madeUpHeader({100, 50, true, true, "A", true}),
                                     madeUpHeader({70, 40, true, true, "B\t2", true})};
  headers[1].file_from_scanner.translation += Eigen::Vector3d(150000, -3000, 50);
  for (auto& header : headers) header.coordinate_metadata = "PROJCRS[\"made up\"]";
  writeFile(folder / "a.las", headers);
  expectBack(folder / "a.las", headers);
}

TEST(Ply, ReturnsTheScanWithAllChannels) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({100, 50, true, true, "A\n1", true});
  header.coordinate_metadata = "PROJCRS[\"made up\"]";
  writeFile(folder / "a.ply", {header});
  expectBack(folder / "a.ply", {header});
}

TEST(Pcd, ReturnsTheScanWithAllChannelsAsAGridAndAsAList) {
  const TemporaryFolder folder;
  ScanHeader header = madeUpHeader({100, 50, true, true, "A\n1", true});
  header.coordinate_metadata = "PROJCRS[\"made up\"]";
  writeFile(folder / "grid.pcd", {header});
  expectBack(folder / "grid.pcd", {header});
  auto writer = cloudFormatFor("a.pcd")->variants[0].writer(folder / "list.pcd");
  ASSERT_OK(writer);
  ASSERT_OK(writeScan(**writer, header));
  ASSERT_OK((*writer)->close());
  expectBack(folder / "list.pcd", {header});
  KeptScans grid, list;
  ASSERT_OK(readAll(folder / "grid.pcd", grid));
  ASSERT_OK(readAll(folder / "list.pcd", list));
  expectSamePoints(grid.scans.at(0).points, allPoints(header));  // to the last bit
  expectSamePoints(list.scans.at(0).points, allPoints(header));
}

TEST(Pcd, OfAGridCountsTheReturnsThatShareACell) {
  const TemporaryFolder folder;
  const ScanHeader header = madeUpHeader({4, 4, false, false, "S"});
  PointBlock points;
  for (const std::uint32_t row : {0u, 0u, 2u, 2u, 2u}) {
    points.x_m.push_back(1), points.y_m.push_back(2), points.z_m.push_back(3);
    points.intensity.push_back(0.25f), points.row.push_back(row), points.column.push_back(1);
  }
  auto writer = cloudFormatFor("a.pcd")->writer(folder / "s.pcd");
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  ASSERT_OK((*writer)->write(points));
  ASSERT_OK((*writer)->end());
  ASSERT_OK((*writer)->close());
  EXPECT_THAT(testing::said((*writer)->report()), ::testing::HasSubstr("3 additional returns"));
  KeptScans kept;
  ASSERT_OK(readAll(folder / "s.pcd", kept));
  EXPECT_THAT(kept.scans.at(0).points.row, ::testing::ElementsAre(0u, 2u));
}

TEST(Pcd, OfOthersIsReadAsTextAndBinary) {
  const TemporaryFolder folder;
  testing::putBytes(folder / "a.pcd",
                    "# .PCD v.7\nVERSION .7\nFIELDS x y z rgb normal\nSIZE 4 4 4 4 4\nTYPE F F F F F\nCOUNT 1 1 1 1 3\n"
                    "WIDTH 3\nHEIGHT 1\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 3\nDATA ascii\n"
                    "1 2 3 4.2108e+06 0 0 1\nnan nan nan 0 0 0 0\n-1 0.5 2 3.57331e-43 1 0 0\n");
  KeptScans kept;
  const auto report = readAll(folder / "a.pcd", kept);
  ASSERT_OK(report);
  EXPECT_THAT(testing::said(*report), ::testing::HasSubstr("skipped fields: normal"));
  const auto& scan = kept.scans.at(0);
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.header.file_from_scanner.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(scan.points.red[0], 0x80);  // 4.2108e+06 are the bits 4A808000
  EXPECT_EQ(scan.points.green[0], 0x80);
  EXPECT_EQ(scan.points.blue[1], 255);
}

TEST(TextClouds, KeepANationalGridToAHundredthOfAMillimetre) {
  const TemporaryFolder folder;
  for (const char* name : {"a.pts", "a.xyz", "a.csv"}) {
    SCOPED_TRACE(name);
    ScanHeader header = madeUpHeader({30, 50, true, false, "A", true});
    header.file_from_scanner.translation = {3456789.5, 5600000.123456, -0.25};
    writeFile(folder / name, {header});
    KeptScans kept;
    const auto report = readAll(folder / name, kept);
    ASSERT_OK(report);
    const PointBlock points = allPoints(header);
    expectPlacesWithin(kept.scans.at(0), header, points, 0.6e-5);
    EXPECT_EQ(kept.scans[0].points.green, points.green);
    const bool csv = std::string(name) == "a.csv";
    EXPECT_EQ(kept.scans[0].points.time_s, csv ? points.time_s : std::vector<double>{});
    EXPECT_EQ(kept.scans[0].points.truth.flags, csv ? points.truth.flags : std::vector<std::uint8_t>{});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float read = kept.scans[0].points.intensity[i];
      ASSERT_NEAR(*name == 'a' && std::string(name) == "a.pts" ? (read + 2048) / 4095 : read, points.intensity[i],
                  2e-4);
    }
  }
}

// LAS 1.4 R15, table 17: 38 bytes, red at 30, near infrared at 36.
TEST(Las, OfPointFormat8HasRoomForNearInfraredAndSaysThatItIsEmpty) {
  const TemporaryFolder folder;
  for (const bool colour : {true, false}) {
    const ScanHeader header = madeUpHeader({30, 20, colour, true, "A", colour});
    auto writer = writerOf(*cloudFormatFor("a.las"), "pdrf8").value()(folder / "a.las");
    ASSERT_OK(writer);
    ASSERT_OK(writeScan(**writer, header));
    ASSERT_OK((*writer)->close());
    EXPECT_THAT(testing::said((*writer)->report()), ::testing::HasSubstr("near infrared"));
    if (colour) expectBack(folder / "a.las", {header});
    const std::string bytes = testing::bytesOf(folder / "a.las");
    EXPECT_EQ(bytes[104], 8);
    const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
    const std::size_t length = 38 + 4 * 4 + (colour ? 1 + 3 * 4 + 3 * 4 + 1 : 0);  // labels, grid; channel, truth
    EXPECT_EQ(at(105), length);
    const std::size_t record = at(96) | at(97) << 8U;
    const PointBlock points = allPoints(header);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(at(record + length * i + 31), colour ? points.red[i] : 0);
      EXPECT_EQ(at(record + length * i + 36), 0);
    }
  }
}

TEST(Las, OfAnotherTableOfLabelsPutsItBehindTheFirst) {
  const TemporaryFolder folder;
  std::vector<ScanHeader> headers = {madeUpHeader({10, 20, false, true, "A"}), madeUpHeader({10, 20, false, true, "B"}),
                                     madeUpHeader({10, 20, false, true, "C"})};
  headers[1].products = {{"#77", "g", "IfcSlab", "floor"}};
  writeFile(folder / "a.las", headers);
  KeptScans kept;
  ASSERT_OK(readAll(folder / "a.las", kept));
  ASSERT_EQ(kept.scans.size(), 3u);
  const auto& scan = kept.scans[1];
  EXPECT_EQ(scan.header.products.at(scan.points.product.at(0)).id, "#77");
  const PointBlock points = allPoints(headers[2]);
  EXPECT_EQ(kept.scans[2].points.product, points.product);  // the table of the first
  EXPECT_EQ(kept.scans[2].header.products.at(points.product[5]).name, headers[2].products.at(points.product[5]).name);
}

TEST(Las, RefusesAStationBeyondItsIntegers) {
  const TemporaryFolder folder;
  std::vector<ScanHeader> headers = {madeUpHeader({10, 20, false, true, "A"}),
                                     madeUpHeader({10, 20, false, true, "B"})};
  headers[1].file_from_scanner.translation.x() += 220000;
  auto writer = cloudFormatFor("a.las")->writer(folder / "a.las");
  ASSERT_OK(writer);
  ASSERT_OK(writeScan(**writer, headers[0]));
  const auto written = writeScan(**writer, headers[1]);
  ASSERT_FALSE(written.has_value());
  EXPECT_THAT(describe(written.error()), ::testing::HasSubstr("more than 214 km"));
}

TEST(CloudWriters, ListTheChannelsThatTheyHaveNoPlaceFor) {
  const TemporaryFolder folder;
  const ScanHeader header = madeUpHeader({4, 4, true, true, "A", true});
  auto writer = cloudFormatFor("a.ptx")->writer(folder / "a.ptx");
  ASSERT_OK(writer);
  ASSERT_OK((*writer)->begin(header));
  ASSERT_OK((*writer)->picture(madeUpPicture(Projection::spherical)));
  const std::string said = testing::said((*writer)->report());
  for (const char* word : {"labels", "times", "return numbers", "true positions", "images"})
    EXPECT_THAT(said, ::testing::HasSubstr(word));
}

}  // namespace
}  // namespace standpoint
