// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/las/las_layout.h"

#include <algorithm>
#include <chrono>

#include "pointclouds/files/block_check.h"

namespace standpoint::las {
namespace {

constexpr std::size_t kExtraBytes = 192;
constexpr std::uint16_t kAdjustedTime = 1, kWktBit = 16;
constexpr std::uint32_t kRecordBytes[] = {30, 36, 38};  // of point formats 6 to 8

void putText(std::uint8_t* to, std::size_t room, const std::string& text) {
  std::memcpy(to, text.data(), std::min(room, text.size()));
}

void putDate(double created_gps_s, std::uint8_t* header) {
  using namespace std::chrono;
  if (!(created_gps_s > 0 && created_gps_s < 4e9)) return;
  const sys_days day = sys_days{year{1980} / January / 6} + days{static_cast<int>(created_gps_s / 86400)};
  const year_month_day date{day};
  store(header + 90, static_cast<std::uint16_t>((day - sys_days{date.year() / January / 1}).count() + 1));
  store(header + 92, static_cast<std::uint16_t>(static_cast<int>(date.year())));
}

}  // namespace

Layout layoutFor(const ScanHeader& header, bool near_infrared) {
  Layout layout{.point_format = near_infrared       ? 8
                                : header.has_colour ? 7
                                                    : 6,
                .colour = header.has_colour,
                .labels = header.has_labels,
                .grid = hasGrid(header),
                .channel = header.has_channel,
                .truth = header.has_truth};
  layout.extras.end = kRecordBytes[layout.point_format - 6];
  for (std::size_t i = 0; i < kExtraKinds; ++i) {
    const auto kind = static_cast<Extra>(i);
    const bool wanted = kind <= Extra::material  ? layout.labels
                        : kind <= Extra::column  ? layout.grid
                        : kind == Extra::channel ? layout.channel
                                                 : layout.truth;
    if (!wanted) continue;
    layout.extras.at[i] = layout.extras.end;
    layout.extras.end += kExtras[i].bytes;
  }
  layout.record_bytes = layout.extras.end;
  return layout;
}

void appendRecordHead(std::vector<std::uint8_t>& bytes, const char* user, std::uint16_t id, std::uint64_t length,
                      bool extended, const char* description) {
  const std::size_t at = bytes.size();
  bytes.resize(at + (extended ? kExtendedHead : kRecordHead));
  putText(bytes.data() + at + 2, 16, user);
  store(bytes.data() + at + 18, id);
  if (extended)
    store(bytes.data() + at + 20, length);
  else
    store(bytes.data() + at + 20, static_cast<std::uint16_t>(length));
  putText(bytes.data() + at + (extended ? 28 : 22), 32, description);
}

std::vector<std::uint8_t> extraRecords(const Layout& layout, const std::array<double, 3>& offset) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < kExtraKinds; ++i) {
    if (!layout.extras.at[i]) continue;
    std::array<std::uint8_t, kExtraBytes> extra{};
    extra[2] = kExtras[i].type;
    putText(extra.data() + 4, 31, kExtras[i].name);
    putText(extra.data() + 160, 31, kExtras[i].description);
    const auto kind = static_cast<Extra>(i);
    if (kind >= Extra::true_x && kind <= Extra::true_z) {
      extra[3] = 8 | 16;  // scale and offset count
      store(extra.data() + 112, kScale_m);
      store(extra.data() + 136, offset[i - static_cast<std::size_t>(Extra::true_x)]);
    }
    bytes.insert(bytes.end(), extra.begin(), extra.end());
  }
  return bytes;
}

std::array<std::uint8_t, kHeaderBytes> headerBytes(const Layout& layout, const WrittenFile& file) {
  std::array<std::uint8_t, kHeaderBytes> h{};
  putText(h.data(), 4, "LASF");
  store(h.data() + 6, static_cast<std::uint16_t>(kAdjustedTime | kWktBit));
  h[24] = 1, h[25] = 4;
  putText(h.data() + 26, 32, file.system);
  putText(h.data() + 58, 32, "Standpoint");
  putDate(file.created_gps_s, h.data());
  store(h.data() + 94, static_cast<std::uint16_t>(kHeaderBytes));
  store(h.data() + 96, static_cast<std::uint32_t>(file.points_at));
  store(h.data() + 100, file.records);
  h[104] = static_cast<std::uint8_t>(layout.point_format);
  store(h.data() + 105, static_cast<std::uint16_t>(layout.record_bytes));
  for (std::size_t k = 0; k < 3; ++k) {
    store(h.data() + 131 + 8 * k, kScale_m);
    store(h.data() + 155 + 8 * k, file.offset[k]);
    store(h.data() + 179 + 16 * k, file.high[k] * kScale_m + file.offset[k]);
    store(h.data() + 187 + 16 * k, file.low[k] * kScale_m + file.offset[k]);
  }
  store(h.data() + 235, file.extended_at);
  store<std::uint32_t>(h.data() + 243, 1);
  store(h.data() + 247, file.points);
  for (std::size_t i = 0; i < file.by_return.size(); ++i) store(h.data() + 255 + 8 * i, file.by_return[i]);
  return h;
}

}  // namespace standpoint::las
