// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/data_folder.h"

#include <cstdlib>
#include <utility>

namespace standpoint {

namespace {

namespace fs = std::filesystem;

const char* given(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != 0 ? value : nullptr;
}

fs::path& folderInUse() {
  static fs::path folder;
  return folder;
}

}  // namespace

fs::path dataFolderOf(const fs::path& program) {
  const auto beside = (program.parent_path() / "../share/standpoint").lexically_normal();
  std::error_code error;
  const bool found = beside.is_absolute() && fs::is_regular_file(beside / kDataMark, error);
  return found ? beside : fs::path(STANDPOINT_INSTALLED_DATA);
}

fs::path dataFolder() {
  if (const char* folder = given("STANDPOINT_DATA")) return folder;
  if (!folderInUse().empty()) return folderInUse();
  std::error_code error;
  return dataFolderOf(fs::read_symlink("/proc/self/exe", error));
}

void useDataFolder(fs::path folder) { folderInUse() = std::move(folder); }

fs::path ownPath(const char* variable, const char* name) {
  if (const char* path = variable == nullptr ? nullptr : given(variable)) return path;
  if (const char* config = given("XDG_CONFIG_HOME")) return fs::path(config) / "standpoint" / name;
  const char* home = given("HOME");
  return home == nullptr ? fs::path() : fs::path(home) / ".config" / "standpoint" / name;
}

fs::path samplesFolder() {
  if (const char* folder = given("STANDPOINT_SAMPLES")) return folder;
  return dataFolder() / "samples";
}

}  // namespace standpoint
