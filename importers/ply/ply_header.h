// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/ply_number.h"
#include "core/result.h"
#include "importers/files/file_bytes.h"

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
  std::size_t line = 0;  // of the header

  std::uint64_t leastBytes(bool text) const;  // of one row
  bool hasLists() const;
};

enum class PlyForm { text, little_endian, big_endian };

struct PlyHeader {
  PlyForm form = PlyForm::text;
  std::vector<PlyElement> elements;
  std::vector<std::string> texture_files;  // "comment TextureFile brick.png"
  std::uint64_t bytes = 0;                 // where the data begins
  std::size_t lines = 0;
};

// Refuses a count for which the file has no bytes. `name` stands in errors.
Result<PlyHeader> readPlyHeader(const FileBytes& bytes, const std::string& name);

}  // namespace standpoint
