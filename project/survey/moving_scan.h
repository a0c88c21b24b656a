// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "project/survey/scan_preparation.h"
#include "project/survey/survey_verbs.h"

namespace standpoint {

// The verb `scan` along a trajectory of the job, or of a file. Beside the points go two trajectories: as the surveyor
// knows it, and with the truth of the points as it was.
Result<Answered<ScanAnswer>> runMovingScan(const Document& document, const ScanVerbOptions& options,
                                           const ScanSurroundings& company, Progress& progress);

}  // namespace standpoint
