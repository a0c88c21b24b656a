// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

// What a rehearsal is worth: `passed`, `score` (share of the points), and for each step and rule what was expected,
// what was done, and what a mistake does to the data, with the figure from the points that proves it; of a rule that
// nothing asked, that and no consequence; `failures`: what the device could not do, and why. `student` may be empty.
nlohmann::json marksOf(const Rehearsal& rehearsal, const std::string& student, const std::string& language);

std::string marksText(const nlohmann::json& marks);   // for people, a line each
std::string marksCsv(const nlohmann::json& marks);    // RFC 4180, a row for each step and rule
// A page to print, with the setups' pictures in it; it needs no other file.
std::string marksHtml(const nlohmann::json& marks, const Rehearsal& rehearsal);

// Writes result.json, result.csv and result.html.
Result<void> writeMarks(const Rehearsal& rehearsal, const nlohmann::json& marks, const std::filesystem::path& folder);

}  // namespace standpoint
