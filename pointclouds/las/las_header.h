// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/points.h"
#include "core/report.h"
#include "core/result.h"
#include "pointclouds/files/file_access.h"
#include "pointclouds/las/las_record.h"

namespace standpoint::las {

// A station of a file of ours.
struct OurScan {
  std::uint64_t points = 0;
  ScanHeader header;  // without the tables of labels, which are the file's
};

// The public header block and what the variable-length records say of the coordinate system (LAS 1.4 R15, ASPRS).
struct Header {
  int minor = 0;                   // LAS 1.minor
  int point_format = 0;            // 0 to 10
  std::uint32_t record_bytes = 0;  // at least what the format has; what is more are extra bytes
  std::uint64_t points_at = 0;
  std::uint64_t points = 0;  // that the header states and the file has room for
  std::array<double, 3> scale{}, offset{};
  std::array<double, 3> low{}, high{};                // as stated
  std::string wkt;                                    // OGC WKT, or empty
  bool adjusted_time = false;                         // GPS times are since 1980 less 1e9 s; else seconds of the week
  ExtraPlaces extras;                                 // ours
  std::array<double, 3> true_scale{}, true_offset{};  // of true_x, true_y, true_z
  std::uint32_t unread_extra_bytes = 0;
  std::vector<LabelledProduct> products;
  std::vector<std::string> materials;
  std::vector<OurScan> scans;  // of a file of ours, in the order of the points; empty when their counts do not fit
  std::string epsg;            // "EPSG:26917" of simple GeoTIFF keys, or empty
};

// Checks every count and offset against the file. Compressed points are an error that says what to do.
Result<Header> readHeader(const InputFile& file, Report& report);

struct PointFormat {
  std::uint32_t bytes;      // of a record without extra bytes
  std::uint32_t colour_at;  // 0: none
  std::uint32_t time_at;    // 0: none
  const char* not_read;     // fields that have no place in a PointBlock
};
const PointFormat& pointFormat(const Header& header);

}  // namespace standpoint::las
