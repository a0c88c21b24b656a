// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/ply_header.h"
#include "core/points.h"
#include "pointclouds/files/line_reader.h"
#include "pointclouds/files/point_fields.h"

namespace standpoint::ply {

struct Property {
  std::string name;
  PlyType type = PlyType::float32;
  std::size_t at = 0;  // in a binary vertex
};

struct Header {
  PlyForm form = PlyForm::text;
  std::uint64_t skipped_lines = 0;  // of elements before the vertices, ASCII
  std::uint64_t vertices_at = 0;    // byte of the first vertex, binary
  std::uint64_t vertices = 0;       // the file has room for as many
  std::uint64_t faces = 0;
  std::vector<Property> properties;  // of a vertex
  std::size_t vertex_bytes = 0;
  FieldPlaces places;  // into `properties`
  ScanHeader scan;     // what the comments of a file of ours say
  bool ours = false;
};

// Begins a comment with a line of scan_text.h.
inline constexpr const char* kOurComment = "comment standpoint ";

// Reads up to the line after end_header. Checks counts against what is left of the file.
Result<Header> readHeader(LineReader& lines);

}  // namespace standpoint::ply
