// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "importers/importers.h"
#include "project/verb.h"

namespace standpoint {

// Reads one or more models into one environment. All of them share the first model's global shift and georeference; a
// file that states another CRS or map conversion than the first is reported.
Result<Outcome> importModels(const Document& document, const std::vector<std::filesystem::path>& files,
                             const ImportOptions& options, const std::string& crs, Progress& progress);

// The outcome of importModels, put beside what `document` has: its georeference, job and underlays stay, materials are
// assigned anew by its rules, and what was derived from the model as it was (lighter model, collision shapes) is
// dropped.
Result<Outcome> addImported(const Document& document, Outcome imported, Progress& progress);

Result<Outcome> runAdd(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runImport(const Document& document, const nlohmann::json& options, Progress& progress);

}  // namespace standpoint
