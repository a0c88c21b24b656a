// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <sys/stat.h>

namespace standpoint {

// Does the path still lead to the open file? A holder of a lock takes its file away before it lets go, so what was
// locked then may be what no path leads to any more.
inline bool isStillThere(int descriptor, const std::filesystem::path& file) {
  struct stat held {
  }, named{};
  return ::fstat(descriptor, &held) == 0 && ::stat(file.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

}  // namespace standpoint
