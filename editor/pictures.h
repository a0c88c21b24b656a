// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"
#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {

// Each workspace at work on the open project, or only the pictures of these names ("4-survey"). Returns the files
// written.
Result<std::vector<std::filesystem::path>> drawPictures(Editor& editor, Offscreen& offscreen,
                                                        const std::filesystem::path& folder,
                                                        const std::vector<std::string>& only = {});

}  // namespace standpoint
