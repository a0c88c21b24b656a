// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/classroom/signed_result.h"
#include "emulated-ui/rehearsal/marks.h"

namespace standpoint {

// Whether a result's actions give the mark that it says. Not who did them, nor when: nothing on a student's computer
// could prove that.
struct Verification {
  enum class Verdict {
    yes,
    changed,           // an action or its record: see `from_action`
    other_mark,        // all actions are as recorded, and give another mark
    other_version,     // made with another version of program or environment, and does not replay
    bad_signature,     // the actions give the mark, but something beside them was changed after signing
    other_assignment,  // another exercise than the lecturer's, or another variant than the student's
    unknown_student,   // not of this class
  } verdict = Verdict::yes;
  std::string why;                         // in a sentence, in English; empty where it is verified
  std::optional<std::size_t> from_action;  // counted from 1
  std::optional<Marks> marks;              // what the replay gives; nothing where it came to no end
  bool verified() const { return verdict == Verdict::yes; }
};
const char* wordOf(Verification::Verdict verdict);  // "yes", "changed", "other mark", …

// Carries it out on the lecturer's own copy of the exercise. An error is a cancel, or that of a disk.
Result<Verification> verifyResult(const SignedResult& result, const Assignment& given, const std::string& language,
                                  Progress& progress);
// On the assignment that the result brings along: whoever made that is named by the key's fingerprint.
Result<Verification> verifyAlone(const SignedResult& result, const std::string& language, Progress& progress);

}  // namespace standpoint
