// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/verbs/rehearse_verb.h"

#include <filesystem>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/classroom/dates.h"
#include "emulated-ui/classroom/signed_result.h"
#include "emulated-ui/classroom/verify.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/exercise_words.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/names.h"
#include "emulated-ui/verbs/classroom_verbs.h"
#include "project/fields.h"

namespace standpoint {

namespace {

struct RehearseOptions {
  std::string exercise;  // file or id; empty: they are listed
  std::filesystem::path actions;
  bool solution = false;
  std::vector<std::string> check;  // files
  std::filesystem::path verify;    // a signed result
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

struct VerifiedResult {
  bool verified = false;
  std::string verdict, why, exercise, student, seed, finished, signed_by, assigned_by;
  std::optional<std::size_t> from_action;
  double claimed_score = 0;
  std::optional<double> score;
  std::optional<bool> passed;
};
const AnswerFields<VerifiedResult>& answerFields(const VerifiedResult*) {
  using A = VerifiedResult;
  static const AnswerFields<A> fields = {{"verified", &A::verified},
                                         {"verdict", &A::verdict},
                                         {"why", &A::why},
                                         {"from_action", &A::from_action},
                                         {"exercise", &A::exercise},
                                         {"student", &A::student},
                                         {"seed", &A::seed},
                                         {"finished", &A::finished},
                                         {"claimed_score", &A::claimed_score},
                                         {"score", &A::score},
                                         {"passed", &A::passed},
                                         {"signed_by", &A::signed_by},
                                         {"assigned_by", &A::assigned_by}};
  return fields;
}

using RehearseAnswer = std::variant<ExerciseList, CheckedFiles, VerifiedResult, NamedDevices, DeviceNames, Marks>;
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
  const auto& of_exercises = ExerciseWords::shipped();
  if (!of_exercises) return failure(of_exercises.error());
  auto report = words.check();
  report.append(of_exercises->check(shippedExercises().readable));
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

Result<RehearseOutcome> verifyFile(const Document& document, const RehearseOptions& options, Progress& progress) {
  TRY_ASSIGN(const auto result, readResult(options.verify));
  TRY_ASSIGN(const auto found, verifyAlone(result, options.language, progress));
  RehearseOutcome outcome{document};
  VerifiedResult answer;
  answer.verified = found.verified();
  answer.verdict = wordOf(found.verdict);
  answer.why = found.why;
  answer.from_action = found.from_action;
  answer.exercise = result.exercise;
  answer.student = result.student;
  answer.seed = result.seed;
  answer.finished = result.finished;
  answer.claimed_score = result.score;
  answer.signed_by = fingerprint(result.seal.key);
  if (const auto given = parseSeal(result.assignment, "assignment", kAssignmentKind))
    answer.assigned_by = fingerprint(given->key);
  const auto who = fmt::format("{} of {}", result.exercise, result.student);
  if (found.marks) {
    answer.score = found.marks->score;
    answer.passed = found.marks->passed;
  }
  if (found.verified())
    outcome.text =
        fmt::format("{}: verified, score {}, {}; assignment signed with key {}\n", who, percentText(found.marks->score),
                    found.marks->passed ? "passed" : "not passed", answer.assigned_by);
  else
    outcome.report.lose(options.verify.filename().string(), found.why);
  outcome.description = fmt::format("Verified {}: {}", who, answer.verdict);
  outcome.answer = std::move(answer);
  return outcome;
}

// What is to be carried out: an exercise, or a student's variant of one that was assigned.
struct Chosen {
  Exercise exercise;
  std::optional<Assignment> assignment;
};

Result<Chosen> chosenExercise(const RehearseOptions& options, Report& report) {
  if (!isAssignment(options.exercise)) {
    TRY_ASSIGN(auto known, findExercise(options.exercise));
    return Chosen{std::move(known.exercise), {}};
  }
  TRY_ASSIGN(auto assignment, readAssignment(options.exercise));
  if (options.student.empty())
    return failure(ErrorKind::usage, "specify who you are: --student ID, as it is in your class list", "--student");
  const auto* variant = assignment.variantOf(options.student);
  if (variant == nullptr)
    return failure(ErrorKind::usage,
                   fmt::format("class {} has no student '{}': use your id as it is in the class list",
                               assignment.class_name, options.student),
                   "--student");
  if (!assignment.deadline.empty() && utcNow() > assignment.deadline)
    report.warn(options.exercise, fmt::format("the deadline has passed: {}", localText(assignment.deadline)));
  TRY_ASSIGN(auto exercise, assignment.exerciseWith(*variant));
  return Chosen{std::move(exercise), std::move(assignment)};
}

// A plain list fits anything; a result says what it is of.
Result<void> checkBelongs(const std::filesystem::path& actions, const Exercise& exercise, Report& report) {
  TRY_ASSIGN(const auto written, readJsonFile(actions));
  const auto place = actions.filename().string();
  const auto text = [&](const char* key) {
    const auto found = written.is_object() ? written.find(key) : written.end();
    return written.is_object() && found != written.end() && found->is_string() ? found->get<std::string>()
                                                                               : std::string();
  };
  if (const auto id = text("exercise"); !id.empty() && id != exercise.id)
    return failure(ErrorKind::unusable, fmt::format("is a result of {}, not of {}", id, exercise.id),
                   place + " /exercise");
  if (const auto hash = text("exercise_hash"); !hash.empty() && hash != exercise.hash)
    report.warn(place + " /exercise_hash", fmt::format("is a result of another version of {}", exercise.id));
  return {};
}

Result<RehearseOutcome> runRehearse(const Document& document, const RehearseOptions& options, Progress& progress) {
  if (static_cast<int>(!options.exercise.empty()) + static_cast<int>(!options.check.empty()) +
          static_cast<int>(options.names) + static_cast<int>(options.words) +
          static_cast<int>(!options.verify.empty()) >
      1)
    return failure(ErrorKind::usage,
                   "--check, --verify, --names, --words and carrying out an exercise cannot be combined", "--check");
  if (!options.verify.empty()) return verifyFile(document, options, progress);
  if (!options.check.empty()) return checkFiles(document, options.check, progress);
  if (options.names) return listNames(document, options.device);
  if (options.words) return checkWords(document);
  if (options.exercise.empty()) return listExercises(document, options.language);
  RehearseOutcome outcome{document};
  TRY_ASSIGN(const auto chosen, chosenExercise(options, outcome.report));
  const auto& exercise = chosen.exercise;
  std::vector<RehearsalAction> actions;
  if (options.solution == !options.actions.empty())
    return failure(ErrorKind::usage, "specify the actions: --actions FILE, or --solution for the sample solution",
                   "--actions");
  if (options.solution) {
    if (chosen.assignment)
      return failure(ErrorKind::usage, "an assigned exercise has no solution; specify --actions FILE", "--solution");
    actions = exercise.solution;
  } else {
    TRY(checkBelongs(options.actions, exercise, outcome.report));
    TRY_ASSIGN(auto read, readActions(options.actions));
    actions = std::move(read);
  }
  const auto& folder = options.output;
  const auto started = utcNow();
  TRY_ASSIGN(auto rehearsal, Rehearsal::start(exercise, options.device, folder, {}, progress));
  for (std::size_t i = 0; i < actions.size(); ++i)
    if (auto done = rehearsal->act(actions[i], progress); !done) {
      if (done.error().kind == ErrorKind::cancelled) return failure(done.error());
      outcome.report.warn(fmt::format("action {}", i),
                          describe(done.error()));  // the device refused; the student goes on
    }
  // The student chose the format: no loss of this verb's own.
  for (const auto& lost : rehearsal->host().takeReport().issues) outcome.report.note(lost.source, lost.message);
  TRY_ASSIGN(auto marks, marksOf(*rehearsal, options.student, options.language, progress));
  TRY(writeMarks(*rehearsal, marks, folder));
  outcome.text = marksText(marks);
  if (chosen.assignment) {
    TRY_ASSIGN(const auto file, writeResult(*rehearsal, marks, *chosen.assignment, started, folder));
    outcome.text += fmt::format("Hand in this file: {}\n", file.string());
  }
  if (!marks.passed) outcome.report.lose(exercise.id, whyNotPassed(marks));
  outcome.description = fmt::format("Rehearsed {}: {}", exercise.id, marks.passed ? "passed" : "not passed");
  outcome.answer = std::move(marks);
  return outcome;
}

const Fields<RehearseOptions>& rehearseFields() {
  using O = RehearseOptions;
  static const Fields<O> fields = {
      {"exercise",
       &O::exercise,
       "file of the exercise or of an assigned one, or an id such as E03",
       {.positional = true}},
      {"actions", &O::actions, "list of actions to carry out; an exported result replays"},
      {"solution", &O::solution, "carry out the exercise's own solution"},
      {"check", &O::check,
       "exercise files to check: what is wrong with them, and whether their solutions do what is expected of them "
       "(exit "
       "code 3: one is refused)"},
      {"verify", &O::verify,
       "a signed result to carry out again: is the mark what its actions give? (exit code 3: it is not)"},
      {"names", &O::names, "list the devices, or with --device all names and choices for its exercises"},
      {"words", &O::words,
       "list the texts of devices and exercises that a language lacks (exit code 3: there are some)"},
      {"device", &O::device, "id of the device, for an exercise with several"},
      {"student", &O::student, "name on the certificate; of an assigned exercise the id in the class list"},
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
    both.insert(both.end(), classroomVerbs().begin(), classroomVerbs().end());
    return both;
  }();
  return all;
}

}  // namespace standpoint
