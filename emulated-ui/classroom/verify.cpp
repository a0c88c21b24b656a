// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/verify.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/json_file.h"
#include "core/scratch_folder.h"
#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

namespace {

using Verdict = Verification::Verdict;

constexpr std::size_t kMostActions = 5000;
constexpr double kLongest_s = 2 * 86400;  // of the device's clock: a result must not keep the lecturer's computer busy
constexpr double kSameScore = 1e-9;

Verification refused(Verdict verdict, std::string why, std::optional<std::size_t> from = {}) {
  return {verdict, std::move(why), from, std::nullopt};
}

Verification doesNotReplay(std::size_t from, const std::string& because) {
  return refused(Verdict::changed, fmt::format("does not replay from action {}: {}", from, because), from);
}

// What nothing needs to be carried out for.
std::optional<Verification> wrongAtSight(const SignedResult& result, const Assignment& given, const Variant*& variant) {
  if (result.assignment_hash != given.hash || result.exercise != given.id())
    return refused(Verdict::other_assignment,
                   result.exercise != given.id()
                       ? fmt::format("is a result of {}, not of {}", result.exercise, given.id())
                       : fmt::format("answers another assignment of {} than the lecturer's", given.id()));
  variant = given.variantOf(result.student);
  if (variant == nullptr)
    return refused(Verdict::unknown_student, fmt::format("the class has no student '{}'", result.student));
  if (result.seed != seedText(variant->seed))
    return refused(Verdict::other_assignment, fmt::format("has variant {}, but {} was given {}", result.seed,
                                                          result.student, seedText(variant->seed)));
  if (const auto broken = result.brokenAt())
    return doesNotReplay(*broken, broken == result.actions.size() + 1
                                      ? "the end of the record was cut off or changed"
                                      : "the record was changed there after it was made");
  if (result.actions.size() > kMostActions)
    return doesNotReplay(kMostActions + 1, fmt::format("more than {} actions", kMostActions));
  return std::nullopt;
}

class Replay {
 public:
  Replay(const SignedResult& result, const Exercise& exercise) : result_(result), exercise_(exercise) {}

  Result<Verification> run(const std::string& language, Progress& progress) {
    TRY_ASSIGN(const auto scratch, ScratchFolder::make());
    auto rehearsal = Rehearsal::start(exercise_, result_.device, scratch.path(), {}, progress);
    if (!rehearsal) {
      if (rehearsal.error().kind == ErrorKind::cancelled) return failure(rehearsal.error());
      return doesNotReplay(1, rehearsal.error().message);
    }
    for (std::size_t i = 0; i < result_.actions.size(); ++i) {
      TRY_ASSIGN(auto wrong, act(**rehearsal, i, progress));
      if (wrong) return *std::move(wrong);
    }
    TRY_ASSIGN(auto marks, marksOf(**rehearsal, result_.student, language, progress));
    auto found = compared(marks);
    found.marks = std::move(marks);
    return found;
  }

 private:
  Result<std::optional<Verification>> act(Rehearsal& rehearsal, std::size_t i, Progress& progress) {
    const auto& recorded = result_.actions[i];
    const auto place = fmt::format("action {}", i + 1);
    const auto written = parseJson(recorded.action, place);
    if (!written) return std::optional(doesNotReplay(i + 1, describe(written.error())));
    const auto action = actionFrom(*written, place, "");
    if (!action) return std::optional(doesNotReplay(i + 1, describe(action.error())));
    if (auto done = rehearsal.act(*action, progress); !done) {
      if (done.error().kind == ErrorKind::cancelled) return failure(done.error());
      return std::optional(doesNotReplay(i + 1, "the instrument refuses it: " + done.error().message));
    }
    if (!differs_from_ && rehearsal.traces().back().state != recorded.state) differs_from_ = i + 1;
    if (rehearsal.seconds() > kLongest_s) return std::optional(doesNotReplay(i + 1, "it takes more than two days"));
    return std::optional<Verification>();
  }

  Verification compared(const Marks& marks) const {
    const auto claims = [&](const auto& marked, bool rule, bool held) {
      return std::any_of(result_.criteria.begin(), result_.criteria.end(), [&](const ResultCriterion& c) {
        return c.rule == rule && c.id == marked.id && c.held == held && c.points == marked.points;
      });
    };
    bool same = std::abs(marks.score - result_.score) < kSameScore && marks.passed == result_.passed &&
                marks.hints == result_.hints && result_.criteria.size() == marks.steps.size() + marks.rules.size();
    for (const auto& s : marks.steps) same = same && claims(s, false, s.done);
    for (const auto& r : marks.rules) same = same && claims(r, true, r.held);
    if (same) return {};
    const auto scores =
        fmt::format("the result says {}, its actions give {}", percentText(result_.score), percentText(marks.score));
    if (differs_from_)
      return doesNotReplay(*differs_from_, "the instrument is in another state than recorded; " + scores);
    return refused(Verdict::other_mark, scores);
  }

  const SignedResult& result_;
  const Exercise& exercise_;
  std::optional<std::size_t> differs_from_;
};

}  // namespace

const char* wordOf(Verdict verdict) {
  constexpr const char* kWords[] = {"yes",           "changed",          "other mark",     "other version",
                                    "bad signature", "other assignment", "unknown student"};
  return kWords[static_cast<int>(verdict)];
}

Result<Verification> verifyResult(const SignedResult& result, const Assignment& given, const std::string& language,
                                  Progress& progress) {
  const Variant* variant = nullptr;
  if (auto wrong = wrongAtSight(result, given, variant)) return *std::move(wrong);
  TRY_ASSIGN(const auto exercise, given.exerciseWith(*variant));
  TRY_ASSIGN(auto found, Replay(result, exercise).run(language, progress));
  const bool other_version = result.program != STANDPOINT_VERSION || result.model != modelHash(exercise);
  if (!found.verified() && other_version)
    return refused(Verdict::other_version,
                   fmt::format("was made with version {} or another environment, this is {}; {}", result.program,
                               STANDPOINT_VERSION, found.why),
                   found.from_action);
  if (found.verified() && !result.seal.intact()) {
    found.verdict = Verdict::bad_signature;
    found.why = "the file was changed after it was signed, though not its actions";
  }
  return found;
}

Result<Verification> verifyAlone(const SignedResult& result, const std::string& language, Progress& progress) {
  auto seal = parseSeal(result.assignment, "assignment", kAssignmentKind);
  if (!seal) return refused(Verdict::other_assignment, "brings no assignment: " + describe(seal.error()));
  const auto given = assignmentFrom(*std::move(seal), "assignment");
  if (!given) return refused(Verdict::other_assignment, describe(given.error()));
  return verifyResult(result, *given, language, progress);
}

}  // namespace standpoint
