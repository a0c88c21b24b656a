// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/file_kinds.h"

#include <algorithm>
#include <cctype>
#include <system_error>

#include <fmt/format.h>

namespace standpoint {

std::span<const FileKind> modelKinds() {
  static const std::vector<FileKind> kKinds = {
      {"glTF, one file", ".glb", "For viewers and game engines, with the appearance of the model", {"physical"}},
      {"glTF, two files", ".gltf", "As text, with the triangles in a .bin file beside it", {"physical"}},
      {"OBJ", ".obj", "With the materials in a .mtl file beside it", {"levels", "collision"}},
      {"IFC", ".ifc", "Products with their classes and materials", {"physical", "levels", "collision"}},
      {"HELIOS++ scene",
       ".xml",
       "For that simulator, with the physical materials",
       {"physical", "levels", "collision"}},
  };
  return kKinds;
}

std::span<const FileKind> pointKinds() {
  static const std::vector<FileKind> kKinds = {
      {"E57", ".e57", "With pose, intensity, colours and labels"},
      {"LAS", ".las", "With intensity, colours and labels"},
      {"PTX, text", ".ptx", "As a whole grid with its pose"},
      {"PLY, binary", ".ply", "One file per scan, with labels as scalars"},
      {"PCD, binary", ".pcd", "One file per scan, in the frame of its scanner"},
      {"PTS, text", ".pts", "One file per scan, with the number of points first"},
      {"XYZ, text", ".xyz", "One file per scan, a line for each point"},
      {"CSV, text", ".csv", "One file per scan, with the names of the columns first"},
  };
  return kKinds;
}

const FileKind* kindOf(std::span<const FileKind> kinds, const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return extension == k.extension; });
  return found == kinds.end() ? nullptr : &*found;
}

std::filesystem::path withKind(std::span<const FileKind> kinds, const FileKind& kind,
                               const std::filesystem::path& file) {
  const auto* before = kindOf(kinds, file);
  if (before == &kind) return file;
  auto named = before == nullptr ? file : file.parent_path() / file.stem();
  named += kind.extension;
  return freeFile(named);
}

std::filesystem::path freeFile(const std::filesystem::path& file) {
  std::error_code unreadable;
  auto free = file;
  for (int n = 2; std::filesystem::exists(free, unreadable); ++n)
    free = file.parent_path() / fmt::format("{} {}{}", file.stem().string(), n, file.extension().string());
  return free;
}

}  // namespace standpoint
