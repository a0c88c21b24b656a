// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "core/result.h"
#include "editor/shell/editor.h"
#include "editor/viewport/offscreen.h"

namespace standpoint {

// The pictures of the documentation: each workspace at work on the open project. Returns the files written.
Result<std::vector<std::filesystem::path>> drawPictures(Editor& editor, Offscreen& offscreen,
                                                        const std::filesystem::path& folder);

}  // namespace standpoint
