// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/result.h"

namespace standpoint {

// Asked before the work is begun whose result goes there: is the folder of this file there? The error names it.
Result<void> checkFolderOf(const std::filesystem::path& file, const char* option);

}  // namespace standpoint
