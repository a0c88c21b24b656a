// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// OBJ + MTL, coordinates as text in the file frame (shift added in double).
Result<void> writeEnvironmentObj(const Environment& environment, const Georeference& georeference,
                                 const std::filesystem::path& file, Progress& progress);

}  // namespace standpoint
