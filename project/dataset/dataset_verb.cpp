// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/dataset/dataset_verb.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/number_text.h"
#include "project/dataset/manifest.h"
#include "project/dataset/set_run.h"
#include "project/dataset/set_verify.h"
#include "project/dataset/slurm_job.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;
using DatasetOutcome = Answered<DatasetAnswer>;

Result<void> needsOutput(const DatasetOptions& options) {
  return options.output.empty() ? failure(ErrorKind::usage, "specify the folder of the set: -o SET", "--output")
                                : Result<void>();
}

// What another action would have asked for.
Result<void> checkAction(const DatasetOptions& options) {
  using A = DatasetAction;
  const auto refuse = [&](bool said, const char* option, const char* where) -> Result<void> {
    if (!said) return {};
    return failure(ErrorKind::usage, fmt::format("belongs to `dataset {}`", where), option);
  };
  const bool is_run = options.action == A::run, is_slurm = options.action == A::slurm;
  if (options.shard && !is_run && options.action != A::verify)
    return failure(ErrorKind::usage, "belongs to `dataset run` and `dataset verify`", "--shard");
  TRY(refuse(options.resume && !is_run, "--resume", "run"));
  TRY(refuse(options.shards != 1 && !is_slurm, "--shards", "slurm"));
  if (is_run || is_slurm) return needsOutput(options);
  return refuse(!options.output.empty(), "--output", "run");
}

std::string classText(const SetClassForecast& c) {
  return fmt::format("{:12} {:10} {:24} {:>16} {:7.3f} %{}\n", c.classes, c.split, c.name,
                     groupedDigits(static_cast<std::uint64_t>(std::llround(c.points))), 100 * c.share,
                     c.points == 0 ? "  none"
                     : c.starved   ? "  starved"
                                   : "");
}

Result<void> checkRecipe(const DatasetOptions& options, DatasetOutcome& outcome, Progress& progress) {
  TRY_ASSIGN(const auto recipe, readRecipe(options.of));
  TRY_ASSIGN(auto forecast, forecastSet(recipe, options.samples, outcome.report, progress));
  auto& answer = outcome.answer;
  answer.recipe = recipe.name;
  answer.scans = forecast.scans;
  answer.points = static_cast<std::uint64_t>(std::llround(forecast.points));
  answer.bytes = static_cast<std::uint64_t>(std::llround(forecast.bytes));
  constexpr double kSecondsPerHour = 3600;
  answer.instrument_hours = forecast.instrument_seconds / kSecondsPerHour;
  answer.compute_hours = forecast.points / options.rate_points_per_s / kSecondsPerHour;
  answer.places = placesOf(recipe).size();
  for (const auto& e : forecast.environments)
    outcome.text += fmt::format("{:20} {:10} {:4} of {:4} places  {:6} scans  {:10.2f} M points\n", e.environment,
                                e.split, e.stations, e.places, e.scans, e.points / 1e6);
  std::size_t starved = 0;
  for (const auto& c : forecast.classes) {
    outcome.text += classText(c);
    starved += c.starved;
  }
  for (const auto& text : forecast.unmapped) outcome.text += "no rule for " + text + "\n";
  if (starved > 0)
    outcome.report.note(recipe.name,
                        fmt::format("{} of {} classes of a split are starved: less than {} % of its points", starved,
                                    forecast.classes.size(), 100 * recipe.starved_below));
  outcome.description =
      fmt::format("{} would make {} scans with {:.1f} M points and {:.2f} GB in {:.1f} h", recipe.name, forecast.scans,
                  forecast.points / 1e6, forecast.bytes / 1e9, *answer.compute_hours);
  answer.environments = std::move(forecast.environments);
  answer.classes = std::move(forecast.classes);
  answer.unmapped = std::move(forecast.unmapped);
  return {};
}

void takeCheck(const SetCheck& check, DatasetAnswer& answer) {
  answer.files = check.files;
  answer.scans = check.scans.size();
  answer.not_made = check.not_made;
  answer.points = 0;
  answer.bytes = 0;
  for (const auto& scan : check.scans) {
    *answer.points += scan.record.points;
    for (const auto& file : scan.record.files) *answer.bytes += file.bytes;
  }
  answer.missing = check.missing;
  answer.damaged = check.damaged;
  answer.unknown = check.unknown;
}

std::string wrongWith(const SetCheck& check) {
  const auto& first = check.damaged.empty() ? check.missing.front() : check.damaged.front();
  return fmt::format(
      "{} of its files are missing and {} damaged, the first is {}; remove what is damaged and resume the "
      "run",
      check.missing.size(), check.damaged.size(), first);
}

// What is in it is nobody's loss: a run goes on and will finish it, or died and was resumed.
void noteWork(const fs::path& set, DatasetOutcome& outcome) {
  outcome.answer.working = workFoldersOf(set);
  for (const auto& folder : outcome.answer.working)
    outcome.report.note(folder, "is of a run that goes on, or that died on another machine: then it can be removed");
}

Result<void> describeSet(const fs::path& set, const Recipe& recipe, DatasetOutcome& outcome, Progress& progress) {
  TRY_ASSIGN(const auto check, checkSet(set, recipe, Shard(), progress));
  takeCheck(check, outcome.answer);
  if (!check.isWhole()) return failure(ErrorKind::unusable, wrongWith(check), set.string());
  TRY_ASSIGN(outcome.answer.written, writeManifest(set, recipe, check, progress));
  std::error_code ignored;
  fs::remove(set / kWorkFolder, ignored);  // where no other run has anything in it
  noteWork(set, outcome);
  return {};
}

Result<void> makeSet(const DatasetOptions& options, DatasetOutcome& outcome, Progress& progress) {
  TRY_ASSIGN(const auto recipe, readRecipe(options.of));
  TRY_ASSIGN(const auto count, runSet(recipe, {options.output, options.shard, options.resume, options.threads},
                                      outcome.report, progress));
  auto& answer = outcome.answer;
  answer.recipe = recipe.name;
  answer.scans = count.scans;
  answer.resumed = count.resumed;
  answer.places = count.places;
  answer.without_room = count.without_room;
  answer.points = count.points;
  answer.bytes = count.bytes;
  if (count.seconds > 0) answer.points_per_second = static_cast<double>(count.points) / count.seconds;
  if (!options.shard) TRY(describeSet(options.output, recipe, outcome, progress));
  outcome.description = fmt::format("{} scans of {} with {:.1f} M points", count.scans, recipe.name,
                                    static_cast<double>(count.points) / 1e6);
  return {};
}

Result<void> verifySet(const DatasetOptions& options, DatasetOutcome& outcome, Progress& progress) {
  TRY_ASSIGN(const auto recipe, readRecipeOfSet(options.of));
  const auto shard = options.shard.value_or(Shard());
  TRY_ASSIGN(const auto check, checkSet(options.of, recipe, shard, progress));
  outcome.answer.recipe = recipe.name;
  takeCheck(check, outcome.answer);
  for (const auto& path : check.missing) outcome.report.lose(path, "is missing: resume the run to make it");
  for (const auto& path : check.damaged) outcome.report.lose(path, "is damaged: remove it and resume the run");
  for (const auto& path : check.unknown) outcome.report.warn(path, "belongs to no scan of the recipe");
  if (shard.index == 1) noteWork(options.of, outcome);
  const auto what = options.shard ? fmt::format("{} ({}/{})", recipe.name, shard.index, shard.count) : recipe.name;
  outcome.description = check.isWhole() ? fmt::format("{} is whole: {} files as they were written", what, check.files)
                                        : fmt::format("{} is not whole: {} files missing, {} damaged", what,
                                                      check.missing.size(), check.damaged.size());
  return {};
}

Result<void> manifestOfSet(const DatasetOptions& options, DatasetOutcome& outcome, Progress& progress) {
  TRY_ASSIGN(const auto recipe, readRecipeOfSet(options.of));
  outcome.answer.recipe = recipe.name;
  TRY(describeSet(options.of, recipe, outcome, progress));
  outcome.description = fmt::format("Described {}: {} scans", recipe.name, *outcome.answer.scans);
  return {};
}

Result<void> slurmOf(const DatasetOptions& options, DatasetOutcome& outcome) {
  TRY_ASSIGN(const auto recipe, readRecipe(options.of));
  const auto places = placesOf(recipe).size();
  if (options.shards > places)
    return failure(ErrorKind::usage,
                   fmt::format("the recipe has {} places, no more shards than that make sense", places), "--shards");
  std::error_code error;
  SlurmJob job{fs::absolute(options.of, error).lexically_normal(),
               fs::absolute(options.output, error).lexically_normal(), fs::read_symlink("/proc/self/exe", error),
               options.shards, std::max(options.threads, 1)};
  outcome.answer.recipe = recipe.name;
  outcome.answer.places = places;
  TRY_ASSIGN(outcome.answer.written, writeSlurmJob(job, recipe));
  outcome.description = fmt::format("Wrote a job array of {} tasks; start it by {}", options.shards,
                                    (job.set / "slurm" / "submit").string());
  return {};
}

}  // namespace

std::span<const Choice<DatasetAction>> choices(DatasetAction) {
  using A = DatasetAction;
  static constexpr std::array kActions = {Choice<A>{"check", A::check}, Choice<A>{"run", A::run},
                                          Choice<A>{"verify", A::verify}, Choice<A>{"manifest", A::manifest},
                                          Choice<A>{"slurm", A::slurm}};
  return kActions;
}

const Fields<DatasetOptions>& datasetFields() {
  using O = DatasetOptions;
  static const Fields<O> fields = {
      {"action",
       &O::action,
       "check a recipe and forecast its set; run it; verify a set; write the manifest of a set; write a Slurm job",
       {.positional = true, .required = true}},
      {"of",
       &O::of,
       "the recipe (.json); of verify and manifest, the folder of the set",
       {.positional = true, .required = true, .label = "Recipe or set"}},
      {"output", &O::output, "folder of the set", {.label = "Folder of the set"}},
      {"shard", &O::shard, "i/n: only the i-th of n shares of the places, to run or verify a set on several machines"},
      {"resume", &O::resume, "continue a run that was cancelled or crashed; keep its finished scans"},
      {"threads", &O::threads, "0 = all; the result is the same", {.minimum = 0, .maximum = 1024}},
      {"shards", &O::shards, "number of tasks of the Slurm job", {.minimum = 1, .maximum = 10000}},
      {"samples",
       &O::samples,
       "number of sample points on the surfaces of each environment, for the forecast",
       {.minimum = 100, .maximum = 5000000}},
      {"rate",
       &O::rate_points_per_s,
       "points per second of the machine that will run it, for the forecast of hours",
       {.minimum = 1, .maximum = 1e12}}};
  return fields;
}

const AnswerFields<SetEnvironmentForecast>& answerFields(const SetEnvironmentForecast*) {
  using A = SetEnvironmentForecast;
  static const AnswerFields<A> fields = {
      {"environment", &A::environment}, {"building", &A::building}, {"split", &A::split},
      {"places", &A::places},           {"stations", &A::stations}, {"scans", &A::scans},
      {"points", &A::points},           {"bytes", &A::bytes},       {"instrument_seconds", &A::instrument_seconds}};
  return fields;
}

const AnswerFields<SetClassForecast>& answerFields(const SetClassForecast*) {
  using A = SetClassForecast;
  static const AnswerFields<A> fields = {{"classes", &A::classes}, {"split", &A::split}, {"class", &A::name},
                                         {"points", &A::points},   {"share", &A::share}, {"starved", &A::starved}};
  return fields;
}

const AnswerFields<DatasetAnswer>& answerFields(const DatasetAnswer*) {
  using A = DatasetAnswer;
  static const AnswerFields<A> fields = {{"recipe", &A::recipe},
                                         {"scans", &A::scans, kLeftOut},
                                         {"points", &A::points, kLeftOut},
                                         {"bytes", &A::bytes, kLeftOut},
                                         {"places", &A::places, kLeftOut},
                                         {"instrument_hours", &A::instrument_hours, kLeftOut},
                                         {"compute_hours", &A::compute_hours, kLeftOut},
                                         {"environments", &A::environments, kLeftOut},
                                         {"classes", &A::classes, kLeftOut},
                                         {"unmapped", &A::unmapped, kLeftOut},
                                         {"resumed", &A::resumed, kLeftOut},
                                         {"without_room", &A::without_room, kLeftOut},
                                         {"points_per_second", &A::points_per_second, kLeftOut},
                                         {"files", &A::files, kLeftOut},
                                         {"not_made", &A::not_made, kLeftOut},
                                         {"missing", &A::missing, kLeftOut},
                                         {"damaged", &A::damaged, kLeftOut},
                                         {"unknown", &A::unknown, kLeftOut},
                                         {"working", &A::working, kLeftOut},
                                         {"written", &A::written, kLeftOut}};
  return fields;
}

Result<Answered<DatasetAnswer>> runDataset(const Document& document, const DatasetOptions& options,
                                           Progress& progress) {
  TRY(checkAction(options));
  Answered<DatasetAnswer> outcome{document};
  switch (options.action) {
    case DatasetAction::check: TRY(checkRecipe(options, outcome, progress)); break;
    case DatasetAction::run: TRY(makeSet(options, outcome, progress)); break;
    case DatasetAction::verify: TRY(verifySet(options, outcome, progress)); break;
    case DatasetAction::manifest: TRY(manifestOfSet(options, outcome, progress)); break;
    case DatasetAction::slurm: TRY(slurmOf(options, outcome)); break;
  }
  return outcome;
}

}  // namespace standpoint
