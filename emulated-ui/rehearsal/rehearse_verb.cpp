// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/rehearse_verb.h"

#include <filesystem>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/exercise_words.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/names.h"
#include "project/fields.h"

namespace standpoint {

namespace {

struct RehearseOptions {
  std::string exercise;  // file or id; empty: they are listed
  std::filesystem::path actions;
  bool solution = false;
  std::vector<std::string> check;  // files
  bool names = false;
  bool words = false;
  std::string device;
  std::string student;
  std::string language = "en";
  std::filesystem::path output = "rehearsal";
};

struct ExerciseRow {
  std::string id, title;
  std::vector<std::string> devices;
  std::filesystem::path file;
};
const AnswerFields<ExerciseRow>& answerFields(const ExerciseRow*) {
  using A = ExerciseRow;
  static const AnswerFields<A> fields = {
      {"id", &A::id}, {"title", &A::title}, {"devices", &A::devices}, {"file", &A::file}};
  return fields;
}

struct ExerciseList {
  std::vector<ExerciseRow> exercises;
};
const AnswerFields<ExerciseList>& answerFields(const ExerciseList*) {
  static const AnswerFields<ExerciseList> fields = {{"exercises", &ExerciseList::exercises}};
  return fields;
}

struct CheckFinding {
  std::string severity, source, message;
};
const AnswerFields<CheckFinding>& answerFields(const CheckFinding*) {
  using A = CheckFinding;
  static const AnswerFields<A> fields = {{"severity", &A::severity}, {"source", &A::source}, {"message", &A::message}};
  return fields;
}

struct CheckedFile {
  std::string file, id;
  bool sound = false;
  std::vector<CheckFinding> findings;
};
const AnswerFields<CheckedFile>& answerFields(const CheckedFile*) {
  using A = CheckedFile;
  static const AnswerFields<A> fields = {
      {"file", &A::file}, {"id", &A::id}, {"sound", &A::sound}, {"findings", &A::findings}};
  return fields;
}

struct CheckedFiles {
  bool sound = false;  // all of them
  std::vector<CheckedFile> files;
};
const AnswerFields<CheckedFiles>& answerFields(const CheckedFiles*) {
  using A = CheckedFiles;
  static const AnswerFields<A> fields = {{"sound", &A::sound}, {"files", &A::files}};
  return fields;
}

using RehearseAnswer = std::variant<ExerciseList, CheckedFiles, NamedDevices, DeviceNames, Marks>;
using RehearseOutcome = Answered<RehearseAnswer>;

RehearseOutcome listExercises(const Document& document, const std::string& language) {
  const auto known = knownExercises();
  RehearseOutcome outcome{document};
  ExerciseList list;
  for (const auto& [exercise, file] : known.readable) {
    const auto title = exercise.title.in(language);
    list.exercises.push_back({exercise.id, title, exercise.devices, file});
    outcome.text += fmt::format("{:6} {}  ({})\n", exercise.id, title, fmt::join(exercise.devices, ", "));
  }
  for (const auto& error : known.refused) outcome.report.warn(error.source, error.message);
  outcome.description = fmt::format("{} exercises", known.readable.size());
  outcome.answer = std::move(list);
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
  auto sound = checkStart(*exercise, report, progress);
  if (sound) sound = checkSolution(*exercise, report, progress);
  if (!sound && sound.error().kind != ErrorKind::unusable) return failure(sound.error());
  if (!sound) report.lose(sound.error().source, sound.error().message);
  return report;
}

// All files are checked, whatever is wrong with one of them.
Result<RehearseOutcome> checkFiles(const Document& document, const std::vector<std::string>& files,
                                   Progress& progress) {
  RehearseOutcome outcome{document};
  CheckedFiles checked;
  std::size_t sound = 0;
  for (const auto& name : files) {
    const auto done = static_cast<double>(checked.files.size()), all = static_cast<double>(files.size());
    progress.stage("Checking " + name, done / all, (done + 1) / all);
    CheckedFile row{name, {}, false, {}};
    TRY_ASSIGN(const auto report, findingsOf(name, row.id, progress));
    row.sound = report.losses() == 0;
    sound += row.sound ? 1 : 0;
    outcome.text += fmt::format("{:8} {}\n", row.sound ? "sound" : "refused", name);
    for (const auto& issue : report.issues) {
      const char* severity = issue.severity == Severity::loss ? "error" : "warning";
      row.findings.push_back({severity, issue.source, issue.message});
      outcome.text += fmt::format("  {}: {}: {}\n", severity, issue.source, issue.message);
    }
    checked.files.push_back(std::move(row));
  }
  checked.sound = sound == files.size();
  if (!checked.sound)
    outcome.report.lose("--check", fmt::format("{} of {} files are invalid", files.size() - sound, files.size()));
  outcome.answer = std::move(checked);
  outcome.description = fmt::format("{} of {} exercises are valid", sound, files.size());
  return outcome;
}

// A file whose name is no device's is never read.
void reportUnreadFiles(Report& report) {
  std::set<std::string> names = {"common", "exercises"};
  for (const auto& device : emulatedDevices()) names.insert(device.id);
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(wordsFolder(), error)) {
    const auto& file = entry.path();
    if (file.parent_path() != wordsFolder() && !entry.is_directory() &&
        (file.extension() != ".json" || !names.contains(file.stem().string())))
      report.lose(nameWithFolder(file),
                  fmt::format("is not read: the name must be one of {}, with .json", fmt::join(names, ", ")));
  }
}

// What the languages lack: of the devices' words, and of the exercises that come with the program.
Result<RehearseOutcome> checkWords(const Document& document) {
  TRY_ASSIGN(const auto words, wordsOfAllDevices());
  TRY_ASSIGN(const auto of_exercises, ExerciseWords::read(wordsFolder()));
  auto report = words.check();
  report.append(of_exercises.check(shippedExercises().readable));
  reportUnreadFiles(report);
  RehearseOutcome outcome{document};
  CheckedFile row{wordsFolder().string(), "words", report.losses() == 0, {}};
  for (const auto& issue : report.issues) {
    const char* severity = issue.severity == Severity::loss ? "error" : "warning";
    row.findings.push_back({severity, issue.source, issue.message});
    outcome.text += fmt::format("{}: {}: {}\n", severity, issue.source, issue.message);
  }
  if (!row.sound) outcome.report.lose("--words", fmt::format("missing or wrong texts: {}", report.losses()));
  outcome.description = fmt::format("Languages: {}", fmt::join(words.languages(), ", "));
  outcome.answer = CheckedFiles{row.sound, {std::move(row)}};
  return outcome;
}

Result<RehearseOutcome> listNames(const Document& document, const std::string& device) {
  if (device.empty()) {
    TRY_ASSIGN(auto devices, namedDevices());
    auto text = textOf(devices);
    return RehearseOutcome{document, std::move(devices), {}, {}, std::move(text)};
  }
  TRY_ASSIGN(auto names, namesOf(device));
  auto text = textOf(names);
  return RehearseOutcome{document, std::move(names), {}, {}, std::move(text)};
}

Result<RehearseOutcome> runRehearse(const Document& document, const RehearseOptions& options, Progress& progress) {
  if (static_cast<int>(!options.exercise.empty()) + static_cast<int>(!options.check.empty()) +
          static_cast<int>(options.names) + static_cast<int>(options.words) >
      1)
    return failure(ErrorKind::usage, "--check, --names, --words and carrying out an exercise cannot be combined",
                   "--check");
  if (!options.check.empty()) return checkFiles(document, options.check, progress);
  if (options.names) return listNames(document, options.device);
  if (options.words) return checkWords(document);
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
  RehearseOutcome outcome{document};
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (auto done = rehearsal->act(actions[i], progress); !done) {
      if (done.error().kind == ErrorKind::cancelled) return failure(done.error());
      outcome.report.warn(fmt::format("action {}", i),
                          describe(done.error()));  // the device refused; the student goes on
    }
  auto marks = marksOf(*rehearsal, options.student, options.language);
  TRY(writeMarks(*rehearsal, marks, folder));
  outcome.text = marksText(marks);
  if (!marks.passed) outcome.report.lose(known.exercise.id, whyNotPassed(marks));
  outcome.description = fmt::format("Rehearsed {}: {}", known.exercise.id, marks.passed ? "passed" : "not passed");
  outcome.answer = std::move(marks);
  return outcome;
}

const Fields<RehearseOptions>& rehearseFields() {
  using O = RehearseOptions;
  static const Fields<O> fields = {
      {"exercise", &O::exercise, "file of the exercise, or its id such as E03", {.positional = true}},
      {"actions", &O::actions, "list of actions to carry out; an exported result replays"},
      {"solution", &O::solution, "carry out the exercise's own solution"},
      {"check", &O::check,
       "exercise files to check: what is wrong with them, and whether their solutions do what is expected of them "
       "(exit "
       "code 3: one is refused)"},
      {"names", &O::names, "list the devices, or with --device all names and choices for its exercises"},
      {"words", &O::words,
       "list the texts of devices and exercises that a language lacks (exit code 3: there are some)"},
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
