// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/marks.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/csv_text.h"
#include "core/part_file.h"
#include "emulated-ui/device/format.h"
#include "emulated-ui/rehearsal/plain_words.h"

namespace standpoint {

namespace {

// A hint costs half of its step.
constexpr double kHinted = 0.5;

std::string cellText(const char* text) { return csvText(text); }
std::string cellText(const std::string& text) { return csvText(text); }
std::string cellText(bool value) { return value ? "1" : "0"; }
std::string cellText(double value) { return fmt::format("{}", value); }
std::string cellText(const MarkedProof::Value& value) {
  return std::visit([](const auto& one) { return cellText(one); }, value);
}
template <class T>
std::string cellText(const std::optional<T>& value) {
  return value ? cellText(*value) : std::string();
}

// Three significant figures, none of a whole number lost.
std::string roundedText(double n) {
  return n == std::round(n) || std::abs(n) >= 100 ? fmt::format("{:.0f}", n) : fmt::format("{:.3g}", n);
}

}  // namespace

std::string percentText(double fraction) { return roundedText(fraction * 100) + " %"; }

namespace {

// The choice in words, a number with its unit; nothing where the question is not answered.
std::string answerText(const ExerciseQuestion& question, const std::string& value, const std::string& language) {
  for (std::size_t i = 0; i < question.choices.size(); ++i)
    if (question.choices[i] == value && !question.choice_texts[i].texts.empty())
      return question.choice_texts[i].in(language);
  return question.number && !value.empty() ? withUnit(value, question.number->unit) : value;
}

FactLookup factsIn(const std::map<std::string, Fact>& facts) {
  return [&facts](const std::string& name) {
    const auto found = facts.find(name);
    return found == facts.end() ? std::nullopt : std::optional(found->second);
  };
}

// "Tilt: 0.12°; Noise: –": what the facts of the condition were.
std::string shownFacts(const PlainWords& words, const Condition& condition, const std::map<std::string, Fact>& facts) {
  std::string shown;
  for (const auto& name : condition.facts())
    shown += (shown.empty() ? "" : "; ") + words.name(name) + ": " +
             words.value(name, factsIn(facts)(name), limitsOf(condition, name));
  return shown;
}

std::string today() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm local{};
  localtime_r(&now, &local);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", &local);
  return text;
}

// A demand that nothing asked is not met, but it says nothing of the data either.
std::string neverAsked(const Rehearsal& rehearsal, const ExerciseRule& rule, const std::string& language) {
  const auto& type = rehearsal.device().type();
  const auto& words = *type.words;
  const auto never = "never." + rule.event;
  const bool known = words.has(type.definition.id, never, "en");  // else only another device logs it
  return words.text({}, "never_asked", language) + ": " +
         words.text(type.definition.id, known ? never : "never.event", language);
}

std::vector<MarkedAnswer> answersOf(const Rehearsal& rehearsal, const std::string& language) {
  std::vector<MarkedAnswer> answers;
  for (const auto& question : rehearsal.exercise().questions) {
    const auto value = rehearsal.fact("answer." + question.id)->text;
    answers.push_back({question.id, question.text.in(language), value, answerText(question, value, language)});
  }
  return answers;
}

MarkedStep markedStep(const ExerciseStep& step, const Rehearsal::StepState& state, const PlainWords& words) {
  return {.id = step.id,
          .text = step.text.in(words.language),
          .expected = step.done.text(),
          .expected_text = words.condition(step.done),
          .done = state.done,
          .at_s = state.done ? std::optional(state.at_s) : std::nullopt,
          .hinted = state.hinted,
          .points = state.done ? step.points * (state.hinted ? kHinted : 1) : 0,
          .of = step.points};
}

void addPlace(MarkedRule& row, const Rehearsal& rehearsal, const PlainWords& words) {
  if (!row.shown) return;
  const Eigen::Vector3d at = row.shown->centre_m + rehearsal.document().georeference->shift_m;
  row.place = {placeText(*row.shown, rehearsal, words.language),
               at.x(),
               at.y(),
               at.z(),
               row.shown->radius_m,
               row.shown->station};
}

MarkedRule markedRule(const Rehearsal& rehearsal, const ExerciseRule& rule, const Rehearsal::RuleState& state,
                      const PlainWords& words, ProofPlaces& places) {
  const auto& language = words.language;
  MarkedRule row{.id = rule.id,
                 .text = rule.text.in(language),
                 .expected = rule.holds.text(),
                 .expected_text = words.condition(rule.holds),
                 .found = state.asked ? state.found : neverAsked(rehearsal, rule, language),
                 .asked = state.asked,
                 .held = state.held,
                 .must = rule.must,
                 .points = state.held ? rule.points : 0,
                 .of = rule.points};
  row.found_text = state.asked ? shownFacts(words, rule.holds, state.facts) : row.found;
  if (!state.held) {
    row.broken_at_s = state.broken_at_s >= 0 ? std::optional(state.broken_at_s) : std::nullopt;
    if (!rule.mistake.empty()) row.mistake = rule.mistake;
    if (state.asked && !rule.because.texts.empty())
      row.because = filledFigures(rule.because.in(language), words, factsIn(state.facts));
    if (state.asked && !rule.cost.texts.empty())
      row.cost = filledFigures(rule.cost.in(language), words, factsIn(state.facts));
    if (state.asked) row.shown = places.of(rule, state);
    addPlace(row, rehearsal, words);
  }
  if (state.asked && !rule.proof.empty())
    if (const auto proof = factsIn(state.facts)(rule.proof))
      row.proof = {rule.proof, proof->number ? MarkedProof::Value(*proof->number) : MarkedProof::Value(proof->text),
                   unitOf(rehearsal.device(), rule.proof),
                   words.value(rule.proof, proof, limitsOf(rule.holds, rule.proof)), words.name(rule.proof)};
  return row;
}

}  // namespace

const AnswerFields<MarkedStep>& answerFields(const MarkedStep*) {
  using A = MarkedStep;
  static const AnswerFields<A> fields = {
      {"id", &A::id},     {"text", &A::text}, {"expected", &A::expected}, {"expected_text", &A::expected_text},
      {"done", &A::done}, {"at_s", &A::at_s}, {"hinted", &A::hinted},     {"points", &A::points},
      {"of", &A::of}};
  return fields;
}

const AnswerFields<MarkedProof>& answerFields(const MarkedProof*) {
  using A = MarkedProof;
  static const AnswerFields<A> fields = {
      {"fact", &A::fact}, {"value", &A::value}, {"unit", &A::unit}, {"text", &A::text}, {"name", &A::name}};
  return fields;
}

const AnswerFields<MarkedPlace>& answerFields(const MarkedPlace*) {
  using A = MarkedPlace;
  static const AnswerFields<A> fields = {{"text", &A::text}, {"x_m", &A::x_m},           {"y_m", &A::y_m},
                                         {"z_m", &A::z_m},   {"radius_m", &A::radius_m}, {"station", &A::station}};
  return fields;
}

const AnswerFields<MarkedRule>& answerFields(const MarkedRule*) {
  using A = MarkedRule;
  static const AnswerFields<A> fields = {{"id", &A::id},
                                         {"text", &A::text},
                                         {"expected", &A::expected},
                                         {"expected_text", &A::expected_text},
                                         {"found", &A::found},
                                         {"found_text", &A::found_text},
                                         {"asked", &A::asked},
                                         {"held", &A::held},
                                         {"must", &A::must},
                                         {"points", &A::points},
                                         {"of", &A::of},
                                         {"at_s", &A::broken_at_s, kLeftOut},
                                         {"mistake", &A::mistake, kLeftOut},
                                         {"because", &A::because, kLeftOut},
                                         {"cost", &A::cost, kLeftOut},
                                         {"proof", &A::proof, kLeftOut},
                                         {"place", &A::place, kLeftOut}};
  return fields;
}

const AnswerFields<MarkedAnswer>& answerFields(const MarkedAnswer*) {
  using A = MarkedAnswer;
  static const AnswerFields<A> fields = {
      {"id", &A::id}, {"question", &A::question}, {"value", &A::value}, {"answer", &A::answer}};
  return fields;
}

const AnswerFields<Rehearsal::Failure>& answerFields(const Rehearsal::Failure*) {
  using A = Rehearsal::Failure;
  static const AnswerFields<A> fields = {{"at_s", &A::at_s}, {"reason", &A::reason}};
  return fields;
}

const AnswerFields<MarkedFile>& answerFields(const MarkedFile*) {
  using A = MarkedFile;
  static const AnswerFields<A> fields = {{"file", &A::file}, {"station", &A::station}, {"points", &A::points}};
  return fields;
}

const AnswerFields<Marks>& answerFields(const Marks*) {
  using A = Marks;
  static const AnswerFields<A> fields = {{"exercise", &A::exercise},
                                         {"exercise_hash", &A::exercise_hash},
                                         {"title", &A::title},
                                         {"goal", &A::goal},
                                         {"language", &A::language},
                                         {"device", &A::device},
                                         {"instrument", &A::instrument},
                                         {"maker", &A::maker},
                                         {"model", &A::model},
                                         {"student", &A::student},
                                         {"operator", &A::operator_name},
                                         {"passed", &A::passed},
                                         {"must_broken", &A::must_broken},
                                         {"score", &A::score},
                                         {"points", &A::points},
                                         {"of", &A::of},
                                         {"pass_mark", &A::pass_mark},
                                         {"seconds", &A::seconds},
                                         {"time_limit_s", &A::time_limit_s},
                                         {"in_time", &A::in_time},
                                         {"steps", &A::steps},
                                         {"rules", &A::rules},
                                         {"answers", &A::answers},
                                         {"hints", &A::hints},
                                         {"failures", &A::failures},
                                         {"actions", &A::actions},
                                         {"files", &A::files}};
  return fields;
}

Result<Marks> marksOf(const Rehearsal& rehearsal, const std::string& student, const std::string& language,
                      Progress& progress) {
  const auto& e = rehearsal.exercise();
  const auto& device = rehearsal.device();
  const auto& instrument = device.type().instrument;
  Marks marks{.exercise = e.id,
              .exercise_hash = e.hash,
              .title = e.title.in(language),
              .goal = e.goal.in(language),
              .language = language,
              .device = device.type().definition.title,
              .instrument = instrument.id,
              .maker = instrument.maker,
              .model = instrument.model,
              .student = student,
              .operator_name = device.value("operator"),
              .pass_mark = e.pass_mark,
              .seconds = rehearsal.seconds(),
              .time_limit_s = e.time_limit_s,
              .in_time = !rehearsal.overTime()};
  const PlainWords words{device, e, language};
  for (std::size_t i = 0; i < e.steps.size(); ++i) {
    marks.steps.push_back(markedStep(e.steps[i], rehearsal.steps()[i], words));
    marks.points += marks.steps.back().points;
    marks.of += e.steps[i].points;
  }
  const auto judged = rehearsal.judge();
  ProofPlaces places(rehearsal);
  progress.stage("Marking");
  for (std::size_t i = 0; i < e.rules.size(); ++i) {
    TRY(progress.check());
    progress.advance(static_cast<double>(i) / static_cast<double>(e.rules.size()));
    const auto& rule = marks.rules.emplace_back(markedRule(rehearsal, e.rules[i], judged[i], words, places));
    marks.points += rule.points;
    marks.of += rule.of;
    if (rule.must && !rule.held) marks.must_broken.push_back(rule.id);
  }
  marks.score = marks.of > 0 ? marks.points / marks.of : 1;
  marks.passed = marks.must_broken.empty() && marks.in_time && marks.score >= e.pass_mark;
  marks.answers = answersOf(rehearsal, language);
  marks.hints = rehearsal.fact("hints")->number.value_or(0);
  marks.failures = rehearsal.failures();
  marks.actions = rehearsal.actions();
  for (const auto& project : device.state().projects)
    for (const auto& setup : project.setups) marks.files.push_back({setup.file, setup.station, setup.points});
  return marks;
}

std::string brokenDemands(const Marks& m) {
  std::string texts;
  for (const auto& rule : m.rules)
    if (rule.must && !rule.held) texts += (texts.empty() ? "" : "; ") + rule.text;
  return texts;
}

std::string marksText(const Marks& m) {
  std::string text = fmt::format("{} {} with {}: {}, score {} ({} required), {} device time\n", m.exercise, m.title,
                                 m.device, m.passed ? "passed" : "not passed", percentText(m.score),
                                 percentText(m.pass_mark), clockText(m.seconds));
  if (!m.must_broken.empty()) text += fmt::format("  required criterion not met: {}\n", brokenDemands(m));
  if (!m.in_time) text += fmt::format("  over the time limit of {}\n", clockText(m.time_limit_s));
  for (const auto& s : m.steps)
    text += fmt::format("  {} {}{}\n", s.done ? "[x]" : "[ ]", s.text, s.hinted ? " (with a hint)" : "");
  for (const auto& r : m.rules) {
    text += fmt::format("  {} {}{}: {}\n", r.held ? "[x]" : "[ ]", r.text, r.must ? " (required to pass)" : "",
                        r.found_text);
    for (const auto& said : {r.because, r.cost})
      if (said) text += fmt::format("        {}\n", *said);
    if (!r.held && r.proof) text += fmt::format("        measured in the data: {}: {}\n", r.proof->name, r.proof->text);
    if (r.place) text += fmt::format("        shown at: {}\n", r.place->text);
  }
  for (const auto& a : m.answers)
    text += fmt::format("  {} {}\n", a.question, a.value.empty() ? "not answered" : a.answer);
  for (const auto& f : m.failures) text += fmt::format("  failed after {}: {}\n", clockText(f.at_s), f.reason);
  return text;
}

std::string whyNotPassed(const Marks& m) {
  std::string why = fmt::format("not passed: score {:.0f} %, {:.0f} % required", m.score * 100, m.pass_mark * 100);
  for (const auto& id : m.must_broken) why += fmt::format("; required: '{}'", id);
  return why + (m.in_time ? "" : "; over the time limit");
}

namespace {

constexpr const char* kColumns[] = {
    "exercise", "student", "device",  "kind",  "id",    "text", "expected", "found",   "held",   "points", "of",
    "must",     "mistake", "because", "proof", "value", "unit", "hints",    "seconds", "passed", "cost",   "place"};

// Of a row of the table, by column; what is not there stays empty.
using Cells = std::map<std::string_view, std::string>;

Cells stepCells(const MarkedStep& s) {
  return {{"kind", cellText("step")},
          {"id", cellText(s.id)},
          {"text", cellText(s.text)},
          {"expected", cellText(s.expected)},
          {"found", cellText(s.done ? "done" : "not done")},
          {"held", cellText(s.done)},
          {"points", cellText(s.points)},
          {"of", cellText(s.of)},
          {"hints", cellText(s.hinted)},
          {"seconds", cellText(s.at_s)}};
}

Cells ruleCells(const MarkedRule& r) {
  Cells cells = {{"kind", cellText("rule")},         {"id", cellText(r.id)},
                 {"text", cellText(r.text)},         {"held", cellText(r.held)},
                 {"expected", cellText(r.expected)}, {"found", cellText(r.found)},
                 {"points", cellText(r.points)},     {"of", cellText(r.of)},
                 {"must", cellText(r.must)},         {"mistake", cellText(r.mistake)},
                 {"because", cellText(r.because)},   {"seconds", cellText(r.broken_at_s)}};
  cells["cost"] = cellText(r.cost);
  if (r.place) cells["place"] = cellText(r.place->text);
  if (r.proof) {
    cells["proof"] = cellText(r.proof->fact);
    cells["value"] = cellText(r.proof->value);
    cells["unit"] = cellText(r.proof->unit);
  }
  return cells;
}

}  // namespace

std::string marksCsv(const Marks& m) {
  std::string csv;
  for (const char* column : kColumns) csv += (csv.empty() ? "" : ",") + std::string(column);
  const auto line = [&](Cells cells) {
    cells["exercise"] = cellText(m.exercise);
    cells["student"] = cellText(m.student);
    cells["device"] = cellText(m.device);
    csv += "\r\n";
    for (const char* column : kColumns) csv += (column == kColumns[0] ? "" : ",") + cells[column];
  };
  for (const auto& s : m.steps) line(stepCells(s));
  for (const auto& r : m.rules) line(ruleCells(r));
  for (const auto& a : m.answers)
    line({{"kind", cellText("answer")},
          {"id", cellText(a.id)},
          {"text", cellText(a.question)},
          {"found", cellText(a.answer)}});
  for (const auto& f : m.failures)
    line({{"kind", cellText("failure")},
          {"text", cellText(f.reason)},
          {"found", cellText("failed")},
          {"seconds", cellText(f.at_s)}});
  line({{"kind", cellText("total")},
        {"points", cellText(m.points)},
        {"of", cellText(m.of)},
        {"hints", cellText(m.hints)},
        {"seconds", cellText(m.seconds)},
        {"passed", cellText(m.passed)}});
  return csv + "\r\n";
}

Result<void> writeMarks(const Rehearsal& rehearsal, const Marks& marks, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), folder.string());
  const std::pair<const char*, std::string> kFiles[] = {
      {"result.json", AnswerValue<Marks>::write(marks).dump(2) + "\n"},
      {"result.csv", marksCsv(marks)},
      {"result.html", marksHtml(marks, rehearsal, today())}};
  for (const auto& [name, text] : kFiles) {
    TRY(writeWholeText(folder / name, text));
  }
  return {};
}

}  // namespace standpoint
