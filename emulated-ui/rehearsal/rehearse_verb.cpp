// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/rehearse_verb.h"

#include <filesystem>

#include <fmt/format.h>

#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/names.h"

namespace standpoint {

namespace {

using nlohmann::json;
using K = ParameterKind;

json listOf(const std::vector<KnownExercise>& known, const std::string& language) {
  json rows = json::array();
  for (const auto& one : known)
    rows.push_back({{"id", one.exercise.id},
                    {"title", one.exercise.title.in(language)},
                    {"devices", one.exercise.devices},
                    {"file", one.file.string()}});
  return rows;
}

Result<Outcome> listExercises(const Document& document, const std::string& language) {
  const auto known = knownExercises();
  Outcome outcome{document, {{"exercises", listOf(known.readable, language)}}, {}, {}, {}};
  for (const auto& error : known.refused) outcome.report.warn(error.source, error.message);
  outcome.description = fmt::format("{} exercises", known.readable.size());
  for (const auto& one : known.readable)
    outcome.text += fmt::format("{:6} {}  ({})\n", one.exercise.id, one.exercise.title.in(language),
                                fmt::join(one.exercise.devices, ", "));
  return outcome;
}

// What is wrong or doubtful with one file. An error is a cancel.
Result<Report> findingsOf(const std::string& file, std::string& id, Progress& progress) {
  Report report;
  const auto exercise = readExercise(file);
  if (!exercise) {
    report.lose(exercise.error().source, exercise.error().message);
    return report;
  }
  id = exercise->id;
  for (const auto& fault : checkExercise(*exercise)) report.lose(fault.source, fault.message);
  if (!report.issues.empty()) return report;
  if (const auto started = checkStart(*exercise, report, progress); !started) {
    if (started.error().kind != ErrorKind::unusable) return failure(started.error());
    report.lose(started.error().source, started.error().message);
  }
  return report;
}

// All files are checked, whatever is wrong with one of them.
Result<Outcome> checkFiles(const Document& document, const json& files, Progress& progress) {
  Outcome outcome{document, json::object(), {}, {}, {}};
  json rows = json::array();
  std::size_t sound = 0;
  for (const auto& file : files) {
    const auto name = file.get<std::string>();
    std::string id;
    progress.stage("Checking " + name, static_cast<double>(rows.size()) / static_cast<double>(files.size()),
                   static_cast<double>(rows.size() + 1) / static_cast<double>(files.size()));
    const auto report = findingsOf(name, id, progress);
    if (!report) return failure(report.error());
    json findings = json::array();
    for (const auto& issue : report->issues)
      findings.push_back({{"severity", issue.severity == Severity::loss ? "error" : "warning"},
                          {"source", issue.source},
                          {"message", issue.message}});
    sound += report->losses() == 0 ? 1 : 0;
    rows.push_back({{"file", name}, {"id", id}, {"sound", report->losses() == 0}, {"findings", std::move(findings)}});
    outcome.text += fmt::format("{:8} {}\n", report->losses() == 0 ? "sound" : "refused", name);
    for (const auto& issue : report->issues)
      outcome.text += fmt::format("  {}: {}: {}\n", issue.severity == Severity::loss ? "error" : "warning",
                                  issue.source, issue.message);
  }
  if (sound < rows.size())
    outcome.report.lose("--check", fmt::format("{} of {} files are invalid", rows.size() - sound, rows.size()));
  outcome.answer = {{"sound", sound == rows.size()}, {"files", std::move(rows)}};
  outcome.description = fmt::format("{} of {} exercises are valid", sound, files.size());
  return outcome;
}

Result<Outcome> listNames(const Document& document, const json& options) {
  Outcome outcome{document, json::object(), {}, {}, {}};
  if (!options.contains("device")) {
    auto devices = deviceNames();
    if (!devices) return failure(devices.error());
    outcome.text = deviceNamesText(*devices);
    outcome.answer = {{"devices", *std::move(devices)}};
    return outcome;
  }
  auto names = namesOf(options["device"].get<std::string>());
  if (!names) return failure(names.error());
  outcome.text = namesText(*names);
  outcome.answer = *std::move(names);
  return outcome;
}

// Why it is not passed, in one line.
std::string whyNotPassed(const json& marks) {
  std::string why = fmt::format("not passed: score {:.0f} %, {:.0f} % required", marks["score"].get<double>() * 100,
                                marks["pass_mark"].get<double>() * 100);
  for (const auto& id : marks["must_broken"]) why += fmt::format("; required: '{}'", id.get<std::string>());
  return why + (marks["in_time"].get<bool>() ? "" : "; over the time limit");
}

Result<Outcome> runRehearse(const Document& document, const json& options, Progress& progress) {
  const auto language = options.at("language").get<std::string>();
  const bool names = options.value("names", false);
  if (static_cast<int>(options.contains("exercise")) + static_cast<int>(options.contains("check")) +
          static_cast<int>(names) >
      1)
    return failure(ErrorKind::usage, "--check, --names and carrying out an exercise cannot be combined", "--check");
  if (options.contains("check")) return checkFiles(document, options["check"], progress);
  if (names) return listNames(document, options);
  if (!options.contains("exercise")) return listExercises(document, language);
  auto known = findExercise(options["exercise"].get<std::string>());
  if (!known) return failure(known.error());
  std::vector<RehearsalAction> actions;
  const bool solution = options.value("solution", false);
  if (solution == options.contains("actions"))
    return failure(ErrorKind::usage, "specify the actions: --actions FILE, or --solution for the sample solution",
                   "--actions");
  if (solution) {
    actions = known->exercise.solution;
  } else {
    auto read = readActions(options["actions"].get<std::string>());
    if (!read) return failure(read.error());
    actions = *std::move(read);
  }
  const std::filesystem::path folder = options.at("output").get<std::string>();
  auto rehearsal = Rehearsal::start(known->exercise, options.value("device", std::string()), folder, {}, progress);
  if (!rehearsal) return failure(rehearsal.error());
  Outcome outcome{document, json::object(), {}, {}, {}};
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (auto done = (*rehearsal)->act(actions[i], progress); !done) {
      if (done.error().kind == ErrorKind::cancelled) return failure(done.error());
      outcome.report.warn(fmt::format("action {}", i),
                          describe(done.error()));  // the device refused; the student goes on
    }
  outcome.answer = marksOf(**rehearsal, options.value("student", std::string()), language);
  if (auto written = writeMarks(**rehearsal, outcome.answer, folder); !written) return failure(written.error());
  outcome.text = marksText(outcome.answer);
  if (!outcome.answer["passed"].get<bool>()) outcome.report.lose(known->exercise.id, whyNotPassed(outcome.answer));
  outcome.description = fmt::format("Rehearsed {}: {}", known->exercise.id,
                                    outcome.answer["passed"].get<bool>() ? "passed" : "not passed");
  return outcome;
}

const std::vector<Verb>& table() {
  static const std::vector<Verb> verbs = {
      {"rehearse",
       "Run an exercise on an emulated instrument from a list of actions and grade it (exit code 3: not passed); "
       "without an exercise, list all",
       VerbScope::files,
       {{.name = "exercise", .kind = K::text, .help = "exercise file, or id such as E03", .positional = true},
        {.name = "actions",
         .kind = K::path,
         .help = "JSON file with the list of actions; an exported result replays its actions"},
        {.name = "solution", .kind = K::flag, .help = "perform the sample solution"},
        {.name = "check",
         .kind = K::list,
         .help = "exercise files to validate, including a trial start (exit code 3: at least one is invalid)"},
        {.name = "names",
         .kind = K::flag,
         .help = "list devices, or with --device all names and choices available to exercises"},
        {.name = "device", .kind = K::text, .help = "device id, if the exercise supports several devices"},
        {.name = "student", .kind = K::text, .help = "name on the certificate"},
        {.name = "language", .kind = K::text, .help = "language of texts", .default_value = "en"},
        {.name = "output",
         .kind = K::path,
         .help = "folder for the scans and the result (JSON, CSV, HTML)",
         .default_value = "rehearsal"}},
       runRehearse},
  };
  return verbs;
}

}  // namespace

std::span<const Verb> rehearsalVerbs() { return table(); }

std::span<const Verb> allVerbs() {
  static const std::vector<Verb> all = [] {
    std::vector<Verb> both(verbs().begin(), verbs().end());
    both.insert(both.end(), table().begin(), table().end());
    return both;
  }();
  return all;
}

}  // namespace standpoint
