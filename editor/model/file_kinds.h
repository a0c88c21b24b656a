// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace standpoint {

// A format that a file is written in, by its ending.
struct FileKind {
  const char* label;                                   // "E57"
  const char* extension;                               // ".e57"
  const char* note;                                    // in a line, what is in such a file
  std::vector<std::string_view> unknown_options = {};  // of the verb: those that this format has no place for
};

std::span<const FileKind> modelKinds();  // that `export` writes
std::span<const FileKind> pointKinds();  // that `convert` writes

// By the file's ending, in whatever case; null where it has none of theirs.
const FileKind* kindOf(std::span<const FileKind> kinds, const std::filesystem::path& file);
// With the ending of that kind in place of that of another one, where nothing is yet.
std::filesystem::path withKind(std::span<const FileKind> kinds, const FileKind& kind,
                               const std::filesystem::path& file);

// The file, or with a number behind its name, so that whoever writes it writes over nothing.
std::filesystem::path freeFile(const std::filesystem::path& file);

}  // namespace standpoint
