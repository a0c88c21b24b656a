// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/las/las_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "pointclouds/files/escaped_text.h"
#include "pointclouds/files/number_text.h"
#include "pointclouds/files/scan_text.h"

namespace standpoint::las {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS numbers are little-endian and copied as they stand");

constexpr std::uint64_t kLongestRecord = 1 << 20;  // of a coordinate system; real ones have some kilobytes
constexpr std::uint64_t kLongestText = 1 << 26;    // of the stations and labels of a file of ours
constexpr std::size_t kMostScans = 65535, kMostEntries = std::size_t{1} << 24;
constexpr std::uint32_t kMostRecords = 100000;
constexpr std::uint16_t kGeoKeys = 34735, kWkt = 2112;

constexpr const char* kPlain = "classification, scan angle, user data, point source";
constexpr const char* kWaves = "classification, scan angle, user data, point source, waveform";
constexpr const char* kInfrared = "classification, scan angle, user data, point source, near infrared";
constexpr const char* kAll = "classification, scan angle, user data, point source, near infrared, waveform";
constexpr std::array<PointFormat, 11> kFormats = {{{20, 0, 0, kPlain},
                                                   {28, 0, 20, kPlain},
                                                   {26, 20, 0, kPlain},
                                                   {34, 28, 20, kPlain},
                                                   {57, 0, 20, kWaves},
                                                   {63, 28, 20, kWaves},
                                                   {30, 0, 22, kPlain},
                                                   {36, 30, 22, kPlain},
                                                   {38, 30, 22, kInfrared},
                                                   {59, 0, 22, kWaves},
                                                   {67, 30, 22, kAll}}};

template <class T>
T loadAt(std::span<const std::uint8_t> bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string textOf(std::span<const std::uint8_t> bytes) {
  const auto end = std::find(bytes.begin(), bytes.end(), 0);
  return {bytes.begin(), end};
}

// A list of variable-length records.
struct RecordList {
  std::uint64_t begins_at = 0;
  std::uint32_t records = 0;
  std::size_t head_bytes = 0;
  std::uint64_t ends_at = 0;  // no record reaches beyond it
  bool extended = false;      // its lengths have 64 bits
};

class HeaderReader {
 public:
  HeaderReader(const InputFile& file, Report& report) : file_(file), report_(report), place_(file.name() + " header") {}
  Result<Header> read();

 private:
  tl::unexpected<Error> broken(const std::string& what) const { return failure(ErrorKind::unusable, what, place_); }
  Result<void> readFormat();
  Result<void> readScale();
  Result<void> readCount();
  Result<void> readList(const RecordList& list);
  Result<void> readRecords();
  Result<void> readExtendedRecords();
  Result<void> take(const std::string& user, std::uint16_t id, std::uint64_t at, std::uint64_t length);
  void takeExtras(std::span<const std::uint8_t> bytes);
  void takeOurs(std::string_view text);
  void checkScans();
  void takeGeoKeys(std::span<const std::uint8_t> keys);

  const InputFile& file_;
  Report& report_;
  std::string place_;
  std::vector<std::uint8_t> block_;
  Header header_;
};

Result<void> HeaderReader::readFormat() {
  const auto raw = block_[104];
  if (raw >= 0x40)
    return broken(
        "compressed points (LAZ) are not supported: convert to LAS first, for instance with `laszip -i FILE.laz -o "
        "FILE.las`, `pdal translate` or CloudCompare");
  header_.point_format = raw;
  if (header_.point_format >= static_cast<int>(kFormats.size()))
    return broken("point format " + std::to_string(raw) + " is not supported; supported: 0 to 10");
  header_.record_bytes = loadAt<std::uint16_t>(block_, 105);
  const auto least = pointFormat(header_).bytes;
  if (header_.record_bytes < least)
    return broken("a point record has " + std::to_string(header_.record_bytes) + " bytes, point format " +
                  std::to_string(raw) + " needs " + std::to_string(least));
  header_.unread_extra_bytes = header_.record_bytes - least;
  return {};
}

Result<void> HeaderReader::readScale() {
  for (std::size_t k = 0; k < 3; ++k) {
    header_.scale[k] = loadAt<double>(block_, 131 + 8 * k);
    header_.offset[k] = loadAt<double>(block_, 155 + 8 * k);
    header_.high[k] = loadAt<double>(block_, 179 + 16 * k);
    header_.low[k] = loadAt<double>(block_, 187 + 16 * k);
    if (!std::isfinite(header_.scale[k]) || header_.scale[k] == 0 || !std::isfinite(header_.offset[k]))
      return broken(std::string("the scale or offset of ") + "xyz"[k] + " is not a valid number");
  }
  return {};
}

Result<void> HeaderReader::readCount() {
  header_.points = loadAt<std::uint32_t>(block_, 107);
  if (header_.minor >= 4)
    if (const auto points = loadAt<std::uint64_t>(block_, 247); points > 0) header_.points = points;
  const std::uint64_t room = (file_.size() - header_.points_at) / header_.record_bytes;
  if (header_.points > room)
    return broken("the file is truncated: it has space for " + std::to_string(room) + " of " +
                  std::to_string(header_.points) + " points");
  return {};
}

// Projected before geographic; what is put together from single parameters has no code.
void HeaderReader::takeGeoKeys(std::span<const std::uint8_t> keys) {
  const auto key = [&](std::uint16_t wanted) -> unsigned {
    for (std::size_t at = 8; at + 8 <= keys.size(); at += 8)
      if (loadAt<std::uint16_t>(keys, at) == wanted && loadAt<std::uint16_t>(keys, at + 2) == 0)
        return loadAt<std::uint16_t>(keys, at + 6);
    return 0;
  };
  constexpr std::uint16_t kProjected = 3072, kGeographic = 2048;
  constexpr unsigned kUserDefined = 32767;
  const unsigned projected = key(kProjected), geographic = key(kGeographic);
  const unsigned code = projected != 0 ? projected : geographic;
  if (code >= 1024 && code < kUserDefined)
    header_.epsg = "EPSG:" + std::to_string(code);
  else
    report_.warn(place_, "GeoTIFF keys contain no EPSG code: unknown coordinate reference system");
}

// Only what is called and stored as ours; the rest is counted.
void HeaderReader::takeExtras(std::span<const std::uint8_t> bytes) {
  constexpr std::uint8_t kBytes[11] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  std::uint32_t at = pointFormat(header_).bytes;
  for (std::size_t i = 0; i + 192 <= bytes.size(); i += 192) {
    const std::uint8_t type = bytes[i + 2], options = bytes[i + 3];
    const std::uint32_t size = type == 0    ? options
                               : type <= 30 ? kBytes[(type - 1) % 10 + 1] * (1u + (type - 1) / 10)
                                            : 0;
    if (size == 0 || size > header_.record_bytes - at) return;
    const std::string name = textOf(bytes.subspan(i + 4, 32));
    for (std::size_t k = 0; k < kExtraKinds; ++k) {
      if (name != kExtras[k].name || type != kExtras[k].type) continue;
      header_.extras.at[k] = at;
      header_.unread_extra_bytes -= std::min(size, header_.unread_extra_bytes);
      const auto axis = k - static_cast<std::size_t>(Extra::true_x);
      if (axis > 2) continue;
      header_.true_scale[axis] = (options & 8) != 0 ? loadAt<double>(bytes, i + 112) : 1;
      header_.true_offset[axis] = (options & 16) != 0 ? loadAt<double>(bytes, i + 136) : 0;
    }
    at += size;
  }
}

void HeaderReader::takeOurs(std::string_view text) {
  ScanHeader tables;
  for (const std::string_view line : split(text, '\n')) {
    const auto parts = split(line, '\t');
    if (parts[0] == "scan" && parts.size() >= 2 && header_.scans.size() < kMostScans) {
      header_.scans.push_back({numberFrom<std::uint64_t>(parts[1]).value_or(0), {}});
      header_.scans.back().header.has_time = parts.size() == 3;
    } else if (parts[0] == "product" || parts[0] == "material" || header_.scans.empty()) {
      takeScanLine(line, tables);
    } else {
      takeScanLine(line, header_.scans.back().header);
    }
  }
  header_.products = std::move(tables.products);
  header_.materials = std::move(tables.materials);
}

// Of a file that others have cut or joined the stations are no longer known.
void HeaderReader::checkScans() {
  std::uint64_t points = 0;
  bool fits = true;
  for (const OurScan& scan : header_.scans) {
    fits &= scan.points <= header_.points - points;
    if (fits) points += scan.points;
  }
  // Each scan has the tables: what they come to is bounded, too.
  fits &= header_.scans.size() * (header_.products.size() + header_.materials.size()) <= kMostEntries;
  if (fits && points == header_.points) return;
  if (!header_.scans.empty()) report_.warn(place_, "station point counts do not match: read as a single scan");
  header_.scans.clear();
}

Result<void> HeaderReader::take(const std::string& user, std::uint16_t id, std::uint64_t at, std::uint64_t length) {
  const bool system = user == "LASF_Projection" && (id == kGeoKeys || id == kWkt),
             extras = user == "LASF_Spec" && id == 4;
  const bool ours = user == kOurRecord && id == kOurRecordId;
  if (!system && !extras && !ours) return {};
  if (length > (ours ? kLongestText : kLongestRecord)) {
    report_.warn(place_, "a record '" + user + "' of " + std::to_string(length) + " bytes was skipped");
    return {};
  }
  std::vector<std::uint8_t> bytes(length);
  TRY_ASSIGN(const auto n, file_.read(at, bytes));
  bytes.resize(n);
  if (ours)
    takeOurs({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  else if (extras)
    takeExtras(bytes);
  else if (id == kWkt)
    header_.wkt = textOf(bytes);
  else
    takeGeoKeys(bytes);
  return {};
}

// A wrong number of records is common (some writers count bytes); the points stand where the header says all the same.
// The two lists differ in where they lie, in the width of a record's length, and in what they must end before.
Result<void> HeaderReader::readList(const RecordList& list) {
  std::vector<std::uint8_t> head(list.head_bytes);
  std::uint64_t at = list.begins_at;
  for (std::uint32_t i = 0; i < std::min(list.records, kMostRecords); ++i) {
    const bool inside = at <= list.ends_at && head.size() <= list.ends_at - at;
    TRY_ASSIGN(const auto n, inside ? file_.read(at, head) : Result<std::size_t>(0));
    const bool whole = n == head.size();
    const std::uint64_t length = !whole          ? 0
                                 : list.extended ? loadAt<std::uint64_t>(head, 20)
                                                 : loadAt<std::uint16_t>(head, 20);
    if (!whole || length > list.ends_at - at - head.size()) {
      const auto stated = std::to_string(list.records), there = std::to_string(i);
      report_.warn(place_, list.extended
                               ? "header specifies " + stated + " extended variable-length records, of which " + there +
                                     " lie in the file"
                               : "header specifies " + stated + " variable-length records, of which " + there +
                                     " lie before the points");
      return {};
    }
    at += head.size();
    const auto user = textOf(std::span<const std::uint8_t>(head).subspan(2, 16));
    if (auto taken = take(user, loadAt<std::uint16_t>(head, 18), at, length); !taken) return taken;
    at += length;
  }
  return {};
}

Result<void> HeaderReader::readRecords() {
  return readList(
      {loadAt<std::uint16_t>(block_, 94), loadAt<std::uint32_t>(block_, 100), kRecordHead, header_.points_at, false});
}

Result<void> HeaderReader::readExtendedRecords() {
  if (header_.minor < 4) return {};
  return readList(
      {loadAt<std::uint64_t>(block_, 235), loadAt<std::uint32_t>(block_, 243), kExtendedHead, file_.size(), true});
}

Result<Header> HeaderReader::read() {
  constexpr std::size_t kOldest = 227, kNewest = 375;
  block_.resize(kNewest);
  TRY_ASSIGN(const auto n, file_.read(0, block_));
  if (n < 4 || std::memcmp(block_.data(), "LASF", 4) != 0) return broken("is not a LAS file");
  if (n < kOldest) return broken("the file is truncated inside its header");
  header_.minor = block_[25];
  header_.adjusted_time = (loadAt<std::uint16_t>(block_, 6) & 1) != 0;
  if (block_[24] != 1 || header_.minor > 4)
    return broken("LAS " + std::to_string(block_[24]) + "." + std::to_string(header_.minor) +
                  " is not supported; supported: 1.0 to 1.4");
  const auto header_bytes = loadAt<std::uint16_t>(block_, 94);
  const std::size_t least = header_.minor == 4 ? kNewest : kOldest;
  if (header_bytes < least || n < least)
    return broken("a header of LAS 1." + std::to_string(header_.minor) + " has " + std::to_string(least) +
                  " bytes, this one " + std::to_string(header_bytes));
  header_.points_at = loadAt<std::uint32_t>(block_, 96);
  if (header_.points_at < header_bytes || header_.points_at > file_.size())
    return broken("point data offset is byte " + std::to_string(header_.points_at) + " of " +
                  std::to_string(file_.size()));
  for (const auto step : {&HeaderReader::readFormat, &HeaderReader::readScale, &HeaderReader::readCount,
                          &HeaderReader::readRecords, &HeaderReader::readExtendedRecords})
    TRY((this->*step)());
  checkScans();
  return header_;
}

}  // namespace

const PointFormat& pointFormat(const Header& header) { return kFormats[static_cast<std::size_t>(header.point_format)]; }

Result<Header> readHeader(const InputFile& file, Report& report) { return HeaderReader(file, report).read(); }

}  // namespace standpoint::las
