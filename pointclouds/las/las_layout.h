// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/points.h"
#include "pointclouds/las/las_record.h"

namespace standpoint::las {

inline constexpr double kScale_m = 1e-4;

// What a written record holds: point format 6, 7 with colours, 8 with room for near infrared as well; then our extra
// bytes.
struct Layout {
  int point_format = 6;
  bool colour = false, labels = false, grid = false, channel = false, truth = false;
  ExtraPlaces extras;
  std::uint32_t record_bytes = 0;
};
Layout layoutFor(const ScanHeader& header, bool near_infrared);

// Variable-length records before the points, and the extended ones behind them: their head; the content follows it.
void appendRecordHead(std::vector<std::uint8_t>& bytes, const char* user, std::uint16_t id, std::uint64_t length,
                      bool extended, const char* description);
// Content of the record that describes our extra bytes.
std::vector<std::uint8_t> extraRecords(const Layout& layout, const std::array<double, 3>& offset);

inline constexpr std::size_t kHeaderBytes = 375;
struct WrittenFile {
  std::string system;
  double created_gps_s = 0;  // 0: not known
  std::uint64_t points_at = 0, extended_at = 0;
  std::uint32_t records = 0;  // before the points
  std::array<double, 3> offset{};
  std::array<std::int32_t, 3> low{}, high{};
  std::uint64_t points = 0;
  std::array<std::uint64_t, 15> by_return{};
};
std::array<std::uint8_t, kHeaderBytes> headerBytes(const Layout& layout, const WrittenFile& file);

}  // namespace standpoint::las
