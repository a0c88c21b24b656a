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

// From the end of a scan to the beginning of the next one, for the crew to carry the tripod on and to level it;
// unsourced.
inline constexpr double kChangeover_s = 60;
// When the job's station of that number begins, after its first one: they are scanned in their order, all of them, with
// the same settings, so that a station alone and a shard's are as in the whole. Nobody can tell how long a changeover
// takes where nothing moves: there it takes no time.
double stationStart_s(const ScanRequest& request, std::size_t station);
// What a station of those of the request asks for: with the movers' clock at its beginning.
ScanRequest requestAt(const ScanRequest& request, std::size_t station);

// Where the station's points go.
std::filesystem::path fileOf(const ScanRequest& request, const Station& station);

}  // namespace standpoint
