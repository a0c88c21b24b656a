// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/classroom/class_list.h"
#include "emulated-ui/classroom/signed_result.h"
#include "emulated-ui/classroom/statistics.h"
#include "emulated-ui/classroom/verify.h"

namespace standpoint {

// A result that lay in the folder.
struct CollectedResult {
  std::string file;  // within the folder
  SignedResult result;
  Verification verification;
  bool late = false;
  bool counts = false;  // the newest of this student that is verified
  bool first = false;   // the oldest of this student that is verified: statistics are of these
};

// A class's results. What they claim is no figure of it: marks are those of the replay.
struct CollectedClass {
  Assignment assignment;
  ClassList list;
  std::vector<CollectedResult> results;  // in the order of the list, then of time
  ClassStatistics statistics;
  std::vector<std::pair<std::string, std::size_t>> mistakes;  // the commonest first, with the number of students
  std::map<std::string, std::pair<double, std::size_t>> variant_means;  // by seed: mean score, number of students
  // Of each student who shares the key of another one's result: a computer that both used, or a file that was passed
  // on.
  std::map<std::string, std::vector<std::string>> same_key;

  const CollectedResult* of(const std::string& student) const;  // that counts; null where none does
};

// Reads every file in the folder and below, carries each result out again, and says in `report` which files are no
// results, or not of this assignment.
Result<CollectedClass> collectResults(const std::filesystem::path& folder, Assignment assignment, ClassList list,
                                      const std::string& language, Report& report, Progress& progress);

// "yes", "no: does not replay from action 17 …", "late" …: the column of the tables.
std::string verifiedText(const CollectedResult& result);

// Pages and files that are made of it, as texts. `date`: of the collecting. Names of students are on the page only
// where `names` is true.
std::string classHtml(const CollectedClass& collected, const std::string& language, const std::string& date,
                      bool names);
std::string classCsv(const CollectedClass& collected);
std::string criteriaCsv(const CollectedClass& collected);
// For Moodle's import of grades: username, mark of 0 to 100, feedback. Students without a verified result are left out.
std::string moodleCsv(const CollectedClass& collected);
// A list of xAPI 1.0.3 statements. `home`: address of the system whose user names are the students'.
std::string xapiStatements(const CollectedClass& collected, const std::string& home);

constexpr const char* kMarkKind = "standpoint-mark-1";
// A mark that the lecturer has verified, signed, for a graded SCORM package.
Sealed signedMark(const CollectedResult& result, const CollectedClass& collected, const SigningKey& key);

}  // namespace standpoint
