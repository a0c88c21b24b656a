// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/scratch_folder.h"

#include <cstdlib>
#include <utility>

namespace standpoint {

Result<ScratchFolder> ScratchFolder::make() {
  std::error_code error;
  const auto temporary = std::filesystem::temp_directory_path(error);
  if (error) return failure(ErrorKind::file_system, "no place for temporary files: " + error.message(), "TMPDIR");
  auto pattern = (temporary / "standpoint-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr)
    return failure(ErrorKind::file_system, "cannot create a temporary folder", pattern);
  return ScratchFolder(pattern);
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

ScratchFolder::ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

}  // namespace standpoint
