// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/desktop/user_folders.h"

#include <cstdlib>

namespace standpoint {

namespace {

std::filesystem::path baseFolder(const char* variable, const char* fallback) {
  if (const char* set = std::getenv(variable); set != nullptr && *set != 0) return set;
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != 0)
    return std::filesystem::path(home) / fallback;
  return std::filesystem::temp_directory_path();
}

}  // namespace

std::filesystem::path settingsFile() { return baseFolder("XDG_CONFIG_HOME", ".config") / "standpoint" / "editor.json"; }
std::filesystem::path unsavedRoot() { return baseFolder("XDG_DATA_HOME", ".local/share") / "standpoint" / "unsaved"; }
std::filesystem::path octreeCache() { return baseFolder("XDG_CACHE_HOME", ".cache") / "standpoint" / "octrees"; }
std::filesystem::path recoveryRoot() {
  return baseFolder("XDG_STATE_HOME", ".local/state") / "standpoint" / "recovery";
}

}  // namespace standpoint
