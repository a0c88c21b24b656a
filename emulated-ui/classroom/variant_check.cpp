// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/variant_check.h"

#include <algorithm>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "core/scratch_folder.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/proofs.h"
#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

namespace {

using nlohmann::json;
using Actions = std::vector<RehearsalAction>;

constexpr double kMargin = 0.1;           // of a measured figure, to the limit that it must keep
constexpr double kTimeSpread = 0.15;      // of the median
constexpr std::size_t kTriedForEach = 4;  // seeds, before the search for one more variant is given up
constexpr double kFull = 1 - 1e-9;

const ProofRow* measured(const std::string& fact) {
  for (const auto& row : proofRows())
    if (fact == row.name) return &row;
  return nullptr;
}

// A share of all cannot leave 0 to 1: there it is a tenth of the way to the nearer end.
double marginOf(const ProofRow& row, double value) {
  const bool share = *row.unit == '\0' && row.domain.minimum == 0 && row.domain.maximum == 1;
  return kMargin * (share ? std::min(value, 1 - value) : std::abs(value));
}

// A criterion of the end that holds, but would not if a measured figure were a tenth greater or less.
std::optional<std::string> withoutMargin(const Rehearsal& done) {
  for (const auto& rule : done.exercise().rules) {
    if (rule.when != "end") continue;
    for (const double way : {-1.0, 1.0}) {
      const auto shifted = [&](const std::string& name) {
        auto fact = done.fact(name);
        if (const auto* row = measured(name); row != nullptr && fact && fact->number)
          fact->number = *fact->number + way * marginOf(*row, *fact->number);
        return fact;
      };
      if (!rule.holds.holds(shifted))
        return fmt::format("the solution meets '{}' ({}) with a margin of less than {:.0f} %", rule.id,
                           rule.holds.text(), 100 * kMargin);
    }
  }
  return std::nullopt;
}

struct Tried {
  Marks marks;
  std::optional<std::string> without_margin;
  std::string refused;  // the first action that the device refused
};

Result<Tried> tried(const Exercise& exercise, const Actions& actions, Progress& progress) {
  TRY_ASSIGN(const auto scratch, ScratchFolder::make());
  TRY_ASSIGN(const auto rehearsal, Rehearsal::start(exercise, {}, scratch.path(), {}, progress));
  Tried found;
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (auto ok = rehearsal->act(actions[i], progress); !ok) {
      if (ok.error().kind == ErrorKind::cancelled) return failure(ok.error());
      if (found.refused.empty()) found.refused = fmt::format("action {}: {}", i + 1, describe(ok.error()));
    }
  TRY_ASSIGN(found.marks, marksOf(*rehearsal, {}, "en", progress));
  found.without_margin = withoutMargin(*rehearsal);
  return found;
}

struct Candidate {
  CheckedVariant checked;
  Exercise exercise;
};

class Search {
 public:
  Search(const json& exercise, const std::string& file, Report& report, Progress& progress)
      : exercise_(exercise), file_(file), report_(report), progress_(progress) {}

  Result<std::vector<CheckedVariant>> find(std::size_t most, const SigningKey& key) {
    TRY_ASSIGN(const auto figures, variantFigures(exercise_, file_));
    const auto wanted = std::min(most, countVariants(figures));
    const auto tries = figures.empty() ? 1 : kTriedForEach * wanted;
    for (std::size_t n = 0; n < tries; ++n) {
      if (found_.size() >= wanted) TRY(closeRing());
      if (found_.size() >= wanted) break;
      const auto share = static_cast<double>(found_.size()) / static_cast<double>(wanted);
      progress_.stage(fmt::format("Checking variant {} of {}", found_.size() + 1, wanted), share, 1);
      const auto seed = seedFor(exercise_, n, key);
      Variant variant{seed, drawnFigures(figures, seed)};
      if (seen_.insert(json(variant.figures).dump()).second) TRY(consider(std::move(variant)));
    }
    TRY(closeRing());
    keepAlike();
    if (found_.empty()) return failure(ErrorKind::unusable, "no variant can be given: " + last_reason_, file_);
    if (found_.size() < wanted)
      report_.warn(file_, fmt::format("{} of {} variants can be given", found_.size(), wanted));
    std::vector<CheckedVariant> checked;
    for (auto& one : found_) checked.push_back(std::move(one.checked));
    return checked;
  }

 private:
  void refuse(const Variant& variant, const std::string& why) {
    last_reason_ = why;
    report_.note(fmt::format("{} variant {}", file_, json(variant.figures).dump()), why);
  }

  Result<void> consider(Variant variant) {
    TRY_ASSIGN(auto exercise, exerciseFrom(exercise_, file_, variant.figures));
    if (exercise.solution.empty())
      return failure(ErrorKind::unusable, "without a solution no variant can be checked", file_ + " /solution");
    TRY_ASSIGN(const auto solved, tried(exercise, exercise.solution, progress_));
    if (solved.marks.score < kFull)
      return refuse(variant, fmt::format("its solution is worth {}{}{}", percentText(solved.marks.score),
                                         solved.refused.empty() ? "" : "; ", solved.refused)),
             Result<void>();
    if (solved.without_margin) return refuse(variant, *solved.without_margin), Result<void>();
    TRY_ASSIGN(const auto nothing, tried(exercise, {}, progress_));
    if (nothing.marks.passed) return refuse(variant, "doing nothing passes"), Result<void>();
    for (const auto& mistake : exercise.mistakes) {
      TRY_ASSIGN(const auto wrong, tried(exercise, mistake.actions, progress_));
      if (wrong.marks.passed) return refuse(variant, fmt::format("mistake {} passes", mistake.id)), Result<void>();
    }
    Candidate candidate{{std::move(variant), solved.marks.seconds, 0}, std::move(exercise)};
    if (!found_.empty()) {
      TRY_ASSIGN(const auto copied, copyPasses(candidate, found_.back()));
      if (copied) return {};
    }
    found_.push_back(std::move(candidate));
    return {};
  }

  // Whether the solution of `neighbour` passes here; then this one is refused.
  Result<bool> copyPasses(Candidate& here, const Candidate& neighbour) {
    TRY_ASSIGN(const auto copied, tried(here.exercise, neighbour.exercise.solution, progress_));
    here.checked.neighbour_score = copied.marks.score;
    if (copied.marks.passed)
      refuse(here.checked.variant,
             fmt::format("the solution of variant {} passes here, too ({})",
                         json(neighbour.checked.variant.figures).dump(), percentText(copied.marks.score)));
    return copied.marks.passed;
  }

  // The first one has the last one as its neighbour, whichever is the first then.
  Result<void> closeRing() {
    while (found_.size() > 1) {
      TRY_ASSIGN(const auto copied, copyPasses(found_.front(), found_.back()));
      if (!copied) break;
      found_.erase(found_.begin());
    }
    return {};
  }

  void keepAlike() {
    if (found_.size() < 3) return;
    std::vector<double> seconds;
    for (const auto& one : found_) seconds.push_back(one.checked.seconds);
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2), seconds.end());
    const double median = seconds[seconds.size() / 2];
    std::erase_if(found_, [&](const Candidate& one) {
      const bool other = std::abs(one.checked.seconds - median) > kTimeSpread * median;
      if (other)
        refuse(one.checked.variant,
               fmt::format("its solution takes {:.0f} s, the median is {:.0f} s", one.checked.seconds, median));
      return other;
    });
  }

  const json& exercise_;
  const std::string& file_;
  Report& report_;
  Progress& progress_;
  std::vector<Candidate> found_;
  std::set<std::string> seen_;
  std::string last_reason_ = "none was drawn";
};

}  // namespace

Result<std::vector<CheckedVariant>> checkedVariants(const json& exercise, const std::string& file_name,
                                                    std::size_t most, const SigningKey& key, Report& report,
                                                    Progress& progress) {
  return Search(exercise, file_name, report, progress).find(most, key);
}

}  // namespace standpoint
