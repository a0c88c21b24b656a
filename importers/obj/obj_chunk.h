// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

// A corner's number of a vertex as the statement gives it: counted from the file's first vertex, or back from the last
// one so far. The latter is known only relative to the chunk until the vertices before it have been counted.
constexpr std::int32_t kMaxObjIndex = 1'000'000'000;  // nobody has a vertex of ten digits
constexpr std::int32_t kNoObjIndex = INT32_MAX;

// Where in the file, as it will be known when the chunks before this one have been counted.
struct ObjFault {
  std::size_t line = 0;
  std::string message;
};

enum class ObjChange { object, group, material, library };

// A statement that holds from the next face on.
struct ObjEvent {
  ObjChange what;
  std::uint32_t face = 0;
  std::size_t line = 0;
  std::string text;
};

// A kind of loss that may come a million times: said once, with the first line and the number.
struct ObjTally {
  std::size_t first_line = 0, count = 0;
  void add(std::size_t line) {
    if (count++ == 0) first_line = line;
  }
};

// A vertex that cannot be used: it keeps its number, and is an error only if a face asks for it.
struct ObjBadVertex {
  std::size_t index = 0, line = 0;
  const char* why = nullptr;
};

// What a piece of an OBJ file says, read without knowing the rest. Lines are counted from the piece's first, as 0.
struct ObjChunk {
  std::vector<Eigen::Vector3d> positions;
  std::vector<ObjBadVertex> bad_vertices;  // their positions are NaN
  std::vector<Eigen::Vector3f> colours;    // empty, or for the first vertices; NaN where one has none
  std::vector<Eigen::Vector2f> texture_coordinates;
  std::vector<std::int32_t> corners;
  std::vector<std::int32_t> texture_corners;                        // empty, or for the first corners
  std::vector<std::uint32_t> face_ends;                             // into corners
  std::vector<std::pair<std::uint32_t, std::uint32_t>> face_lines;  // (face, its line) where lines do not go on by one
  std::vector<ObjEvent> events;
  std::map<std::string, ObjTally, std::less<>> tallies;  // by the statement's word, or what is odd
  std::size_t lines = 0, known_statements = 0;
  std::optional<ObjFault> fault;
  struct Extreme {
    std::int64_t value = 0;
    std::int64_t written = 0;    // as the file has it
    std::int64_t preceding = 0;  // vertices of the chunk before it
    std::size_t line = 0;
  };
  Extreme largest, lowest;  // absolute index from 1; index before the chunk's first vertex, below 0
};

// Tallies besides statements; no statement begins with a capital.
constexpr std::string_view kShortFaces = "Short", kOddColours = "Odd", kWeights = "Weights", kUnknown = "Unknown",
                           kBadVertices = "Vertices", kWrongTexture = "Texture";

inline std::int32_t encodeRelative(std::int64_t in_chunk) {
  return static_cast<std::int32_t>(in_chunk + INT32_MIN + kMaxObjIndex);
}
inline std::int64_t decodeIndex(std::int32_t code, std::int64_t before_chunk) {
  return code >= 0 ? code : std::int64_t{code} - INT32_MIN - kMaxObjIndex + before_chunk;
}

// `text` holds whole statements and ends with a line's end. Stops at the first fault.
ObjChunk parseObjChunk(std::string_view text);

}  // namespace standpoint
