// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/output_place.h"

#include <fmt/format.h>

namespace standpoint {

Result<void> checkFolderOf(const std::filesystem::path& file, const char* option) {
  const auto folder = file.parent_path();
  std::error_code code;
  if (folder.empty() || std::filesystem::is_directory(folder, code)) return {};
  const bool something = std::filesystem::exists(folder, code);
  return failure(ErrorKind::file_system,
                 something ? fmt::format("{} is not a folder: choose another location with {}", folder.string(), option)
                           : fmt::format("folder {} does not exist: create it, or choose another location with {}",
                                         folder.string(), option),
                 file.string());
}

}  // namespace standpoint
