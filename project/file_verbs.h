// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Verbs about files: taking the model elsewhere, converting, cleaning, describing and comparing point clouds,
// instruments, replaying jobs.

#include "project/verb.h"

namespace standpoint {

Result<Outcome> runExport(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runConvert(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runClean(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runInfo(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runInstruments(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runCompare(const Document& document, const nlohmann::json& options, Progress& progress);
Result<Outcome> runJob(const Document& document, const nlohmann::json& options, Progress& progress);

}  // namespace standpoint
