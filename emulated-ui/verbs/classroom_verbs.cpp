// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/verbs/classroom_verbs.h"

#include <algorithm>
#include <ctime>
#include <filesystem>

#include <fmt/format.h>

#include "core/json_file.h"
#include "core/output_place.h"
#include "core/part_file.h"
#include "emulated-ui/classroom/assignment.h"
#include "emulated-ui/classroom/class_list.h"
#include "emulated-ui/classroom/collect.h"
#include "emulated-ui/classroom/dates.h"
#include "emulated-ui/classroom/scorm.h"
#include "emulated-ui/classroom/variant_check.h"
#include "project/fields.h"

namespace standpoint {

namespace {

namespace fs = std::filesystem;

// --- assign ---

struct AssignOptions {
  std::string exercise;  // file or id
  fs::path class_list;
  std::string deadline;
  fs::path key;
  bool new_key = false;
  int variants = 6;
  fs::path output;
};

struct GivenVariant {
  std::string seed;
  std::map<std::string, nlohmann::json> figures;
  std::size_t students = 0;
  double solution_seconds = 0, neighbour_score = 0;
};
const AnswerFields<GivenVariant>& answerFields(const GivenVariant*) {
  using A = GivenVariant;
  static const AnswerFields<A> fields = {{"seed", &A::seed},
                                         {"figures", &A::figures},
                                         {"students", &A::students},
                                         {"solution_seconds", &A::solution_seconds},
                                         {"neighbour_score", &A::neighbour_score}};
  return fields;
}

struct AssignAnswer {
  std::string exercise, class_name, deadline, assignment_hash, key;
  std::size_t students = 0;
  std::vector<GivenVariant> variants;
  fs::path file;
};
const AnswerFields<AssignAnswer>& answerFields(const AssignAnswer*) {
  using A = AssignAnswer;
  static const AnswerFields<A> fields = {
      {"exercise", &A::exercise}, {"class", &A::class_name},
      {"students", &A::students}, {"deadline", &A::deadline, answers::nullWhereEmpty},
      {"variants", &A::variants}, {"assignment_hash", &A::assignment_hash},
      {"key", &A::key},           {"file", &A::file}};
  return fields;
}

Result<SigningKey> readKey(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error))
    return failure(ErrorKind::file_system,
                   "there is no such key; use the one of this class, or make it once with 'assign … --new-key'",
                   file.string());
  return SigningKey::read(file);
}

AssignAnswer assignAnswer(const Assignment& a, const std::vector<CheckedVariant>& checked, const fs::path& file) {
  AssignAnswer answer{a.id(), a.class_name, a.deadline, a.hash, fingerprint(a.seal.key), a.students.size(), {}, file};
  for (std::size_t i = 0; i < checked.size(); ++i) {
    GivenVariant row{seedText(checked[i].variant.seed), checked[i].variant.figures, 0, checked[i].seconds,
                     checked[i].neighbour_score};
    for (const auto& [hash, index] : a.students) row.students += index == i ? 1 : 0;
    answer.variants.push_back(std::move(row));
  }
  return answer;
}

std::string assignText(const AssignAnswer& a) {
  auto text = fmt::format("{} for {}: {} students, deadline {}, signed with key {}\n", a.exercise, a.class_name,
                          a.students, a.deadline.empty() ? "none" : localText(a.deadline), a.key);
  for (const auto& v : a.variants)
    text += fmt::format("  variant {}  {:3} students  {}\n", v.seed.substr(0, 6), v.students,
                        v.figures.empty() ? "no figures" : nlohmann::json(v.figures).dump());
  return text + fmt::format("Give this file to the whole class: {}\n", a.file.string());
}

Result<Answered<AssignAnswer>> runAssign(const Document& document, const AssignOptions& options, Progress& progress) {
  Answered<AssignAnswer> outcome{document};
  TRY(checkFolderOf(options.output, "--output"));
  std::string deadline;
  if (!options.deadline.empty()) {
    TRY_ASSIGN(deadline, utcFrom(options.deadline, "--deadline"));
    if (deadline < utcNow())
      outcome.report.warn("--deadline", fmt::format("{} has passed already", localText(deadline)));
  }
  TRY_ASSIGN(const auto list, readClassList(options.class_list, outcome.report));
  TRY_ASSIGN(const auto known, findExercise(options.exercise));
  if (const auto faults = checkExercise(known.exercise); !faults.empty()) return failure(faults.front());
  TRY_ASSIGN(const auto exercise, readJsonFile(known.file));
  TRY_ASSIGN(const auto key, options.new_key ? SigningKey::make(options.key) : readKey(options.key));
  TRY_ASSIGN(const auto checked,
             checkedVariants(exercise, known.exercise.file, static_cast<std::size_t>(options.variants), key,
                             outcome.report, progress));
  std::vector<Variant> variants;
  for (const auto& one : checked) variants.push_back(one.variant);
  const auto assignment = assign({exercise, list.name, list.students, deadline, std::move(variants)}, key);
  TRY(writeWholeText(options.output, fileText(assignment.seal)));
  outcome.answer = assignAnswer(assignment, checked, options.output);
  outcome.text = assignText(outcome.answer);
  outcome.description = fmt::format("Assigned {} to {} students", assignment.id(), list.students.size());
  return outcome;
}

const Fields<AssignOptions>& assignFields() {
  using O = AssignOptions;
  static const Fields<O> fields = {
      {"exercise", &O::exercise, "file of the exercise, or its id such as E05", {.positional = true, .required = true}},
      {"class",
       &O::class_list,
       "class list: CSV with the column id, and if you like name, username, email",
       {.required = true}},
      {"deadline", &O::deadline, "2026-12-01, 2026-12-01T18:00 in your time zone, or 2026-12-01T17:00Z; empty: none"},
      {"key", &O::key, "file of your key, which signs what you give out; keep it to yourself", {.required = true}},
      {"new-key", &O::new_key, "make the key file, once for a class"},
      {"variants",
       &O::variants,
       "how many variants to give out, where the exercise leaves figures open",
       {.minimum = 1, .maximum = 50}},
      {"output", &O::output, "file for the class", {.required = true}}};
  return fields;
}

// --- collect ---

struct CollectOptions {
  fs::path folder;
  fs::path assignment, class_list, key;
  std::string language = "en";
  bool names = false;
  std::string home_page = "https://moodle.example";
  fs::path output = "class";
};

struct CollectedRow {
  std::string student, seed, verdict, why, finished, file;
  std::optional<std::size_t> from_action;
  bool verified = false, late = false, counts = false;
  std::optional<double> score, seconds, hints;
  std::optional<bool> passed;
  std::vector<std::string> mistakes;
};
const AnswerFields<CollectedRow>& answerFields(const CollectedRow*) {
  using A = CollectedRow;
  static const AnswerFields<A> fields = {
      {"student", &A::student},   {"seed", &A::seed},         {"verified", &A::verified},
      {"verdict", &A::verdict},   {"why", &A::why},           {"from_action", &A::from_action},
      {"late", &A::late},         {"counts", &A::counts},     {"score", &A::score},
      {"passed", &A::passed},     {"seconds", &A::seconds},   {"hints", &A::hints},
      {"mistakes", &A::mistakes}, {"finished", &A::finished}, {"file", &A::file}};
  return fields;
}

struct CollectedCriterion {
  std::string id, kind;
  std::size_t met = 0, of = 0;
  double facility = 0;
  std::optional<double> correlation, discrimination;
};
const AnswerFields<CollectedCriterion>& answerFields(const CollectedCriterion*) {
  using A = CollectedCriterion;
  static const AnswerFields<A> fields = {{"id", &A::id},
                                         {"kind", &A::kind},
                                         {"met", &A::met},
                                         {"of", &A::of},
                                         {"facility", &A::facility},
                                         {"correlation", &A::correlation},
                                         {"discrimination", &A::discrimination}};
  return fields;
}

struct CollectAnswer {
  std::string exercise;
  std::size_t students = 0, verified = 0, refused = 0, missing = 0;
  std::vector<CollectedRow> results;
  std::map<std::string, std::size_t> mistakes;
  std::vector<CollectedCriterion> criteria;
  fs::path folder;
};
const AnswerFields<CollectAnswer>& answerFields(const CollectAnswer*) {
  using A = CollectAnswer;
  static const AnswerFields<A> fields = {
      {"exercise", &A::exercise}, {"students", &A::students}, {"verified", &A::verified},
      {"refused", &A::refused},   {"missing", &A::missing},   {"results", &A::results},
      {"mistakes", &A::mistakes}, {"criteria", &A::criteria}, {"folder", &A::folder}};
  return fields;
}

CollectedRow rowOf(const CollectedResult& r) {
  const auto& v = r.verification;
  CollectedRow row{.student = r.result.student,
                   .seed = r.result.seed,
                   .verdict = wordOf(v.verdict),
                   .why = v.why,
                   .finished = r.result.finished,
                   .file = r.file,
                   .from_action = v.from_action,
                   .verified = v.verified(),
                   .late = r.late,
                   .counts = r.counts};
  if (!v.verified()) return row;
  row.score = v.marks->score;
  row.passed = v.marks->passed;
  row.seconds = v.marks->seconds;
  row.hints = v.marks->hints;
  row.mistakes = mistakesOf(*v.marks);
  return row;
}

CollectAnswer collectAnswer(const CollectedClass& c, const fs::path& folder) {
  CollectAnswer answer;
  answer.exercise = c.assignment.id();
  answer.students = c.list.students.size();
  answer.folder = folder;
  for (const auto& r : c.results) {
    answer.results.push_back(rowOf(r));
    (r.verification.verified() ? answer.verified : answer.refused) += 1;
  }
  for (const auto& student : c.list.students)
    answer.missing +=
        std::none_of(c.results.begin(), c.results.end(), [&](const auto& r) { return r.result.student == student.id; })
            ? 1
            : 0;
  answer.mistakes.insert(c.mistakes.begin(), c.mistakes.end());
  for (const auto& s : c.statistics.criteria)
    answer.criteria.push_back(
        {s.id, s.rule ? "rule" : "step", s.met, s.of, s.facility, s.correlation, s.discrimination});
  return answer;
}

std::string collectText(const CollectedClass& c, const CollectAnswer& a) {
  std::string text;
  for (const auto& r : c.results) {
    const auto& v = r.verification;
    text += fmt::format("{:16} {:>6}  {}\n", r.result.student, v.verified() ? percentText(v.marks->score) : "–",
                        verifiedText(r));
  }
  for (const auto& [mistake, count] : c.mistakes) text += fmt::format("  {} × {}\n", count, mistake);
  return text + fmt::format("{} verified, {} refused, {} students without a result; open {}\n", a.verified, a.refused,
                            a.missing, (a.folder / "table.html").string());
}

Result<void> writeClass(const CollectedClass& c, const CollectOptions& options, const SigningKey& key) {
  std::error_code error;
  const auto marks = options.output / "marks";
  fs::create_directories(marks, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), marks.string());
  const std::pair<const char*, std::string> kFiles[] = {
      {"table.html", classHtml(c, options.language, localText(utcNow()), options.names)},
      {"table.csv", classCsv(c)},
      {"criteria.csv", criteriaCsv(c)},
      {"moodle.csv", moodleCsv(c)},
      {"xapi.json", xapiStatements(c, options.home_page)}};
  for (const auto& [name, text] : kFiles) TRY(writeWholeText(options.output / name, text));
  for (const auto& r : c.results)
    if (r.counts)
      TRY(writeWholeText(marks / fmt::format("{}-{}.mark.json", c.assignment.id(), r.result.student),
                         fileText(signedMark(r, c, key))));
  return {};
}

Result<Answered<CollectAnswer>> runCollect(const Document& document, const CollectOptions& options,
                                           Progress& progress) {
  Answered<CollectAnswer> outcome{document};
  TRY_ASSIGN(const auto key, readKey(options.key));
  TRY_ASSIGN(auto assignment, readAssignment(options.assignment));
  if (assignment.seal.key != key.publicKey())
    return failure(ErrorKind::unusable,
                   fmt::format("was signed with another key ({}) than {} ({})", fingerprint(assignment.seal.key),
                               options.key.filename().string(), fingerprint(key.publicKey())),
                   options.assignment.string());
  TRY_ASSIGN(auto list, readClassList(options.class_list, outcome.report));
  for (const auto& student : list.students)
    if (assignment.variantOf(student.id) == nullptr)
      outcome.report.warn(options.class_list.filename().string(),
                          fmt::format("'{}' was not in the list when the exercise was given out", student.id));
  TRY_ASSIGN(const auto collected, collectResults(options.folder, std::move(assignment), std::move(list),
                                                  options.language, outcome.report, progress));
  TRY(writeClass(collected, options, key));
  outcome.answer = collectAnswer(collected, options.output);
  outcome.text = collectText(collected, outcome.answer);
  outcome.description = fmt::format("Collected {} results of {}", collected.results.size(), outcome.answer.exercise);
  return outcome;
}

const Fields<CollectOptions>& collectFields() {
  using O = CollectOptions;
  static const Fields<O> fields = {
      {"folder",
       &O::folder,
       "folder with the results; folders in it are read, too, other files are left alone",
       {.positional = true, .required = true}},
      {"assignment", &O::assignment, "the file that you gave to the class", {.required = true}},
      {"class",
       &O::class_list,
       "class list: CSV with the column id, and if you like name, username, email",
       {.required = true}},
      {"key", &O::key, "file of the key that signed the assignment; it signs the marks", {.required = true}},
      {"language", &O::language, "language of the table"},
      {"names", &O::names, "put the students' names into the table, not only their ids"},
      {"home-page", &O::home_page, "address of the system that knows the user names, for xAPI"},
      {"output", &O::output, "folder for table.html, table.csv, criteria.csv, moodle.csv, xapi.json and signed marks"}};
  return fields;
}

// --- scorm ---

struct ScormOptions {
  fs::path assignment, class_list;
  bool graded = false;
  fs::path output;
};

struct ScormAnswer {
  std::string exercise;
  bool graded = false;
  fs::path file;
};
const AnswerFields<ScormAnswer>& answerFields(const ScormAnswer*) {
  using A = ScormAnswer;
  static const AnswerFields<A> fields = {{"exercise", &A::exercise}, {"graded", &A::graded}, {"file", &A::file}};
  return fields;
}

Result<Answered<ScormAnswer>> runScorm(const Document& document, const ScormOptions& options, Progress&) {
  Answered<ScormAnswer> outcome{document};
  TRY(checkFolderOf(options.output, "--output"));
  TRY_ASSIGN(const auto assignment, readAssignment(options.assignment));
  TRY_ASSIGN(const auto list, readClassList(options.class_list, outcome.report));
  TRY_ASSIGN(const auto package, scormPackage(assignment, list, options.graded));
  TRY(writeWholeText(options.output, package));
  outcome.answer = {assignment.id(), options.graded, options.output};
  outcome.description = fmt::format("Packed {} for SCORM 1.2", assignment.id());
  outcome.text = options.graded ? "Students hand in the marks that 'collect' signs.\n"
                                : "Students hand in their results. Their marks are reported, not proved: use --graded, "
                                  "or 'collect', for marks that count.\n";
  return outcome;
}

const Fields<ScormOptions>& scormFields() {
  using O = ScormOptions;
  static const Fields<O> fields = {
      {"assignment", &O::assignment, "the file that you gave to the class", {.positional = true, .required = true}},
      {"class",
       &O::class_list,
       "class list; its user names are those of the learning management system",
       {.required = true}},
      {"graded", &O::graded, "accept only marks that 'collect' has verified and signed, not the students' own results"},
      {"output", &O::output, "package to upload (.zip)", {.required = true}}};
  return fields;
}

}  // namespace

std::span<const Verb> classroomVerbs() {
  static const std::vector<Verb> verbs = {
      verbOf("assign",
             "Give an exercise to a class: one signed file without the solution, with a deadline and a checked variant "
             "for each student",
             VerbScope::files, assignFields(), runAssign),
      verbOf("collect",
             "Collect a folder of results: carry each out again, and write tables, Moodle grades, xAPI statements and "
             "signed marks (exit code 3: some could not be verified)",
             VerbScope::files, collectFields(), runCollect),
      verbOf("scorm", "Write a SCORM 1.2 package in which students hand in their results", VerbScope::files,
             scormFields(), runScorm)};
  return verbs;
}

}  // namespace standpoint
