// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The header of PLY files, meshes and clouds alike (Turk, "The PLY Polygon File Format", 1994).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/ply_number.h"
#include "core/result.h"

namespace standpoint {

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  // of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  // of the header, from 1

  bool hasLists() const;
  std::uint64_t leastBytes(bool text) const;  // of one row
};

enum class PlyForm { text, little_endian, big_endian };

struct PlyHeader {
  PlyForm form = PlyForm::text;
  std::vector<PlyElement> elements;
};

// Takes a header line by line, so that its reader decides where lines end, what comments mean and what a place is
// called: errors have no source.
class PlyHeaderLines {
 public:
  // The first is "ply". False after end_header.
  Result<bool> take(std::string_view line);
  const PlyHeader& header() const { return header_; }

 private:
  Result<void> statement(const std::vector<std::string_view>& words);
  Result<void> format(const std::vector<std::string_view>& words);
  Result<void> element(const std::vector<std::string_view>& words);
  Result<void> property(const std::vector<std::string_view>& words);

  PlyHeader header_;
  std::size_t lines_ = 0, properties_ = 0;
  bool has_format_ = false;
};

}  // namespace standpoint
