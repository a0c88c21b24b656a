// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "emulated-ui/seals/seal.h"

namespace standpoint {

constexpr const char* kResultKind = "standpoint-result-1";

// What was done, as one link of a chain: `hash` is that of the link before it and of the rest of this one.
struct ResultAction {
  std::string action;  // JSON, as it was hashed
  std::int64_t wall_ms = 0;
  std::string state;  // see Rehearsal::Trace
  std::string hash;
};

// A criterion of the exercise, step or rule, as the marks have it.
struct ResultCriterion {
  std::string id;
  bool rule = false, held = false, must = false;
  double points = 0, of = 0;
  std::string mistake;
};

// What a student hands in. All that it says of the mark is a claim; verifyResult carries the actions out again.
struct SignedResult {
  Sealed seal;
  std::string assignment;       // the file that it answers, whole
  std::string assignment_hash;  // of what was signed in it
  std::string exercise, exercise_hash;
  std::string student, seed, device;
  std::string program, model;     // version; hash of the environment's file
  std::string started, finished;  // UTC, by the student's clock
  double score = 0, points = 0, of = 0, seconds = 0, hints = 0;
  bool passed = false;
  std::vector<ResultCriterion> criteria;
  std::vector<ResultAction> actions;
  std::string head;  // of the chain

  // The first link whose hash is not that of what it says, counted from 1; the number after the last where the end was
  // cut off or only the beginning does not fit.
  std::optional<std::size_t> brokenAt() const;
};

std::string modelHash(const Exercise& exercise);

// Writes <exercise>-<student>.result.json into the folder, signed by ownKey(), and returns its path.
Result<std::filesystem::path> writeResult(const Rehearsal& rehearsal, const Marks& marks, const Assignment& assignment,
                                          const std::string& started, const std::filesystem::path& folder);
// Its form only: whether seal, chain and mark are right is asked afterwards.
Result<SignedResult> resultFrom(Sealed seal, const std::string& file_name);
Result<SignedResult> readResult(const std::filesystem::path& file);

}  // namespace standpoint
