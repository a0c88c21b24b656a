// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace standpoint {

struct FileRow {
  std::string name;
  bool folder = false;
  bool project = false;  // a folder that holds project.json
  std::uint64_t bytes = 0;
  std::filesystem::file_time_type changed;
};

enum class FileOrder { name, size, date };

struct FileListing {
  std::vector<FileRow> rows;  // folders first
  std::string problem;        // why it could not be read; rows is then empty
};

// Hidden files are left out. `extensions` are lower case with the dot; empty = all files; folders are always listed.
FileListing listFolder(const std::filesystem::path& folder, std::span<const std::string> extensions, FileOrder order,
                       bool descending);

bool isProjectFolder(const std::filesystem::path& folder);
std::string readableSize(std::uint64_t bytes);  // "2.4 MB"
// Of all files in it, or of those with that ending, as far as it can be read; 0 where there is none.
std::uint64_t folderSize(const std::filesystem::path& folder, std::string_view extension = {});

}  // namespace standpoint
