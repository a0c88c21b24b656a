// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/rehearse_verb.h"

#include <filesystem>

#include <fmt/format.h>

#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/names.h"
#include "project/fields.h"

namespace standpoint {

namespace {

using nlohmann::json;

struct RehearseOptions {
  std::string exercise;  // file or id; empty: they are listed
  std::filesystem::path actions;
  bool solution = false;
  std::vector<std::string> check;  // files
  bool names = false;
  std::string device;
  std::string student;
  std::string language = "en";
  std::filesystem::path output = "rehearsal";
};

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
Result<Outcome> checkFiles(const Document& document, const std::vector<std::string>& files, Progress& progress) {
  Outcome outcome{document, json::object(), {}, {}, {}};
  json rows = json::array();
  std::size_t sound = 0;
  for (const auto& name : files) {
    std::string id;
    progress.stage("Checking " + name, static_cast<double>(rows.size()) / static_cast<double>(files.size()),
                   static_cast<double>(rows.size() + 1) / static_cast<double>(files.size()));
    TRY_ASSIGN(const auto report, findingsOf(name, id, progress));
    json findings = json::array();
    for (const auto& issue : report.issues)
      findings.push_back({{"severity", issue.severity == Severity::loss ? "error" : "warning"},
                          {"source", issue.source},
                          {"message", issue.message}});
    sound += report.losses() == 0 ? 1 : 0;
    rows.push_back({{"file", name}, {"id", id}, {"sound", report.losses() == 0}, {"findings", std::move(findings)}});
    outcome.text += fmt::format("{:8} {}\n", report.losses() == 0 ? "sound" : "refused", name);
    for (const auto& issue : report.issues)
      outcome.text += fmt::format("  {}: {}: {}\n", issue.severity == Severity::loss ? "error" : "warning",
                                  issue.source, issue.message);
  }
  if (sound < rows.size())
    outcome.report.lose("--check", fmt::format("{} of {} files are invalid", rows.size() - sound, rows.size()));
  outcome.answer = {{"sound", sound == rows.size()}, {"files", std::move(rows)}};
  outcome.description = fmt::format("{} of {} exercises are valid", sound, files.size());
  return outcome;
}

Result<Outcome> listNames(const Document& document, const std::string& device) {
  Outcome outcome{document, json::object(), {}, {}, {}};
  if (device.empty()) {
    auto devices = deviceNames();
    if (!devices) return failure(devices.error());
    outcome.text = deviceNamesText(*devices);
    outcome.answer = {{"devices", *std::move(devices)}};
    return outcome;
  }
  TRY_ASSIGN(auto names, namesOf(device));
  outcome.text = namesText(names);
  outcome.answer = std::move(names);
  return outcome;
}

// Why it is not passed, in one line.
std::string whyNotPassed(const json& marks) {
  std::string why = fmt::format("not passed: score {:.0f} %, {:.0f} % required", marks["score"].get<double>() * 100,
                                marks["pass_mark"].get<double>() * 100);
  for (const auto& id : marks["must_broken"]) why += fmt::format("; required: '{}'", id.get<std::string>());
  return why + (marks["in_time"].get<bool>() ? "" : "; over the time limit");
}

Result<Outcome> runRehearse(const Document& document, const RehearseOptions& options, Progress& progress) {
  if (static_cast<int>(!options.exercise.empty()) + static_cast<int>(!options.check.empty()) +
          static_cast<int>(options.names) >
      1)
    return failure(ErrorKind::usage, "--check, --names and carrying out an exercise cannot be combined", "--check");
  if (!options.check.empty()) return checkFiles(document, options.check, progress);
  if (options.names) return listNames(document, options.device);
  if (options.exercise.empty()) return listExercises(document, options.language);
  TRY_ASSIGN(auto known, findExercise(options.exercise));
  std::vector<RehearsalAction> actions;
  if (options.solution == !options.actions.empty())
    return failure(ErrorKind::usage, "specify the actions: --actions FILE, or --solution for the sample solution",
                   "--actions");
  if (options.solution) {
    actions = known.exercise.solution;
  } else {
    TRY_ASSIGN(auto read, readActions(options.actions));
    actions = std::move(read);
  }
  const auto& folder = options.output;
  TRY_ASSIGN(auto rehearsal, Rehearsal::start(known.exercise, options.device, folder, {}, progress));
  Outcome outcome{document, json::object(), {}, {}, {}};
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (auto done = rehearsal->act(actions[i], progress); !done) {
      if (done.error().kind == ErrorKind::cancelled) return failure(done.error());
      outcome.report.warn(fmt::format("action {}", i),
                          describe(done.error()));  // the device refused; the student goes on
    }
  outcome.answer = marksOf(*rehearsal, options.student, options.language);
  TRY(writeMarks(*rehearsal, outcome.answer, folder));
  outcome.text = marksText(outcome.answer);
  if (!outcome.answer["passed"].get<bool>()) outcome.report.lose(known.exercise.id, whyNotPassed(outcome.answer));
  outcome.description = fmt::format("Rehearsed {}: {}", known.exercise.id,
                                    outcome.answer["passed"].get<bool>() ? "passed" : "not passed");
  return outcome;
}

const Fields<RehearseOptions>& rehearseFields() {
  using O = RehearseOptions;
  static const Fields<O> fields = {
      {"exercise", &O::exercise, "file of the exercise, or its id such as E03", {.positional = true}},
      {"actions", &O::actions, "list of actions to carry out; an exported result replays"},
      {"solution", &O::solution, "carry out the exercise's own solution"},
      {"check", &O::check,
       "exercise files to check and start; list all that is wrong with them and do nothing else (exit code 3: one is "
       "refused)"},
      {"names", &O::names, "list the devices, or with --device all names and choices for its exercises"},
      {"device", &O::device, "id of the device, for an exercise with several"},
      {"student", &O::student, "name on the certificate"},
      {"language", &O::language, "language of the texts"},
      {"output", &O::output, "folder for the scans and the result (JSON, CSV, HTML)"}};
  return fields;
}

const std::vector<Verb>& table() {
  static const std::vector<Verb> verbs = {
      verbOf("rehearse",
             "Carry out an exercise on an emulated instrument from a list of actions and mark it (exit code 3: not "
             "passed); list the exercises if none is given",
             VerbScope::files, rehearseFields(), runRehearse)};
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
