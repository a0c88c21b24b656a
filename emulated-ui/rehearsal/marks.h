// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

// What a rehearsal is worth: `passed`, `score` (share of the points), and for each step and rule what was expected,
// what was done, and what a mistake does to the data, with the figure from the points that proves it; of a rule that
// nothing asked, that and no consequence; `must_broken`: ids of the rules that had to hold and did not; `answers` to
// the questions; `failures`: what the device could not do, and why. Only what is named `found_text` and, in a proof,
// `text` is rounded, for people. `student` may be empty.
nlohmann::json marksOf(const Rehearsal& rehearsal, const std::string& student, const std::string& language);

std::string marksText(const nlohmann::json& marks);  // for people, a line each
// RFC 4180, a row for each step, rule, answer and failure, then the total. No text in it becomes a formula.
std::string marksCsv(const nlohmann::json& marks);
// A page to print, with the setups' pictures in it, in the marks' language; it needs no other file. `date`: of the
// marking.
std::string marksHtml(const nlohmann::json& marks, const Rehearsal& rehearsal, const std::string& date);
// What people read of the marks: the rules that had to hold and did not, and a share of 0 to 1 as "87.3 %".
std::string brokenDemands(const nlohmann::json& marks);
std::string percentText(double fraction);

// Writes result.json, result.csv and result.html, the latter with the date of today.
Result<void> writeMarks(const Rehearsal& rehearsal, const nlohmann::json& marks, const std::filesystem::path& folder);

}  // namespace standpoint
