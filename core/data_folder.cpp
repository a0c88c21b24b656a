// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/data_folder.h"

#include <cstdlib>

namespace standpoint {

std::filesystem::path dataFolder() {
  if (const char* folder = std::getenv("STANDPOINT_DATA")) return folder;
  return STANDPOINT_SOURCE_FOLDER;
}

}  // namespace standpoint
