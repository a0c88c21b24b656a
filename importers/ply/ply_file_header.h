// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/ply_header.h"
#include "importers/files/file_bytes.h"

namespace standpoint {

// The header of a mesh's file.
struct PlyFileHeader : PlyHeader {
  std::vector<std::string> texture_files;  // "comment TextureFile brick.png"
  std::uint64_t bytes = 0;                 // where the data begins
  std::size_t lines = 0;
};

// Refuses a count for which the file has no bytes. `name` stands in errors.
Result<PlyFileHeader> readPlyHeader(const FileBytes& bytes, const std::string& name);

}  // namespace standpoint
