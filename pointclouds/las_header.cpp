// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/las_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

namespace standpoint::las {
namespace {

static_assert(std::endian::native == std::endian::little, "LAS numbers are little-endian and copied as they stand");

constexpr std::uint64_t kLongestRecord = 1 << 20;  // of a coordinate system; real ones have some kilobytes
constexpr std::uint32_t kMostRecords = 100000;
constexpr std::uint16_t kGeoKeys = 34735, kWkt = 2112;
constexpr std::size_t kRecordHead = 54, kExtendedHead = 60;

constexpr const char* kOld = "return numbers, classification, scan angle, user data, point source";
constexpr const char* kOldTime = "return numbers, classification, scan angle, user data, point source, GPS time";
constexpr const char* kWaves =
    "return numbers, classification, scan angle, user data, point source, GPS time, waveform";
constexpr const char* kInfrared =
    "return numbers, classification, scan angle, user data, point source, GPS time, near infrared";
constexpr const char* kAll =
    "return numbers, classification, scan angle, user data, point source, GPS time, near infrared, waveform";
constexpr std::array<PointFormat, 11> kFormats = {{{20, 0, kOld},
                                                   {28, 0, kOldTime},
                                                   {26, 20, kOld},
                                                   {34, 28, kOldTime},
                                                   {57, 0, kWaves},
                                                   {63, 28, kWaves},
                                                   {30, 0, kOldTime},
                                                   {36, 30, kOldTime},
                                                   {38, 30, kInfrared},
                                                   {59, 0, kWaves},
                                                   {67, 30, kAll}}};

template <class T>
T load(std::span<const std::uint8_t> bytes, std::size_t at) {
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
  std::uint64_t ends_at = 0;   // no record reaches beyond it
  bool extended = false;       // its lengths have 64 bits
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
    return broken("the points are compressed (LAZ), which cannot be read: write them as LAS first, for instance with "
                  "`laszip -i FILE.laz -o FILE.las`, `pdal translate` or CloudCompare");
  header_.point_format = raw;
  if (header_.point_format >= static_cast<int>(kFormats.size()))
    return broken("point format " + std::to_string(raw) + " is not known, only 0 to 10");
  header_.record_bytes = load<std::uint16_t>(block_, 105);
  const auto least = pointFormat(header_).bytes;
  if (header_.record_bytes < least)
    return broken("a point record has " + std::to_string(header_.record_bytes) + " bytes, point format " +
                  std::to_string(raw) + " needs " + std::to_string(least));
  return {};
}

Result<void> HeaderReader::readScale() {
  for (std::size_t k = 0; k < 3; ++k) {
    header_.scale[k] = load<double>(block_, 131 + 8 * k);
    header_.offset[k] = load<double>(block_, 155 + 8 * k);
    header_.high[k] = load<double>(block_, 179 + 16 * k);
    header_.low[k] = load<double>(block_, 187 + 16 * k);
    if (!std::isfinite(header_.scale[k]) || header_.scale[k] == 0 || !std::isfinite(header_.offset[k]))
      return broken(std::string("the scale or offset of ") + "xyz"[k] + " is no number to multiply with");
  }
  return {};
}

Result<void> HeaderReader::readCount() {
  header_.points = load<std::uint32_t>(block_, 107);
  if (header_.minor >= 4)
    if (const auto points = load<std::uint64_t>(block_, 247); points > 0) header_.points = points;
  const std::uint64_t room = (file_.size() - header_.points_at) / header_.record_bytes;
  if (header_.points > room)
    return broken("the file is truncated: it has room for " + std::to_string(room) + " of " +
                  std::to_string(header_.points) + " points");
  return {};
}

// Projected before geographic; what is put together from single parameters has no code.
void HeaderReader::takeGeoKeys(std::span<const std::uint8_t> keys) {
  const auto key = [&](std::uint16_t wanted) -> unsigned {
    for (std::size_t at = 8; at + 8 <= keys.size(); at += 8)
      if (load<std::uint16_t>(keys, at) == wanted && load<std::uint16_t>(keys, at + 2) == 0)
        return load<std::uint16_t>(keys, at + 6);
    return 0;
  };
  constexpr std::uint16_t kProjected = 3072, kGeographic = 2048;
  constexpr unsigned kUserDefined = 32767;
  const unsigned projected = key(kProjected), geographic = key(kGeographic);
  const unsigned code = projected != 0 ? projected : geographic;
  if (code >= 1024 && code < kUserDefined)
    header_.epsg = "EPSG:" + std::to_string(code);
  else
    report_.warn(place_, "its GeoTIFF keys name no EPSG code: the coordinate system is not known");
}

Result<void> HeaderReader::take(const std::string& user, std::uint16_t id, std::uint64_t at, std::uint64_t length) {
  if (user != "LASF_Projection" || (id != kGeoKeys && id != kWkt)) return {};
  if (length > kLongestRecord) {
    report_.warn(place_, "a coordinate system of " + std::to_string(length) + " bytes is not read");
    return {};
  }
  std::vector<std::uint8_t> bytes(length);
  const auto n = file_.read(at, bytes);
  if (!n) return failure(n.error());
  bytes.resize(*n);
  if (id == kWkt)
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
    const auto n = inside ? file_.read(at, head) : Result<std::size_t>(0);
    if (!n) return failure(n.error());
    const bool whole = *n == head.size();
    const std::uint64_t length = !whole ? 0 : list.extended ? load<std::uint64_t>(head, 20) : load<std::uint16_t>(head, 20);
    if (!whole || length > list.ends_at - at - head.size()) {
      report_.warn(place_, "it states " + std::to_string(list.records) + (list.extended ? " extended" : "") +
                               " variable-length records, of which " + std::to_string(i) + " lie " +
                               (list.extended ? "in the file" : "before the points"));
      return {};
    }
    at += head.size();
    const auto user = textOf(std::span<const std::uint8_t>(head).subspan(2, 16));
    if (auto taken = take(user, load<std::uint16_t>(head, 18), at, length); !taken) return taken;
    at += length;
  }
  return {};
}

Result<void> HeaderReader::readRecords() {
  return readList({load<std::uint16_t>(block_, 94), load<std::uint32_t>(block_, 100), kRecordHead, header_.points_at, false});
}

Result<void> HeaderReader::readExtendedRecords() {
  if (header_.minor < 4) return {};
  return readList({load<std::uint64_t>(block_, 235), load<std::uint32_t>(block_, 243), kExtendedHead, file_.size(), true});
}

Result<Header> HeaderReader::read() {
  constexpr std::size_t kOldest = 227, kNewest = 375;
  block_.resize(kNewest);
  const auto n = file_.read(0, block_);
  if (!n) return failure(n.error());
  if (*n < 4 || std::memcmp(block_.data(), "LASF", 4) != 0) return broken("is not a LAS file");
  if (*n < kOldest) return broken("the file is truncated: it ends inside its header");
  header_.minor = block_[25];
  if (block_[24] != 1 || header_.minor > 4)
    return broken("LAS " + std::to_string(block_[24]) + "." + std::to_string(header_.minor) +
                  " is not known, only 1.0 to 1.4");
  const auto header_bytes = load<std::uint16_t>(block_, 94);
  const std::size_t least = header_.minor == 4 ? kNewest : kOldest;
  if (header_bytes < least || *n < least)
    return broken("a header of LAS 1." + std::to_string(header_.minor) + " has " + std::to_string(least) +
                  " bytes, this one " + std::to_string(header_bytes));
  header_.points_at = load<std::uint32_t>(block_, 96);
  if (header_.points_at < header_bytes || header_.points_at > file_.size())
    return broken("the points are said to begin at byte " + std::to_string(header_.points_at) + " of " +
                  std::to_string(file_.size()));
  for (const auto step : {&HeaderReader::readFormat, &HeaderReader::readScale, &HeaderReader::readCount,
                          &HeaderReader::readRecords, &HeaderReader::readExtendedRecords})
    if (auto done = (this->*step)(); !done) return failure(done.error());
  return header_;
}

}  // namespace

const PointFormat& pointFormat(const Header& header) {
  return kFormats[static_cast<std::size_t>(header.point_format)];
}

Result<Header> readHeader(const InputFile& file, Report& report) { return HeaderReader(file, report).read(); }

}  // namespace standpoint::las
