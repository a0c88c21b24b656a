// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstring>

#include "pointclouds/ply/ply.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
using testing::KeptScans;

template <class T>
std::string binary(T value, bool big_endian) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

constexpr const char* kProperties =
    "element vertex 2\nproperty uchar blue\nproperty uchar red\nproperty double z\nproperty short quality\n"
    "property double y\nproperty double x\nproperty uchar green\nproperty float scalar_Intensity\nend_header\n";

std::string madeUp(const std::string& format) {
  std::string text = "ply\r\nformat " + format + " 1.0\ncomment a\n" + kProperties;
  for (const double x : {600000.25, 600001.5}) {
    if (format == "ascii") {
      text += "3 1 7.5 -9 5000000.125 " + std::to_string(x) + " 2 0.75\n";
      continue;
    }
    const bool big = format == "binary_big_endian";
    text += std::string("\x03\x01") + binary(7.5, big) + binary(std::int16_t{-9}, big) + binary(5000000.125, big) +
            binary(x, big) + "\x02" + binary(0.75F, big);
  }
  return text;
}

TEST(PlyCloud, IsTheSameInItsThreeEncodingsAndWhateverTheOrder) {
  const TemporaryFolder folder;
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE(format);
    testing::putBytes(folder / "a.ply", madeUp(format));
    KeptScans kept;
    const auto report = readAll(folder / "a.ply", kept);
    ASSERT_OK(report);
    const auto& [header, points, ended] = kept.scans.at(0);
    ASSERT_EQ(points.size(), 2u);
    const Eigen::Vector3d p = header.file_from_scanner * Eigen::Vector3d(points.x_m[1], points.y_m[1], points.z_m[1]);
    EXPECT_EQ(p, Eigen::Vector3d(600001.5, 5000000.125, 7.5));
    EXPECT_EQ(points.intensity[1], 0.75F);
    EXPECT_EQ(points.red[0], 1);
    EXPECT_EQ(points.green[0], 2);
    EXPECT_EQ(points.blue[0], 3);
    EXPECT_THAT(testing::said(*report), HasSubstr("skipped vertex properties: quality"));
  }
}

TEST(PlyCloud, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  const ScanHeader header = testing::madeUpHeader({30, 20, true, true, "S"});
  auto writer = ply::createWriter(folder / "a.ply");
  ASSERT_OK(writer);
  ASSERT_OK(testing::writeScan(**writer, header));
  ASSERT_OK((*writer)->close());
  PointBlock all;
  for (std::uint32_t c = 0; c < 20; ++c) testing::appendColumn(all, header, c);
  KeptScans kept;
  ASSERT_OK(readAll(folder / "a.ply", kept));
  const auto& [read, points, ended] = kept.scans.at(0);
  ASSERT_EQ(points.size(), all.size());
  EXPECT_EQ(points.red, all.red);
  EXPECT_EQ(points.intensity, all.intensity);
  const auto info = ply::info(folder / "a.ply");
  ASSERT_OK(info);
  EXPECT_EQ(info->scans.at(0).points, all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::Vector3d was = header.file_from_scanner * Eigen::Vector3d(all.x_m[i], all.y_m[i], all.z_m[i]);
    const Eigen::Vector3d is = read.file_from_scanner * Eigen::Vector3d(points.x_m[i], points.y_m[i], points.z_m[i]);
    ASSERT_LT((was - is).norm(), 2e-6);
  }
}

TEST(PlyCloud, OfAMeshIsItsVerticesAndTheFacesAreLostAloud) {
  const TemporaryFolder folder;
  testing::putBytes(
      folder / "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_TRUE(ply::hasFaces(folder / "m.ply"));
  EXPECT_EQ(readableCloudFormat(folder / "m.ply"), nullptr);
  KeptScans kept;
  const auto report = readAll(folder / "m.ply", kept);
  ASSERT_OK(report);
  EXPECT_EQ(kept.scans.at(0).points.size(), 3u);
  EXPECT_THAT(testing::said(*report), HasSubstr("1 faces skipped"));
}

TEST(HostilePlyCloud, IsRefusedAtOnceWithLineAndReason) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  const std::pair<std::string, const char*> bad[] = {
      {"plyx\n", "is not a PLY file"},
      {"ply\nformat ascii 1.0\nelement vertex 1000000000000\n" + xyz + "end_header\n1 2 3\n",
       "no space for 1000000000000"},
      {"ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" + xyz + "end_header\nabc",
       "no space"},
      {"ply\nformat binary_little_endian 1.0\nelement edge 9999999999\nproperty int a\nelement vertex 1\n" + xyz +
           "end_header\nabc",
       "no space for 9999999999 elements 'edge'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1      \n", "no property 'y'"},
      {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float128 x\nend_header\n1\n", "not a property type"},
      {"ply\nformat ascii 1.0\nelement vertex 1\n" + xyz, "truncated inside its header"},
      {"ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "end_header\n1 2 3\n11111111 2\n", "3 numbers here"},
      {"ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "end_header\n1 2 3         \n", "truncated"}};
  const TemporaryFolder folder;
  for (const auto& [text, says] : bad) {
    testing::putBytes(folder / "bad.ply", text);
    KeptScans kept;
    const auto read = readAll(folder / "bad.ply", kept);
    ASSERT_FALSE(read.has_value()) << says;
    EXPECT_EQ(read.error().kind, ErrorKind::unusable);
    EXPECT_THAT(read.error().message, HasSubstr(says));
    EXPECT_THAT(read.error().source, ::testing::StartsWith("bad.ply line "));
  }
}

}  // namespace
}  // namespace standpoint
