// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "project/document.h"

namespace standpoint {

// What differs between a project and a copy of it, in words and figures, a line each; none: nothing that a user made.
std::vector<std::string> differences(const Document& project, const Document& copy);

// Of two project folders.
Result<std::vector<std::string>> differencesOf(const std::filesystem::path& project, const std::filesystem::path& copy,
                                               Progress& progress);

}  // namespace standpoint
