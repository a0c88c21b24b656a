// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// OBJ + MTL, coordinates as text in the file frame (shift added in double). `materials` is the text of the MTL file,
// for a reader that wants more of it than colours.
Result<void> writeEnvironmentObj(const Environment& environment, const Georeference& georeference,
                                 const std::filesystem::path& file, Progress& progress,
                                 const std::optional<std::string>& materials = {});

}  // namespace standpoint
