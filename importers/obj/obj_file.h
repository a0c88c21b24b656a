// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "importers/files/file_bytes.h"
#include "importers/obj/obj_chunk.h"
#include "importers/soup/face_soup.h"

namespace standpoint {

// An OBJ file as numbers: every index resolved and in range, every statement that changes what follows in order.
struct ObjFile {
  std::vector<Eigen::Vector3d> positions;            // as written
  std::vector<std::array<std::uint8_t, 4>> colours;  // empty, or one for each position
  std::vector<Eigen::Vector2f> texture_coordinates;  // (0, 0) upper left
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> texture_corners;  // empty, or one for each corner; kNoTextureCorner where it has none
  std::vector<std::uint64_t> face_begins;      // into corners, one more than there are faces
  std::vector<std::pair<std::uint32_t, std::size_t>> face_lines;  // (face, its line) where lines do not go on by one
  std::vector<ObjEvent> events;                                   // faces and lines counted from the file's first
  std::map<std::string, ObjTally, std::less<>> tallies;
  std::size_t known_statements = 0;
  bool colours_were_bytes = false;  // 0 … 255 instead of 0 … 1

  std::size_t faceCount() const { return face_begins.size() - 1; }
  std::size_t lineOf(std::size_t face) const;
};

// Reads pieces of `bytes` by several threads and joins them; the result does not depend on how many there are.
// `name` stands in errors.
Result<ObjFile> readObjFile(const FileBytes& bytes, const std::string& name, Progress& progress);

// For tests: pieces of that nominal size.
Result<ObjFile> readObjFile(const FileBytes& bytes, const std::string& name, std::size_t piece, Progress& progress);

}  // namespace standpoint
