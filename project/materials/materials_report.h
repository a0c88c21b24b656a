// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/result.h"
#include "project/document.h"

namespace standpoint {

// What a lecturer prints: coverage, the materials in use with their figures and sources, the findings. The file's
// ending says which: .html (one page without anything from elsewhere) or .csv (the materials alone).
Result<void> writeMaterialReport(const Document& document, const std::filesystem::path& file);

}  // namespace standpoint
