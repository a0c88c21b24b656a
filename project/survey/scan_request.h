// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "project/document.h"
#include "project/survey/survey_verbs.h"
#include "survey/scanning/scan_request.h"

namespace standpoint {

// What of it the next scan would begin with, and the options that ask for that.
ScanChoice choiceOf(const ScanRequest& request);
ScanVerbOptions optionsOf(const ScanChoice& choice);

Result<ScanRequest> scanRequestFrom(const Document& document, const ScanVerbOptions& options);

// Indices into the job.
Result<std::vector<std::size_t>> stationsFrom(const Job& job, const StationNames& wanted);
// What the document assigns, else what the default rules would, and the note that says so.
Result<MaterialAssignment> scanAssignment(const Document& document, Progress& progress);
void noteDefaultRules(const Document& document, Report& report);

// Where the station's points go.
std::filesystem::path fileOf(const ScanRequest& request, const Station& station);

}  // namespace standpoint
