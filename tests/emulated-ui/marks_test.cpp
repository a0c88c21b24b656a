// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/marks.h"

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/plain_words.h"
#include "tests/emulated-ui/marked.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kDate = "2026-05-04";

// A Focus that is on: nothing of it is passed, two rules are needed to pass, and one of them holds.
json lesson() {
  return json::parse(R"({
    "id": "X2", "title": {"en": "Settings"}, "goal": {"en": "Choose <fine> points."},
    "devices": ["faro-focus"], "model": "house",
    "start": [{"press": "power"}, {"wait": 130}],
    "steps": [{"id": "look", "text": {"en": "-1 is first"},
               "hint": {"en": "Manage."}, "done": "screen == manage", "points": 2}],
    "rules": [{"id": "fine", "text": {"en": "Low noise"}, "when": "end",
               "holds": "expected.sigma.25.10 <= 0.001 and battery <= 0.1", "points": 3, "must": true, "mistake": "M08",
               "because": {"en": "Walls get thick."}, "proof": "expected.sigma.25.10"},
              {"id": "on", "text": {"en": "Stay on"}, "when": "end",
               "holds": "time <= 600", "points": 1, "must": true},
              {"id": "warm", "text": {"en": "Warm up"}, "when": "end",
               "holds": "time >= 500 and answer.why in {key_a, key_b} or time >= 500", "points": 1}],
    "questions": [{"id": "why", "text": {"en": "Why?"},
                   "choices": [{"value": "key_a", "text": {"en": "=1+1 & more"}},
                               {"value": "key_b", "text": {"en": "@home"}}]}],
    "pass_mark": 0.2})");
}

// Rows of a table by the names of their columns.
std::vector<std::map<std::string, std::string>> rowsOf(const std::string& csv) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (std::size_t i = 0; i < csv.size(); ++i) {
    if (csv[i] == '"' && quoted && i + 1 < csv.size() && csv[i + 1] == '"')
      lines.back().back() += csv[i++];
    else if (csv[i] == '"')
      quoted = !quoted;
    else if (csv[i] == ',' && !quoted)
      lines.back().emplace_back();
    else if (csv[i] == '\n' && !quoted)
      lines.emplace_back(1);
    else if (csv[i] != '\r' || quoted)
      lines.back().back() += csv[i];
  }
  lines.pop_back();
  std::vector<std::map<std::string, std::string>> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].size(), lines[0].size());
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < lines[0].size(); ++k) row[lines[0][k]] = lines[i][k];
  }
  return rows;
}

class MarksTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto file = folder_.path() / "x.json";
    std::ofstream(file) << lesson();
    auto exercise = readExercise(file);
    ASSERT_TRUE(exercise) << describe(exercise.error());
    auto started = Rehearsal::start(*exercise, {}, folder_.path(), {}, quiet_);
    ASSERT_TRUE(started) << describe(started.error());
    rehearsal_ = *std::move(started);
  }
  void act(const json& action) {
    const auto ok = rehearsal_->act(*actionFrom(action, "test", ""), quiet_);
    EXPECT_TRUE(ok) << describe(ok.error());
  }
  Marks marks(const std::string& language = "en") { return marked(*rehearsal_, "=cmd|' /C calc'!A0", language); }
  std::string page(const std::string& language = "en") { return marksHtml(marks(language), *rehearsal_, kDate); }

  TemporaryFolder folder_;
  Progress quiet_;
  std::unique_ptr<Rehearsal> rehearsal_;
};

TEST_F(MarksTest, NameTheDemandsThatWereNeededToPassAndDidNotHold) {
  act({{"press", "manage"}});
  const auto m = marks();
  EXPECT_FALSE(m.passed);
  EXPECT_GT(m.score, m.pass_mark) << "the points alone would do";
  EXPECT_EQ(m.must_broken, std::vector<std::string>{"fine"});
  EXPECT_THAT(marksText(m), HasSubstr("required criterion not met: Low noise\n"));
  EXPECT_THAT(page(), HasSubstr("Required criterion not met: Low noise</p>"));
  for (const char* needed : {"Low noise", "Stay on"}) {
    EXPECT_THAT(marksText(m), HasSubstr(std::string(needed) + " (required to pass): "));
    EXPECT_THAT(page(), HasSubstr(std::string(needed) + "<br><small>required to pass</small>"));
  }
  EXPECT_THAT(page(), HasSubstr("Warm up</td>"));
}

TEST_F(MarksTest, ShowTheAnswerInWordsNotItsKey) {
  EXPECT_THAT(page(), HasSubstr("<td>Why?</td><td>not answered</td>"));
  EXPECT_THAT(marksText(marks()), HasSubstr("Why? not answered\n"));
  act({{"answer", "why"}, {"value", "key_a"}});
  const json answer = {{"id", "why"}, {"question", "Why?"}, {"value", "key_a"}, {"answer", "=1+1 & more"}};
  EXPECT_EQ(AnswerValue<Marks>::write(marks())["answers"], json::array({answer}));
  EXPECT_THAT(page(), HasSubstr("<td>Why?</td><td>=1+1 &amp; more</td>"));
  EXPECT_THAT(page(), Not(HasSubstr("key_a")));
  EXPECT_THAT(marksText(marks()), HasSubstr("Why? =1+1 & more\n"));
}

TEST_F(MarksTest, AreRoundedForPeopleAndNotForMachines) {
  act({{"wait", 100}});
  const auto m = marks();
  const auto& proof = *m.rules[0].proof;
  const double sigma = std::get<double>(proof.value), battery = *rehearsal_->fact("battery")->number;
  EXPECT_EQ(sigma, *rehearsal_->fact("expected.sigma.25.10")->number);
  EXPECT_EQ(proof.unit, "mm");
  const auto shown_sigma = fmt::format("Range noise at 25 m on 10 %: {:.3g} mm", sigma);
  ASSERT_NE(fmt::format("{:.3g}", sigma), fmt::format("{}", sigma)) << "it has something to round";
  const auto shown = shown_sigma + fmt::format("; Battery: {:.3g} %", battery * 100);
  EXPECT_THAT(marksText(m), HasSubstr("(required to pass): " + shown + "\n"));
  EXPECT_THAT(marksText(m), HasSubstr("measured in the data: " + shown_sigma + "\n"));
  EXPECT_THAT(page(), HasSubstr("<td>" + shown + "<br>"));
  EXPECT_THAT(page(), HasSubstr("measured in the data: " + shown_sigma + "</small>"));
  EXPECT_THAT(page(), HasSubstr("<td>Device time: 1:40</td>"));
  EXPECT_EQ(rowsOf(marksCsv(m))[1].at("value"), fmt::format("{}", sigma));
}

TEST_F(MarksTest, SayWhatWasExpectedInPlainLanguage) {
  const std::pair<const char*, std::vector<const char*>> kSaid[] = {
      {"en", {"Range noise at 25 m on 10 %: at most 0.001 mm; Battery: at most 10 %", "Device time: at least 8:20"}},
      {"de", {"Distanzrauschen auf 25 m bei 10 %: höchstens 0.001 mm; Akku: höchstens 10 %"}},
      {"uk", {"Акумулятор: щонайбільше 10 %", "Час на приладі: щонайменше 8:20"}}};
  for (const auto& [language, said] : kSaid)
    for (const char* text : said) EXPECT_THAT(page(language), HasSubstr(text));
  for (const char* sign : {"&lt;=", "&gt;=", "==", "sigma.25"}) EXPECT_THAT(page(), Not(HasSubstr(sign)));
  EXPECT_THAT(marks().rules[2].expected, testing::StartsWith("time >= 500 and")) << "for machines as it is written";
}

TEST_F(MarksTest, ShowAFigureOnTheSameSideOfItsLimitAsItIs) {
  const PlainWords words{rehearsal_->device(), rehearsal_->exercise(), "en"};
  EXPECT_EQ(words.figure("tilt", 0.123456, {}), "0.123°");
  EXPECT_EQ(words.figure("tilt", 0.021604, {0.0216}), "0.021604°") << "it is above";
  EXPECT_EQ(words.figure("plan.coverage", 0.29996, {0.3}), "29.996 %");
  EXPECT_EQ(words.figure("time", 600.25, {600}), "600.2 s");
  EXPECT_EQ(words.figure("time", 600, {600}), "10:00");
}

TEST_F(MarksTest, HaveEverythingInColumnsOfTheTable) {
  act({{"hint", "look"}});
  act({{"wait", 60}});
  act({{"press", "manage"}});
  act({{"answer", "why"}, {"value", "key_b"}});
  const auto rows = rowsOf(marksCsv(marks()));
  ASSERT_EQ(rows.size(), 6U);
  auto step = rows[0], fine = rows[1], warm = rows[3], answer = rows[4], total = rows[5];
  EXPECT_EQ(step["kind"] + step["held"] + step["points"] + step["of"] + step["hints"] + step["seconds"], "step112160");
  EXPECT_EQ(fine["held"] + fine["must"] + fine["mistake"] + fine["because"], "01M08Walls get thick.");
  EXPECT_EQ(fine["proof"] + fine["unit"] + fine["seconds"], "expected.sigma.25.10mm60");
  EXPECT_EQ(warm["must"], "0");
  EXPECT_EQ(answer["kind"] + answer["id"] + answer["text"], "answerwhyWhy?");
  EXPECT_EQ(total["kind"] + " " + total["points"] + " " + total["of"], "total 2 7") << "points, as in the rows above";
  EXPECT_EQ(total["hints"] + total["seconds"] + total["passed"], "1600");
  EXPECT_EQ(fine["passed"], "") << "of the whole, once";
}

TEST_F(MarksTest, HaveNoTextThatASpreadsheetTakesForAFormula) {
  act({{"answer", "why"}, {"value", "key_b"}});
  for (const auto& row : rowsOf(marksCsv(marks()))) EXPECT_EQ(row.at("student"), "'=cmd|' /C calc'!A0");
  auto rows = rowsOf(marksCsv(marks()));
  EXPECT_EQ(rows[0]["text"], "'-1 is first");
  EXPECT_EQ(rows[4]["found"], "'@home");
  EXPECT_EQ(rows[1]["text"], "Low noise");
  for (const char* name : {"+1", "\t=1", "\r=1"})
    EXPECT_EQ(rowsOf(marksCsv(marked(*rehearsal_, name)))[0]["student"], "'" + std::string(name));
}

TEST_F(MarksTest, TellOnThePageWhatWasDoneWhenAndWithWhat) {
  act({{"hint", "look"}});
  const auto& instrument = rehearsal_->device().type().instrument;
  EXPECT_THAT(page(), HasSubstr("<td>" + instrument.maker + " " + instrument.model + "</td>"));
  EXPECT_THAT(page(), HasSubstr("<td>Choose &lt;fine&gt; points.</td>"));
  EXPECT_THAT(page(), HasSubstr("<th>Graded on</th><td>2026-05-04</td>"));
  EXPECT_THAT(page(), HasSubstr("<th>Hints used</th><td>1</td>"));
  EXPECT_THAT(page(), HasSubstr("with a hint"));
}

TEST_F(MarksTest, AreWrittenWithTheDateOfTheirWriting) {
  ASSERT_TRUE(writeMarks(*rehearsal_, marks(), folder_.path() / "out"));
  std::ifstream in(folder_.path() / "out" / "result.html");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_TRUE(std::regex_search(text, std::regex("<th>Graded on</th><td>20\\d\\d-\\d\\d-\\d\\d</td>")));
}

TEST_F(MarksTest, AreFramedInTheLanguageOfThePage) {
  act({{"hint", "look"}});
  const auto english = page();
  const std::pair<const char*, std::vector<const char*>> kFrames[] = {
      {"de",
       {"Nicht bestanden", "14.3 % der Punkte (20 % erforderlich)", "Pflichtkriterium nicht erfüllt",
        "Schritt oder Kriterium", "Erwartet", "Gefunden", "Benutzte Hinweise", "Bewertet am", "nicht beantwortet",
        "in den Messpunkten", "Standpoint bildet"}},
      {"uk",
       {"Не складено", "14.3 % балів (потрібно 20 %)", "Обов’язковий критерій не виконано", "Крок або критерій",
        "Очікувалося", "Виявлено", "Використано підказок", "Оцінено", "без відповіді", "у точках скану",
        "Прилад відтворено"}}};
  for (const auto& [language, frame] : kFrames) {
    const auto text = page(language);
    for (const char* said : frame) EXPECT_THAT(text, HasSubstr(said));
    for (const char* foreign :
         {"assed", "Expected", "ound<", "Points", "Hints", "Marked", "answered", "emulated", "marks."})
      EXPECT_THAT(text, Not(HasSubstr(foreign))) << language;
  }
  EXPECT_THAT(english, HasSubstr("<b>Not passed</b>, score 14.3 % (20 % required)"));
}

}  // namespace
}  // namespace standpoint
