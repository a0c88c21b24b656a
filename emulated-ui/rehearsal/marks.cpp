// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/marks.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "emulated-ui/device/format.h"
#include "emulated-ui/device/numbers.h"

namespace standpoint {

namespace {

using nlohmann::json;

// A hint costs half of its step.
constexpr double kHinted = 0.5;

// Of a text that begins like a formula a spreadsheet would make one: the apostrophe says that it is text.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  if (!text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos) out += '\'';
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string cellText(const json& value) {
  if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
  if (value.is_number()) return fmt::format("{}", value.get<double>());
  return value.is_string() ? quoted(value.get<std::string>()) : std::string();
}

struct DeviceUnitRow {
  FactUnit unit;
  const char* name;
};
constexpr DeviceUnitRow kDeviceUnits[] = {{FactUnit::seconds, "s"},  {FactUnit::bytes, "B"},
                                          {FactUnit::metres, "m"},   {FactUnit::degrees, "°"},
                                          {FactUnit::celsius, "°C"}, {FactUnit::millimetres, "mm"}};

// Of the facts with a name of their own.
struct NamedUnitRow {
  std::string_view prefix;
  const char* name;
};
constexpr NamedUnitRow kNamedUnits[] = {
    {"place.", "m"}, {"walk.near.", "m"}, {"expected.reach.", "m"}, {"expected.sigma.", "mm"}};

const FactRow* deviceRow(const Device& device, const std::string& fact) {
  for (const auto* rows : {&device.type().program.facts, &sharedFacts()})
    for (const auto& row : *rows)
      if (fact == row.name) return &row;
  return nullptr;
}

const ProofRow* proofRow(const std::string& fact) {
  for (const auto& row : proofRows())
    if (fact == row.name) return &row;
  return nullptr;
}

std::string unitOf(const Device& device, const std::string& fact) {
  if (const auto* row = proofRow(fact)) return row->unit;
  if (const auto* row = deviceRow(device, fact))
    for (const auto& known : kDeviceUnits)
      if (known.unit == row->unit) return known.name;
  for (const auto& named : kNamedUnits)
    if (fact.starts_with(named.prefix)) return named.name;
  return {};
}

bool isFraction(const Device& device, const std::string& fact) {
  if (const auto* row = proofRow(fact))
    return *row->unit == '\0' && row->domain.minimum == 0 && row->domain.maximum == 1;
  const auto* row = deviceRow(device, fact);
  return row != nullptr && row->unit == FactUnit::fraction;
}

// Three significant figures, none of a whole number lost.
std::string roundedText(double n) {
  return n == std::round(n) || std::abs(n) >= 100 ? fmt::format("{:.0f}", n) : fmt::format("{:.3g}", n);
}

}  // namespace

std::string percentText(double fraction) { return roundedText(fraction * 100) + " %"; }

namespace {

// The choice in words; nothing where the question is not answered.
std::string answerText(const ExerciseQuestion& question, const std::string& value, const std::string& language) {
  for (std::size_t i = 0; i < question.choices.size(); ++i)
    if (question.choices[i] == value && !question.choice_texts[i].texts.empty())
      return question.choice_texts[i].in(language);
  return value;
}

// As people read it: rounded, with its unit.
std::string shownFact(const Rehearsal& rehearsal, const std::string& name, const Fact& fact,
                      const std::string& language) {
  const auto& device = rehearsal.device();
  for (const auto& question : rehearsal.exercise().questions)
    if (name == "answer." + question.id) return answerText(question, fact.text, language);
  if (!fact.number) return fact.text;
  if (name == "time") return clockText(*fact.number);
  if (isFraction(device, name)) return percentText(*fact.number);
  const auto* row = deviceRow(device, name);
  if (row != nullptr && row->unit != FactUnit::none) return factText(fact, row->unit);
  const auto unit = unitOf(device, name);
  return roundedText(*fact.number) + (unit.empty() || unit == "°" ? unit : " " + unit);
}

// "tilt = 0.123456, data.noise = –" for people. `found` names the condition's facts in their order.
std::string shownFacts(const Rehearsal& rehearsal, const Condition& condition, const std::string& found,
                       const std::string& language) {
  const auto names = condition.facts();
  std::string shown;
  std::size_t end = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto from = found.find(names[i] + " = ", end) + names[i].size() + 3;
    end = i + 1 < names.size() ? found.find(", " + names[i + 1] + " = ", from) : found.size();
    Fact fact = wordFact(found.substr(from, end - from));
    const auto now = rehearsal.fact(names[i]);
    if (!now || now->number) fact.number = numberIn(fact.text);  // a project may be called "007"
    shown += (shown.empty() ? "" : ", ") + names[i] + " = " + shownFact(rehearsal, names[i], fact, language);
  }
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

json answersOf(const Rehearsal& rehearsal, const std::string& language) {
  json answers = json::array();
  for (const auto& question : rehearsal.exercise().questions) {
    const auto value = rehearsal.fact("answer." + question.id)->text;
    answers.push_back({{"id", question.id},
                       {"question", question.text.in(language)},
                       {"value", value},
                       {"answer", answerText(question, value, language)}});
  }
  return answers;
}

}  // namespace

json marksOf(const Rehearsal& rehearsal, const std::string& student, const std::string& language) {
  const auto& e = rehearsal.exercise();
  double points = 0, possible = 0;
  json must_broken = json::array();
  json steps = json::array(), rules = json::array();
  for (std::size_t i = 0; i < e.steps.size(); ++i) {
    const auto& step = e.steps[i];
    const auto& state = rehearsal.steps()[i];
    const double earned = state.done ? step.points * (state.hinted ? kHinted : 1) : 0;
    points += earned;
    possible += step.points;
    steps.push_back({{"id", step.id},
                     {"text", step.text.in(language)},
                     {"expected", step.done.text()},
                     {"done", state.done},
                     {"at_s", state.done ? json(state.at_s) : json(nullptr)},
                     {"hinted", state.hinted},
                     {"points", earned},
                     {"of", step.points}});
  }
  const auto judged = rehearsal.judge();
  for (std::size_t i = 0; i < e.rules.size(); ++i) {
    const auto& rule = e.rules[i];
    const auto& state = judged[i];
    points += state.held ? rule.points : 0;
    possible += rule.points;
    if (rule.must && !state.held) must_broken.push_back(rule.id);
    json row = {{"id", rule.id},
                {"text", rule.text.in(language)},
                {"expected", rule.holds.text()},
                {"found", state.asked ? state.found : neverAsked(rehearsal, rule, language)},
                {"found_text", state.asked ? shownFacts(rehearsal, rule.holds, state.found, language)
                                           : neverAsked(rehearsal, rule, language)},
                {"asked", state.asked},
                {"held", state.held},
                {"must", rule.must},
                {"points", state.held ? rule.points : 0},
                {"of", rule.points}};
    if (!state.held) {
      row["at_s"] = state.broken_at_s >= 0 ? json(state.broken_at_s) : json(nullptr);
      if (!rule.mistake.empty()) row["mistake"] = rule.mistake;
      if (state.asked && !rule.because.texts.empty()) row["because"] = rule.because.in(language);
    }
    if (state.asked && !rule.proof.empty())
      if (const auto proof = rehearsal.fact(rule.proof))
        row["proof"] = {{"fact", rule.proof},
                        {"value", proof->number ? json(*proof->number) : json(proof->text)},
                        {"unit", unitOf(rehearsal.device(), rule.proof)},
                        {"text", shownFact(rehearsal, rule.proof, *proof, language)}};
    rules.push_back(std::move(row));
  }
  const double score = possible > 0 ? points / possible : 1;
  json actions = json::array(), files = json::array(), failures = json::array();
  for (const auto& failed : rehearsal.failures())
    failures.push_back({{"at_s", failed.at_s}, {"reason", failed.reason}});
  for (const auto& action : rehearsal.actions()) actions.push_back(toJson(action));
  for (const auto& project : rehearsal.device().state().projects)
    for (const auto& setup : project.setups)
      files.push_back({{"file", setup.file}, {"station", setup.station}, {"points", setup.points}});
  const bool in_time = !rehearsal.overTime();
  const bool passed = must_broken.empty() && in_time && score >= e.pass_mark;
  const auto& instrument = rehearsal.device().type().instrument;
  return {{"exercise", e.id},
          {"title", e.title.in(language)},
          {"goal", e.goal.in(language)},
          {"language", language},
          {"device", rehearsal.device().type().definition.title},
          {"instrument", instrument.id},
          {"maker", instrument.maker},
          {"model", instrument.model},
          {"student", student},
          {"operator", rehearsal.device().value("operator")},
          {"passed", passed},
          {"must_broken", std::move(must_broken)},
          {"score", score},
          {"points", points},
          {"of", possible},
          {"pass_mark", e.pass_mark},
          {"seconds", rehearsal.seconds()},
          {"time_limit_s", e.time_limit_s},
          {"in_time", in_time},
          {"steps", std::move(steps)},
          {"rules", std::move(rules)},
          {"answers", answersOf(rehearsal, language)},
          {"hints", rehearsal.fact("hints")->number.value_or(0)},
          {"failures", std::move(failures)},
          {"actions", std::move(actions)},
          {"files", std::move(files)}};
}

std::string brokenDemands(const json& m) {
  std::string texts;
  for (const auto& rule : m["rules"])
    if (rule["must"].get<bool>() && !rule["held"].get<bool>())
      texts += (texts.empty() ? "" : "; ") + rule["text"].get<std::string>();
  return texts;
}

std::string marksText(const json& m) {
  std::string text = fmt::format("{} {} with {}: {}, score {} ({} required), {} device time\n",
                                 m["exercise"].get<std::string>(), m["title"].get<std::string>(),
                                 m["device"].get<std::string>(), m["passed"].get<bool>() ? "passed" : "not passed",
                                 percentText(m["score"]), percentText(m["pass_mark"]), clockText(m["seconds"]));
  if (!m["must_broken"].empty()) text += fmt::format("  required criterion not met: {}\n", brokenDemands(m));
  if (!m["in_time"].get<bool>()) text += fmt::format("  over the time limit of {}\n", clockText(m["time_limit_s"]));
  for (const auto& s : m["steps"])
    text += fmt::format("  {} {}{}\n", s["done"].get<bool>() ? "[x]" : "[ ]", s["text"].get<std::string>(),
                        s["hinted"].get<bool>() ? " (with a hint)" : "");
  for (const auto& r : m["rules"]) {
    text += fmt::format("  {} {}{}: {}\n", r["held"].get<bool>() ? "[x]" : "[ ]", r["text"].get<std::string>(),
                        r["must"].get<bool>() ? " (required to pass)" : "", r["found_text"].get<std::string>());
    if (r.contains("because")) text += fmt::format("        {}\n", r["because"].get<std::string>());
    if (!r["held"].get<bool>() && r.contains("proof"))
      text += fmt::format("        measured in the data: {} = {}\n", r["proof"]["fact"].get<std::string>(),
                          r["proof"]["text"].get<std::string>());
  }
  for (const auto& a : m["answers"])
    text += fmt::format("  {} {}\n", a["question"].get<std::string>(),
                        a["value"] == "" ? "not answered" : a["answer"].get<std::string>());
  for (const auto& f : m["failures"])
    text += fmt::format("  failed after {}: {}\n", clockText(f["at_s"].get<double>()), f["reason"].get<std::string>());
  return text;
}

std::string marksCsv(const json& m) {
  static constexpr const char* kColumns[] = {"exercise", "student", "device", "kind",  "id",      "text",    "expected",
                                             "found",    "held",    "points", "of",    "must",    "mistake", "because",
                                             "proof",    "value",   "unit",   "hints", "seconds", "passed"};
  std::string csv;
  for (const char* column : kColumns) csv += (csv.empty() ? "" : ",") + std::string(column);
  // Cells by column; what is not there stays empty.
  const auto line = [&](json cells) {
    for (const char* of_all : {"exercise", "student", "device"}) cells[of_all] = m[of_all];
    csv += "\r\n";
    for (const char* column : kColumns)
      csv += (column == kColumns[0] ? "" : ",") + cellText(cells.value(column, json()));
  };
  for (const auto& s : m["steps"])
    line({{"kind", "step"},
          {"id", s["id"]},
          {"text", s["text"]},
          {"expected", s["expected"]},
          {"found", s["done"].get<bool>() ? "done" : "not done"},
          {"held", s["done"]},
          {"points", s["points"]},
          {"of", s["of"]},
          {"hints", s["hinted"].get<bool>() ? 1 : 0},
          {"seconds", s["at_s"]}});
  for (const auto& r : m["rules"]) {
    const auto proof = r.value("proof", json::object());
    line({{"kind", "rule"},
          {"id", r["id"]},
          {"text", r["text"]},
          {"expected", r["expected"]},
          {"found", r["found"]},
          {"held", r["held"]},
          {"points", r["points"]},
          {"of", r["of"]},
          {"must", r["must"]},
          {"mistake", r.value("mistake", json())},
          {"because", r.value("because", json())},
          {"proof", proof.value("fact", json())},
          {"value", proof.value("value", json())},
          {"unit", proof.value("unit", json())},
          {"seconds", r.value("at_s", json())}});
  }
  for (const auto& a : m["answers"])
    line({{"kind", "answer"}, {"id", a["id"]}, {"text", a["question"]}, {"found", a["answer"]}});
  for (const auto& f : m["failures"])
    line({{"kind", "failure"}, {"text", f["reason"]}, {"found", "failed"}, {"seconds", f["at_s"]}});
  line({{"kind", "total"},
        {"points", m["points"]},
        {"of", m["of"]},
        {"hints", m["hints"]},
        {"seconds", m["seconds"]},
        {"passed", m["passed"]}});
  return csv + "\r\n";
}

Result<void> writeMarks(const Rehearsal& rehearsal, const json& marks, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return failure(ErrorKind::file_system, "cannot create the folder: " + error.message(), folder.string());
  const std::pair<const char*, std::string> kFiles[] = {{"result.json", marks.dump(2) + "\n"},
                                                        {"result.csv", marksCsv(marks)},
                                                        {"result.html", marksHtml(marks, rehearsal, today())}};
  for (const auto& [name, text] : kFiles) {
    std::ofstream out(folder / name, std::ios::binary);
    out << text;
    out.close();
    if (!out)
      return failure(ErrorKind::file_system, "cannot write the file: the disk may be full", (folder / name).string());
  }
  return {};
}

}  // namespace standpoint
