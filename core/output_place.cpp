// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/output_place.h"

namespace standpoint {

Result<void> checkFolderOf(const std::filesystem::path& file, const char* option) {
  const auto folder = file.parent_path();
  std::error_code code;
  if (folder.empty() || std::filesystem::is_directory(folder, code)) return {};
  const auto with = std::string(" with ") + option;
  if (std::filesystem::exists(folder, code))
    return failure(ErrorKind::file_system, folder.string() + " is not a folder: choose another location" + with,
                   file.string());
  return failure(ErrorKind::file_system,
                 "folder " + folder.string() + " does not exist: create it, or choose another location" + with,
                 file.string());
}

}  // namespace standpoint
