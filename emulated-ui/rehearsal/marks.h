// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "emulated-ui/rehearsal/proof_places.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "project/answer_fields.h"

namespace standpoint {

struct MarkedStep {
  std::string id, text, expected;
  std::string expected_text;  // the condition as people read it
  bool done = false;
  std::optional<double> at_s;  // when it was done
  bool hinted = false;
  double points = 0, of = 0;
};
const AnswerFields<MarkedStep>& answerFields(const MarkedStep*);
struct MarkedProof {  // what a mistake does to the data, from the points
  using Value = std::variant<double, std::string>;
  std::string fact;
  Value value;
  std::string unit, text;  // `text` is for people: rounded, with its unit
  std::string name;        // what people call the fact
};
const AnswerFields<MarkedProof>& answerFields(const MarkedProof*);
struct MarkedPlace {  // where the points prove a broken rule; file frame
  std::string text;   // "West wall, 4.2 m from S1"
  double x_m = 0, y_m = 0, z_m = 0, radius_m = 0;
  std::string station;
};
const AnswerFields<MarkedPlace>& answerFields(const MarkedPlace*);
struct MarkedRule {
  std::string id, text, expected;
  std::string expected_text;      // the condition as people read it
  std::string found, found_text;  // the latter for people
  bool asked = false, held = false, must = false;
  double points = 0, of = 0;
  std::optional<std::optional<double>> broken_at_s;  // of one that did not hold; nothing where that has no time
  std::optional<std::string> mistake, because;       // likewise; what it does to the data
  std::optional<std::string> cost;                   // likewise; in the field and in the office
  std::optional<MarkedProof> proof;                  // of one that was asked
  std::optional<MarkedPlace> place;                  // of a broken one that a place proves
  std::optional<ProofPlace> shown;                   // the same for who looks at it; not written
};
const AnswerFields<MarkedRule>& answerFields(const MarkedRule*);
struct MarkedAnswer {  // to a question
  std::string id, question, value, answer;
};
const AnswerFields<MarkedAnswer>& answerFields(const MarkedAnswer*);
const AnswerFields<Rehearsal::Failure>& answerFields(const Rehearsal::Failure*);
struct MarkedFile {
  std::string file, station;
  std::uint64_t points = 0;
};
const AnswerFields<MarkedFile>& answerFields(const MarkedFile*);
template <>
struct AnswerValue<RehearsalAction> {
  static nlohmann::json write(const RehearsalAction& action) { return toJson(action); }
  static std::vector<std::string> names() { return {}; }
};

// What a rehearsal is worth: for each step and rule what was expected, what was done, and what a mistake does to the
// data, with the figure from the points that proves it; of a rule that nothing asked, that and no consequence. A rule
// keeps the values that it was judged by.
struct Marks {
  std::string exercise, exercise_hash, title, goal, language;
  std::string device, instrument, maker, model;
  std::string student, operator_name;  // may be empty
  bool passed = false;
  std::vector<std::string> must_broken;  // ids of the rules that had to hold and did not
  double score = 0;                      // 0..1, of the points
  double points = 0, of = 0;
  double pass_mark = 0;  // of the score
  double seconds = 0, time_limit_s = 0;
  bool in_time = true;
  std::vector<MarkedStep> steps;
  std::vector<MarkedRule> rules;
  std::vector<MarkedAnswer> answers;
  double hints = 0;
  std::vector<Rehearsal::Failure> failures;  // what the device could not do, and why
  std::vector<RehearsalAction> actions;
  std::vector<MarkedFile> files;
};
const AnswerFields<Marks>& answerFields(const Marks*);
// Places of broken rules are looked for in the points, which takes seconds; the rehearsal must rest meanwhile. Error:
// it was cancelled.
Result<Marks> marksOf(const Rehearsal& rehearsal, const std::string& student, const std::string& language,
                      Progress& progress);

std::string marksText(const Marks& marks);     // for people, a line each
std::string whyNotPassed(const Marks& marks);  // in one line
// RFC 4180, a row for each step, rule, answer and failure, then the total. No text in it becomes a formula.
std::string marksCsv(const Marks& marks);
// A page to print, with the setups' pictures in it, in the marks' language; it needs no other file. `date`: of the
// marking.
std::string marksHtml(const Marks& marks, const Rehearsal& rehearsal, const std::string& date);
// What people read of the marks: the rules that had to hold and did not, and a share of 0 to 1 as "87.3 %".
std::string brokenDemands(const Marks& marks);
std::string percentText(double fraction);

// Writes result.json, result.csv and result.html, the latter with the date of today.
Result<void> writeMarks(const Rehearsal& rehearsal, const Marks& marks, const std::filesystem::path& folder);

}  // namespace standpoint
