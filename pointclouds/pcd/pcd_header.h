// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/ply_number.h"
#include "core/points.h"
#include "pointclouds/files/line_reader.h"
#include "pointclouds/files/point_fields.h"

namespace standpoint::pcd {

struct Field {
  std::string name;
  PlyType type = PlyType::float32;
  bool wide_integer = false;  // of 8 bytes, which are skipped
  std::uint32_t bytes = 4, count = 1;
  std::uint64_t at = 0;  // in a binary point
  std::size_t word = 0;  // in a line of text
};

struct Header {
  std::vector<Field> fields;
  FieldPlaces places;                               // into `fields`
  std::uint64_t width = 0, height = 1, points = 0;  // the file has room for as many
  std::uint64_t point_bytes = 0, points_at = 0;
  std::size_t words = 0;  // of a line
  bool binary = false;
  ScanHeader scan;  // its pose is the viewpoint
  bool organised() const { return height > 1; }
};

// Reads up to the line after DATA.
Result<Header> readHeader(LineReader& lines);

}  // namespace standpoint::pcd
