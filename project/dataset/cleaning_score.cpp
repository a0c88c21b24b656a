// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/cleaning_score.h"

#include <utility>

#include <fmt/format.h>

#include "pointclouds/scores/cleaning_scores.h"
#include "pointclouds/scores/kept_points.h"
#include "project/dataset/share_text.h"

namespace standpoint {

namespace {

// A fraction that is not asked of nothing.
std::optional<double> fractionOf(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::nullopt : std::optional(static_cast<double>(part) / static_cast<double>(whole));
}

void takeScores(const CleaningScores& scores, CleaningAnswer& answer) {
  answer.points = scores.points.in;
  answer.removed = scores.points.taken;
  answer.flawed = causeOf(scores.flawed, answer.removed);
  answer.good = countOf(scores.good);
  for (std::size_t bit = 0; bit < scores.flags.size(); ++bit)
    answer.causes[flagNames()[bit]] = causeOf(scores.flags[bit], answer.removed);
  answer.plainly_mixed = countOf(scores.plainly_mixed);
  for (const auto& one : scores.classes) answer.classes.push_back({one.name, countOf(one.good), countOf(one.flawed)});
  for (const auto& one : scores.movers) answer.movers.push_back({one.id, one.name, countOf(one.points)});
}

std::string cleaningText(const CleaningAnswer& a) {
  std::string text = fmt::format("{:24} {:>12} {:>12} {:>10} {:>10}\n", "points that should go", "points", "removed",
                                 "recall", "precision");
  const auto line = [&](const std::string& name, const CleanCause& c) {
    if (c.in > 0)
      text += fmt::format("{:24} {:>12} {:>12} {:>10} {:>10}\n", name, c.in, c.removed, shareText(c.recall),
                          shareText(c.precision));
  };
  line("all", a.flawed);
  for (const auto& [name, cause] : a.causes) line(name, cause);
  if (a.plainly_mixed.in > 0)
    line("mixed > 1 cm", {a.plainly_mixed.in, a.plainly_mixed.removed, a.plainly_mixed.fraction, {}});
  for (const auto& m : a.movers) line(m.name, {m.points.in, m.points.removed, m.points.fraction, {}});
  text += fmt::format("\n{:24} {:>12} {:>12} {:>10}\n", "good points", "points", "lost", "share");
  const auto lost = [&](const std::string& name, const CleanCount& c) {
    if (c.in > 0) text += fmt::format("{:24} {:>12} {:>12} {:>10}\n", name, c.in, c.removed, shareText(c.fraction));
  };
  lost("all", a.good);
  for (const auto& c : a.classes) lost(c.name, c.good);
  return text;
}

void reportMatching(const CleaningAnswer& answer, const KeptPoints& points, Report& report) {
  const auto source = answer.cleaned.string();
  if (answer.shift_m != Eigen::Vector3d::Zero())
    report.note(source,
                fmt::format("moved back by {} {} {} m", answer.shift_m.x(), answer.shift_m.y(), answer.shift_m.z()));
  if (answer.doubled > 0)
    report.note(source, fmt::format("points that it has more often than the truth: {}", answer.doubled));
  if (answer.unknown > 0)
    report.note(source, fmt::format("points where the truth has none, the first at {:.3f} {:.3f} {:.3f}: {}",
                                    points.first_unknown->x(), points.first_unknown->y(), points.first_unknown->z(),
                                    answer.unknown));
}

}  // namespace

CleanCount countOf(const Taken& taken) { return {taken.in, taken.taken, fractionOf(taken.taken, taken.in)}; }

CleanCause causeOf(const Taken& taken, std::uint64_t removed) {
  return {taken.in, taken.taken, fractionOf(taken.taken, taken.in), fractionOf(taken.taken, removed)};
}

const AnswerFields<CleanCount>& answerFields(const CleanCount*) {
  using A = CleanCount;
  static const AnswerFields<A> fields = {{"in", &A::in}, {"removed", &A::removed}, {"share", &A::fraction}};
  return fields;
}

const AnswerFields<CleanCause>& answerFields(const CleanCause*) {
  using A = CleanCause;
  static const AnswerFields<A> fields = {
      {"in", &A::in}, {"removed", &A::removed}, {"recall", &A::recall}, {"precision", &A::precision}};
  return fields;
}

const AnswerFields<CleanedClassRow>& answerFields(const CleanedClassRow*) {
  using A = CleanedClassRow;
  static const AnswerFields<A> fields = {{"class", &A::name}, {"good", &A::good}, {"flawed", &A::flawed}};
  return fields;
}

const AnswerFields<CleanedMoverRow>& answerFields(const CleanedMoverRow*) {
  using A = CleanedMoverRow;
  static const AnswerFields<A> fields = {{"id", &A::id}, {"name", &A::name}, {"points", &A::points}};
  return fields;
}

const AnswerFields<CleaningAnswer>& answerFields(const CleaningAnswer*) {
  using A = CleaningAnswer;
  static const AnswerFields<A> fields = {{"truth", &A::truth},
                                         {"cleaned", &A::cleaned},
                                         {"points", &A::points},
                                         {"cleaned_points", &A::cleaned_points},
                                         {"removed", &A::removed},
                                         {"doubled", &A::doubled},
                                         {"unknown", &A::unknown},
                                         {"thinned", &A::thinned, kLeftOut},
                                         {"shift_m", &A::shift_m},
                                         {"flawed", &A::flawed},
                                         {"good", &A::good},
                                         {"causes", &A::causes},
                                         {"mixed_by_over_1cm", &A::plainly_mixed},
                                         {"classes", &A::classes},
                                         {"movers", &A::movers}};
  return fields;
}

Result<Answered<CleaningAnswer>> scoreCleaning(const Document& document, const ScoreOptions& options,
                                               Progress& progress) {
  std::error_code error;
  for (const auto& file : {options.truth, options.predicted})
    if (!std::filesystem::is_regular_file(file, error))
      return failure(ErrorKind::file_system, "file not found", file.string());
  KeptOptions how;
  if (options.tolerance_m) how.tolerance_m = *options.tolerance_m;
  how.shift_m = options.shift_m;
  TRY_ASSIGN(auto points, keptPoints(options.truth, options.predicted, how, progress));
  Answered<CleaningAnswer> outcome{document};
  auto& answer = outcome.answer;
  answer.truth = options.truth, answer.cleaned = options.predicted;
  answer.cleaned_points = points.cleaned;
  answer.doubled = points.doubled, answer.unknown = points.unknown;
  answer.shift_m = points.shift_m;
  if (options.spacing_m) {
    TRY_ASSIGN(answer.thinned, keepThinned(options.truth, *options.spacing_m, points, progress));
  }
  progress.stage("Score the cleaning");
  TRY_ASSIGN(const auto scores, cleaningScores(options.truth, points.kept, progress));
  takeScores(scores, answer);
  if (answer.points == 0) return failure(ErrorKind::unusable, "the cloud has no points", options.truth.string());
  reportMatching(answer, points, outcome.report);
  std::string pictures;
  if (options.output.extension() == ".html") {
    TRY_ASSIGN(pictures, picturesOfCleaning(answer, points.kept, progress));
  }
  if (!options.output.empty()) TRY(writeCleaningReport(answer, pictures, options.output));
  outcome.description =
      fmt::format("Scored a cleaning: removed {} of {} points that should go, lost {} of {} good ones",
                  answer.flawed.removed, answer.flawed.in, answer.good.removed, answer.good.in);
  outcome.text = cleaningText(answer);
  return outcome;
}

}  // namespace standpoint
