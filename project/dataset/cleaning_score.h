// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "project/dataset/cleaning_answer.h"
#include "project/dataset/score_verb.h"

namespace standpoint {

// The half of the verb `score` for what somebody removed: pointclouds/scores/kept_points.h matches, cleaning_scores.h
// counts.
Result<Answered<CleaningAnswer>> scoreCleaning(const Document& document, const ScoreOptions& options,
                                               Progress& progress);

// Where points are left that should go, and where good ones were lost, as a part of a page. Reads the truth twice.
Result<std::string> picturesOfCleaning(const CleaningAnswer& answer, const std::vector<std::uint8_t>& kept,
                                       Progress& progress);
// As writeScoreReport.
Result<void> writeCleaningReport(const CleaningAnswer& answer, const std::string& pictures,
                                 const std::filesystem::path& file);

}  // namespace standpoint
