// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>

#include "core/progress.h"
#include "core/result.h"
#include "importers/files/importer.h"

namespace standpoint {

// The table of importers; a new format is one file and one line in importers.cpp.
std::span<const Importer> importers();

// The one that reads a file, by its content first (magic bytes), then by its extension. Errors: file_system when it is
// no file or cannot be read, unusable when no importer knows it.
Result<const Importer*> importerOf(const std::filesystem::path& file);

// Errors are those of importerOf() and of the importer; every error names the file and the place.
// What cannot well be meant (units, up-axis, places far apart) is told in the report.
Result<ImportedModel> importFile(const std::filesystem::path& file, const ImportOptions& options, Progress& progress);

}  // namespace standpoint
