// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/las/las.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/pointclouds/kept_scans.h"
#include "tests/pointclouds/made_up_scan.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
using testing::KeptScans;

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  if (bytes.size() < at + sizeof value) bytes.resize(at + sizeof value, '\0');
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

// The record lengths and places of colour as the standard's tables (LAS 1.4 R15, tables 7 to 17) have them.
constexpr std::uint16_t kLength[11] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::size_t kColour[11] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};

struct Made {
  int minor = 4, format = 7;
  std::uint32_t points = 3;
  std::uint16_t extra_bytes = 0;
  std::string record;  // a variable-length record before the points
  std::uint16_t colour = 0x1100;
};

std::string variableRecord(const std::string& user, std::uint16_t id, const std::string& body) {
  std::string bytes(54, '\0');
  std::memcpy(bytes.data() + 2, user.data(), user.size());
  put<std::uint16_t>(bytes, 18, id);
  put<std::uint16_t>(bytes, 20, static_cast<std::uint16_t>(body.size()));
  return bytes + body;
}

std::string las(const Made& m) {
  const std::uint16_t header = m.minor == 4 ? 375 : m.minor == 3 ? 235 : 227;
  std::string b(header, '\0');
  std::memcpy(b.data(), "LASF", 4);
  put<std::uint8_t>(b, 24, 1), put<std::uint8_t>(b, 25, static_cast<std::uint8_t>(m.minor));
  put<std::uint16_t>(b, 94, header);
  put<std::uint32_t>(b, 96, static_cast<std::uint32_t>(header + m.record.size()));
  put<std::uint32_t>(b, 100, m.record.empty() ? 0 : 1);
  put<std::uint8_t>(b, 104, static_cast<std::uint8_t>(m.format));
  const auto length = static_cast<std::uint16_t>(kLength[m.format] + m.extra_bytes);
  put<std::uint16_t>(b, 105, length);
  put<std::uint32_t>(b, 107, m.format < 6 ? m.points : 0);
  for (std::size_t k = 0; k < 3; ++k) put<double>(b, 131 + 8 * k, 0.001);
  put<double>(b, 155, 500000.0), put<double>(b, 163, 5400000.0), put<double>(b, 171, 100.0);
  if (m.minor == 4) put<std::uint64_t>(b, 247, m.points);
  b += m.record;
  for (std::uint32_t i = 0; i < m.points; ++i) {
    const std::size_t at = b.size();
    put<std::int32_t>(b, at, static_cast<std::int32_t>(1000 * i));
    put<std::int32_t>(b, at + 4, -250), put<std::int32_t>(b, at + 8, 7);
    put<std::uint16_t>(b, at + 12, static_cast<std::uint16_t>(100 * i));
    if (const auto colour = kColour[m.format]; colour > 0)
      put<std::uint16_t>(b, at + colour, m.colour), put<std::uint16_t>(b, at + colour + 4, std::uint16_t{0x00FF});
    b.resize(at + length, '\x55');
  }
  return b;
}

TEST(Las, OfEveryPointFormatGivesItsCoordinates) {
  const TemporaryFolder folder;
  for (int format = 0; format <= 10; ++format) {
    SCOPED_TRACE(format);
    const int minor = format < 6 ? format < 4 ? 2 : 3 : 4;
    testing::putBytes(folder / "a.las", las({.minor = minor, .format = format, .extra_bytes = 5}));
    KeptScans kept;
    const auto report = readAll(folder / "a.las", kept);
    ASSERT_OK(report);
    ASSERT_EQ(kept.scans.size(), 1u);
    const auto& [header, points, ended] = kept.scans[0];
    ASSERT_EQ(points.size(), 3u);
    const Eigen::Vector3d last =
        header.file_from_scanner * Eigen::Vector3d(points.x_m[2], points.y_m[2], points.z_m[2]);
    EXPECT_NEAR(last.x(), 500002.0, 1e-6);
    EXPECT_NEAR(last.y(), 5399999.75, 1e-6);
    EXPECT_NEAR(last.z(), 100.007, 1e-6);
    EXPECT_EQ(points.intensity[2], 200);
    EXPECT_EQ(header.has_colour, kColour[format] > 0);
    if (header.has_colour) {
      EXPECT_EQ(points.red[1], 0x11);
    }
    EXPECT_THAT(testing::said(*report), HasSubstr("5 extra bytes"));
  }
}

TEST(Las, WithEightBitColoursIsTakenAsSuchAndSaysSo) {
  const TemporaryFolder folder;
  testing::putBytes(folder / "a.las", las({.colour = 0x00C8}));
  KeptScans kept;
  const auto report = readAll(folder / "a.las", kept);
  ASSERT_OK(report);
  EXPECT_EQ(kept.scans[0].points.red[0], 200);
  EXPECT_THAT(testing::said(*report), HasSubstr("read as 8 bits"));
}

TEST(Las, NamesTheCoordinateSystemOfItsKeysAndOfItsText) {
  const TemporaryFolder folder;
  std::string keys(16, '\0');
  put<std::uint16_t>(keys, 0, 1), put<std::uint16_t>(keys, 6, 1);
  put<std::uint16_t>(keys, 8, 3072), put<std::uint16_t>(keys, 12, 1), put<std::uint16_t>(keys, 14, 25832);
  testing::putBytes(folder / "keys.las", las({.record = variableRecord("LASF_Projection", 34735, keys)}));
  const auto by_keys = las::info(folder / "keys.las");
  ASSERT_OK(by_keys);
  EXPECT_EQ(by_keys->crs, "EPSG:25832");
  const std::string wkt = "PROJCRS[\"made up\"]";
  testing::putBytes(folder / "text.las", las({.record = variableRecord("LASF_Projection", 2112, wkt + '\0')}));
  const auto by_text = las::info(folder / "text.las");
  ASSERT_OK(by_text);
  EXPECT_EQ(by_text->crs, wkt);
  EXPECT_EQ(by_text->scans[0].header.coordinate_metadata, wkt);
}

TEST(Las, OfAdjustedTimesBeginsAtTheSecondOfItsFirstPoint) {
  const TemporaryFolder folder;
  std::string bytes = las({});
  put<std::uint16_t>(bytes, 6, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    put<double>(bytes, 375 + 36 * i + 22, 450000000.75 + 2.5 * static_cast<double>(i));
    bytes[375 + 36 * i + 14] = static_cast<char>(i == 2 ? 0x00 : 0x31);  // 1 of 3; of the last the bits make no sense
  }
  testing::putBytes(folder / "a.las", bytes);
  KeptScans kept;
  const auto report = readAll(folder / "a.las", kept);
  ASSERT_OK(report);
  const auto& [header, points, ended] = kept.scans.at(0);
  EXPECT_EQ(header.acquisition_start_gps_s, 1450000000.0);
  EXPECT_THAT(points.time_s, ::testing::ElementsAre(0.75, 3.25, 5.75));
  EXPECT_THAT(points.return_count, ::testing::ElementsAre(3, 3, 1));
  EXPECT_THAT(testing::said(*report), HasSubstr("1 invalid return numbers were set to 1 of 1"));
}

TEST(Las, ReadsTheCoordinateSystemBehindThePoints) {
  const TemporaryFolder folder;
  std::string bytes = las({});
  put<std::uint64_t>(bytes, 235, bytes.size());
  put<std::uint32_t>(bytes, 243, 1);
  std::string record(60, '\0');
  std::memcpy(record.data() + 2, "LASF_Projection", 15);
  put<std::uint16_t>(record, 18, 2112), put<std::uint64_t>(record, 20, 4);
  testing::putBytes(folder / "a.las", bytes + record + "WKT!");
  const auto info = las::info(folder / "a.las");
  ASSERT_OK(info);
  EXPECT_EQ(info->crs, "WKT!");
}

struct Fault {
  const char* says;
  void (*spoil)(std::string&);
};

TEST(HostileLas, IsRefusedAtOnceWithTheReason) {
  const Fault faults[] = {
      {"is not a LAS file", [](std::string& b) { b[0] = 'X'; }},
      {"LAS 2.4 is not supported", [](std::string& b) { b[24] = 2; }},
      {"compressed points (LAZ)", [](std::string& b) { b[104] = static_cast<char>(b[104] | 0x80); }},
      {"point format 11", [](std::string& b) { b[104] = 11; }},
      {"a point record has 0 bytes", [](std::string& b) { put<std::uint16_t>(b, 105, 0); }},
      {"space for 3 of 1000000000000 points", [](std::string& b) { put<std::uint64_t>(b, 247, 1000000000000); }},
      {"point data offset is byte 4294967295", [](std::string& b) { put<std::uint32_t>(b, 96, 0xFFFFFFFF); }},
      {"point data offset is byte 10", [](std::string& b) { put<std::uint32_t>(b, 96, 10); }},
      {"has 375 bytes, this one 12", [](std::string& b) { put<std::uint16_t>(b, 94, 12); }},
      {"scale or offset of y", [](std::string& b) { put<double>(b, 139, 0); }},
      {"scale or offset of x", [](std::string& b) { put<double>(b, 131, NAN); }},
      {"scale or offset of z", [](std::string& b) { put<double>(b, 171, INFINITY); }},
      {"truncated inside its header", [](std::string& b) { b.resize(200); }}};
  const TemporaryFolder folder;
  for (const Fault& fault : faults) {
    std::string bytes = las({});
    fault.spoil(bytes);
    testing::putBytes(folder / "bad.las", bytes);
    KeptScans kept;
    const auto read = readAll(folder / "bad.las", kept);
    ASSERT_FALSE(read.has_value()) << fault.says;
    EXPECT_EQ(read.error().kind, ErrorKind::unusable);
    EXPECT_THAT(read.error().message, HasSubstr(fault.says));
    EXPECT_THAT(read.error().source, ::testing::StartsWith("bad.las"));
  }
}

TEST(HostileLas, WithWrongCountsOfRecordsStillGivesItsPoints) {
  const TemporaryFolder folder;
  std::string bytes = las({});
  put<std::uint32_t>(bytes, 100, 0xFFFFFFFF);
  put<std::uint64_t>(bytes, 235, std::numeric_limits<std::uint64_t>::max() - 3);
  put<std::uint32_t>(bytes, 243, 0xFFFFFFFF);
  testing::putBytes(folder / "a.las", bytes);
  KeptScans kept;
  const auto report = readAll(folder / "a.las", kept);
  ASSERT_OK(report);
  EXPECT_EQ(kept.scans[0].points.size(), 3u);
  EXPECT_THAT(testing::said(*report), HasSubstr("extended variable-length records, of which 0"));
}

TEST(HostileLas, WithAScaleBeyondAllNumbersLosesThePointsAloud) {
  const TemporaryFolder folder;
  for (const double scale : {1e306, 3e38 / 1000}) {  // no numbers; some whose distance is none
    std::string bytes = las({});
    put<double>(bytes, 131, scale);
    put<double>(bytes, 155, scale > 1e300 ? 0 : -3e38);
    testing::putBytes(folder / "a.las", bytes);
    KeptScans kept;
    const auto report = readAll(folder / "a.las", kept);
    ASSERT_OK(report);
    EXPECT_THAT(testing::said(*report), HasSubstr("2 points are not finite"));
    for (const auto& scan : kept.scans)
      for (const float x : scan.points.x_m) EXPECT_TRUE(std::isfinite(x));
  }
}

}  // namespace
}  // namespace standpoint
