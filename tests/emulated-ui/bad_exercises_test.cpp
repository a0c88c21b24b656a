// SPDX-License-Identifier: GPL-3.0-or-later
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/rehearsal.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json sound() {
  return json::parse(R"({
    "id": "X1", "title": {"en": "Scan", "de": "Scannen"}, "goal": {"en": "Scan.", "de": "Scannen."},
      "devices": ["faro-focus"], "model": "house",
    "area": [0, 0, 0, 6, 4, 2.5], "places": {"door": [4.7, 4.45]},
    "setup": [{"verb": "station", "options": {"add": "S1", "on": [4.3, 1.6, 0]}}],
    "start": [{"press": "power"}, {"wait": 130}],
    "troubles": ["dust"], "events": [{"when": "progress > 0.5", "trouble": "tripod_moved"}],
    "steps": [{"id": "scan", "text": {"en": "Scan.", "de": "Scannen."}, "widget": "start_scan",
      "done": "setups >= 1 and answer.ok == yes", "points": 2}],
    "rules": [{"id": "clean", "text": {"en": "Clean.", "de": "Sauber."}, "when": "each scan_started",
      "holds": "dust == no", "points": 1, "proof": "data.noise"}],
    "questions": [{"id": "ok", "text": {"en": "Ok?", "de": "Gut?"}, "choices": [{"value": "yes",
      "text": {"en": "Yes", "de": "Ja"}}]}],
    "solution": [{"hand": "wipe_optics"}, {"answer": "ok", "value": "yes"}]})");
}

// All that is said of a file with this text.
class BadExercise : public testing::Test {
 protected:
  std::string saysOf(const std::string& text) {
    const auto file = folder_.path() / "x.json";
    std::ofstream(file, std::ios::binary) << text;
    const auto read = readExercise(file);
    if (!read) return describe(read.error());
    std::string all;
    for (const auto& fault : checkExercise(*read)) all += describe(fault) + "\n";
    return all;
  }
  std::string saysOf(const char* pointer, const json& value) {
    json changed = sound();
    changed[json::json_pointer(pointer)] = value;
    return saysOf(changed.dump());
  }
  TemporaryFolder folder_;
};

TEST_F(BadExercise, ASoundOneIsTaken) { EXPECT_EQ(saysOf(sound().dump()), ""); }

TEST_F(BadExercise, IsOneInWhichNothingCounts) {
  auto text = sound();
  text["steps"][0]["points"] = 0, text["rules"][0]["points"] = 0;
  EXPECT_THAT(saysOf(text.dump()), HasSubstr("no points to award"));
}

TEST_F(BadExercise, DoesNotTakeTheOthersOffTheList) {
  setenv("STANDPOINT_EXERCISES", folder_.path().c_str(), 1);
  const auto shipped = knownExercises().readable.size();
  json second = sound();
  second["id"] = "E01";
  std::ofstream(folder_.path() / "a.json") << "{";
  std::ofstream(folder_.path() / "b.json") << second.dump();
  std::ofstream(folder_.path() / "c.json") << sound().dump();
  const auto known = knownExercises();
  unsetenv("STANDPOINT_EXERCISES");
  EXPECT_EQ(known.readable.size(), shipped + 1);
  EXPECT_EQ(known.readable.back().exercise.id, "X1");
  ASSERT_EQ(known.refused.size(), 2U);
  EXPECT_THAT(describe(known.refused[0]), HasSubstr("a.json"));
  EXPECT_THAT(describe(known.refused[1]), HasSubstr("b.json /id"));
  EXPECT_THAT(describe(known.refused[1]), HasSubstr("e01-preflight.json"));
}

struct Wrong {
  const char* pointer;
  json value;
  const char* place;
  const char* message;
};

TEST_F(BadExercise, EachMistakeIsNamedWithItsPlace) {
  const json text = {{"en", "a"}, {"de", "b"}};
  const Wrong kWrong[] = {
      {"/id", 5, "x.json /id", "must be a text"},
      {"/id", "", "x.json /id", "must not be empty"},
      {"/id", 5, "x.json /id", "in quotes, not the number 5; write it like \"E99\""},
      {"/id", "../../etc/passwd", "x.json /id", "can contain only letters"},
      {"/questions/0/choices", json::array(), "x.json /questions/0/choices", "requires choices"},
      {"/questions/0/number", {{"minimum", 0}, {"maximum", 9}}, "x.json /questions/0/choices", "or else a number"},
      {"/questions/0/number", {{"minimum", 9}, {"maximum", 0}}, "x.json /questions/0/number/maximum", "above the"},
      {"/questions/0/choices/1",
       {{"value", "yes"}, {"text", text}},
       "x.json /questions/0/choices/1/value",
       "duplicate"},
      {"/places/a~1b", {1}, "x.json /places/a~1b", "x and y"},
      {"/setup/0/options/on/0", 1e30, "x.json /setup/0/options", "none beyond 1e9"},
      {"/title", "Scan", "x.json /title",
       "must be an object with a text for each language, such as {\"en\": \"Scan.\"}, not the text \"Scan\""},
      {"/title/en", 5, "x.json /title/en", "text"},
      {"/goal", {{"de", "Scannen."}}, "x.json /goal", "missing text in 'en'"},
      {"/goal", {{"en", "Scan."}}, "x.json /goal", "missing text in 'de'"},
      {"/steps/0/text", {{"en", "Scan."}}, "x.json /steps/0/text", "missing text in 'de'"},
      {"/steps/0/text", {{"en", "Scan."}, {"de", " "}}, "x.json /steps/0/text", "empty text in 'de'"},
      {"/title", {{"en", "Scan."}, {"de", ""}}, "x.json /title", "empty text in 'de'"},
      {"/steps/0/done", "setups >= 1", "x.json /questions/0", "nothing asks for its answer"},
      {"/rules/0/text", {{"en", "Clean."}}, "x.json /rules/0/text", "missing text in 'de'"},
      {"/rules/0/cost", {{"en", "A day."}}, "x.json /rules/0/cost", "missing text in 'de'"},
      {"/rules/0/cost", {{"de", "Ein Tag."}}, "x.json /rules/0/cost", "missing text in 'en'"},
      {"/rules/0/cost", "A day.", "x.json /rules/0/cost", "must be an object with a text for each language"},
      {"/rules/0/cost",
       {{"en", "{data.nois} mm"}, {"de", "{data.nois} mm"}},
       "x.json /rules/0/cost",
       "unknown fact 'data.nois'"},
      {"/rules/0/holds", "cleaning.Person.recal > 0", "x.json /rules/0/holds", "unknown fact"},
      {"/solution/0",
       {{"verb", "clean"}, {"options", {{"in", "a.e57"}}}},
       "x.json /solution/0/options",
       "filters alone"},
      {"/solution/0",
       {{"verb", "clean"}, {"options", {{"filters", json::array({"movin"})}}}},
       "x.json /solution/0/options",
       "unknown filter 'movin'"},
      {"/setup/0/verb", "clean", "x.json /setup/0/verb", "not allowed here"},
      {"/rules/0/shown_at", "gate", "x.json /rules/0/shown_at", "unknown part, place or target 'gate'"},
      {"/rules/0/shown_at", "gate", "x.json /rules/0/shown_at", "door"},
      {"/rules/0/shown_at", 5, "x.json /rules/0/shown_at", "must be a text"},
      {"/parts", {{"wall", {{"box", {0, 0, 0, 0, 1, 1}}}}}, "x.json /parts/wall/box", "swapped corners"},
      {"/parts", {{"wall", json::object()}}, "x.json /parts/wall", "specify a product, a box or a floor"},
      {"/questions/0/text", {{"en", "Ok?"}}, "x.json /questions/0/text", "missing text in 'de'"},
      {"/questions/0/choices/0/text", {{"en", "Yes"}}, "x.json /questions/0/choices/0", "missing text in 'de'"},
      {"/devices", json::array(), "x.json /devices", "at least one device"},
      {"/devices", {5}, "x.json /devices", "a list of texts"},
      {"/devices/0", "abacus", "x.json /devices/0", "unknown device 'abacus'"},
      {"/instrument", "abacus", "x.json /devices/0", "abacus"},
      {"/model", "castle", "x.json /model", "unknown sample 'castle'"},
      {"/model", "../../etc/passwd", "x.json /model", "unknown sample"},
      {"/area", {1, 2, 3}, "x.json /area", "six numbers"},
      {"/area/0", "a", "x.json /area", "six numbers"},
      {"/area", {0, 4, 0, 6, 0, 2.5}, "x.json /area", "swapped corners: the minimum y is 4 and the maximum 0"},
      {"/model", "hut.ifc", "x.json /model", "no file 'hut.ifc' beside the exercise"},
      {"/model", "../hut.ifc", "x.json /model", "no file"},
      {"/control", {{"T1", {1, 2}}}, "x.json /control/T1", "x, y and z"},
      {"/battery", 1.5, "x.json /battery", "1"},
      {"/expect", {{"broken", {"cleen"}}}, "x.json /expect/broken", "did you mean 'clean'?"},
      {"/rules/0/because", {{"en", "It is {dst}."}, {"de", "Es ist {dust}."}}, "x.json /rules/0/because", "'dst'"},
      {"/rules/0/because", {{"en", "{tilt *}"}, {"de", "{tilt * 2}"}}, "x.json /rules/0/because", "is no figure"},
      {"/places/door", {1}, "x.json /places/door", "x and y"},
      {"/setup", 5, "x.json /setup", "list"},
      {"/setup/0/verb", "export", "x.json /setup/0/verb",
       "'export' is not allowed here; allowed: station, target, plan, treat, mover, scan"},
      {"/setup/0", {{"press", "power"}}, "x.json /setup/0", "must be a verb, such as"},
      {"/start/0", {{"verb", "treat"}}, "x.json /start/0/verb", "allowed: station, target, plan and clean"},
      {"/start/0", {{"dance", "power"}}, "x.json /start/0", "an action must be one of"},
      {"/start/0/press", "powder", "x.json /start/0", "no control 'powder'"},
      {"/start/1/wait", -1, "x.json /start/1/wait", "a number from 0"},
      {"/start/1/wait", 1e9, "x.json /start/1/wait", "a number from 0"},
      {"/troubles/0", "earthquake", "x.json /troubles/0", "unknown trouble 'earthquake'"},
      {"/events/0/trouble", "earthquake", "x.json /events/0/trouble", "unknown trouble 'earthquake'"},
      {"/events/0/when", " ", "x.json /events/0/when", "must not be empty; write it like"},
      {"/steps/0/widget", "start_scam", "x.json /steps/0/widget", "no control 'start_scam'"},
      {"/steps/0/done", " ", "x.json /steps/0/done", "must not be empty; write it like"},
      {"/steps/0/done", "setups >", "x.json /steps/0/done", "column"},
      {"/steps/0/done", "setup >= 1", "x.json /steps/0/done", "unknown fact 'setup'"},
      {"/steps/0/done", "setups >= many", "x.json /steps/0/done", "not a number"},
      {"/steps/0/done", "card == eaten", "x.json /steps/0/done", "never 'eaten'"},
      {"/steps/0/done", "setups >= 2 and setups < 1", "x.json /steps/0/done", "can never be true"},
      {"/steps/0/done", "answer.ok == no", "x.json /steps/0/done", "never 'no'"},
      {"/steps/0/done", "answer.really == yes", "x.json /steps/0/done", "unknown fact"},
      {"/steps/0/done", "place.window < 1", "x.json /steps/0/done", "unknown fact"},
      {"/steps/0/done", "expected.sigma.0.10 < 1", "x.json /steps/0/done", "unknown fact"},
      {"/steps/0/done", "expected.sigma.10 < 1", "x.json /steps/0/done", "unknown fact"},
      {"/steps/0/done", "expected.reach.101 > 1", "x.json /steps/0/done", "unknown fact"},
      {"/steps/0/done", "data.noise < 0", "x.json /steps/0/done", "can never be true"},
      {"/steps/0/points", -1, "x.json /steps/0/points", "a number from 0"},
      {"/steps/0/points", "two", "x.json /steps/0/points", "a number from 0"},
      {"/steps/0/colour", "red", "x.json /steps/0/colour", "unknown"},
      {"/rules/0/when", "sometimes", "x.json /rules/0/when", "is not a valid time: use"},
      {"/rules/0/when", "each", "x.json /rules/0/when", "event"},
      {"/rules/0/when", "end scan_started", "x.json /rules/0/when", "event"},
      {"/rules/0/holds", " ", "x.json /rules/0/holds", "must not be empty; write it like"},
      {"/rules/0/holds", "dust == perhaps", "x.json /rules/0/holds", "never 'perhaps'"},
      {"/rules/0/must", "yes", "x.json /rules/0/must", "true or false"},
      {"/rules/0/proof", "data.nose", "x.json /rules/0/proof", "unknown fact 'data.nose'"},
      {"/solution/0/hand", "juggle", "x.json /solution/0/hand", "unknown hand action 'juggle'"},
      {"/solution/0/hand", "levl", "x.json /solution/0/hand", "did you mean 'level'?"},
      {"/solution/0",
       {{"hand", "stand_at"}, {"value", "S2"}},
       "x.json /solution/0/value",
       "unknown station 'S2'; did you mean 'S1'?"},
      {"/start/0", {{"hand", "stand_at"}}, "x.json /start/0/value", "unknown station ''"},
      {"/solution/0",
       {{"press", "quality"}, {"value", 2}},
       "x.json /solution/0/value",
       "in quotes, not the number 2; write \"2\""},
      {"/solution/0",
       {{"press", "quality"}, {"value", "2"}},
       "x.json /solution/0/value",
       "did you mean '2x'? available: 2x, "},
      {"/solution/0", {{"verb", "station"}, {"options", 5}}, "x.json /solution/0/options", "not the number 5"},
      {"/setup/0/options", json::object(), "x.json /setup/0/options", "'add' is required by"},
      {"/setup/0/options/on", "4,3", "x.json /setup/0/options", "'on' must be three numbers"},
      {"/setup/0/options/onn", 1, "x.json /setup/0/options", "unknown option 'onn'"},
      {"/setup/0",
       {{"verb", "target"}, {"options", {{"on", {1, 1, 0}}}}},
       "x.json /setup/0/options",
       "'add' is required by"},
      {"/setup/0",
       {{"verb", "treat"}, {"options", {{"products", {"class:IfcDoor"}}}}},
       "x.json /setup/0/options",
       "'as' is required by"},
      {"/setup/0",
       {{"verb", "mover"}, {"options", {{"kind", "turning"}, {"turn", 30}}}},
       "x.json /setup/0/options",
       "'add' is required by"},
      {"/setup/0",
       {{"verb", "mover"}, {"options", {{"add", "Rotor"}, {"kind", "turning"}, {"rpm", 5}}}},
       "x.json /setup/0/options",
       "unknown option 'rpm'"},
      {"/rules/0/when", "each scan_begun", "x.json /rules/0/when",
       "unknown event 'scan_begun'; did you mean 'scan_stored'? available: scan_stored, scan_started, "},
      {"/rules/0/when", "each field", "x.json /rules/0/when", "unknown event 'field'"},
      {"/rules/0/mistake", 8, "x.json /rules/0/mistake", "write it like \"M08\""},
      {"/steps/0/done", "count.xyz >= 1", "x.json /steps/0/done", "no countable event 'xyz'; available:"},
      {"/steps/0/done", "setups >= @count.scan_begun", "x.json /steps/0/done", "did you mean 'scan_stored'?"},
      {"/steps/0/done", "count.pressed.home/start_scam >= 1", "x.json /steps/0/done",
       "did you mean 'home/start_scan'?"},
      {"/steps/0/done", "count.screen.hom >= 1", "x.json /steps/0/done", "did you mean 'home'?"},
      {"/steps/0/done", "count.field.station.twice >= 1", "x.json /steps/0/done", "did you mean 'station'?"},
      {"/steps/0/done", 5, "x.json /steps/0/done", "write it like \"setups >= 1\""},
      {"/steps/0/don", "setups >= 1", "x.json /steps/0/don", "unknown key; did you mean 'done'?"},
      {"/solution/1/answer", "why", "x.json /solution/1", "unknown question 'why'"},
      {"/solution/1/value", "maybe", "x.json /solution/1", "'maybe' is not one of"},
      {"/time_limit_s", "ten", "x.json /time_limit_s", "a number from 0"},
      {"/pass_mark", 2, "x.json /pass_mark", "a number from 0"},
      {"/hobby", "chess", "x.json /hobby", "unknown"},
  };
  for (const auto& wrong : kWrong) {
    const auto said = saysOf(wrong.pointer, wrong.value);
    EXPECT_THAT(said, HasSubstr(wrong.place)) << wrong.pointer << " = " << wrong.value;
    EXPECT_THAT(said, HasSubstr(wrong.message)) << wrong.pointer << " = " << wrong.value;
  }
}

TEST_F(BadExercise, OneIdForTwoStepsRulesOrQuestionsIsRefused) {
  for (const char* list : {"steps", "rules", "questions"}) {
    json twice = sound();
    twice[list].push_back(twice[list][0]);
    EXPECT_THAT(saysOf(twice.dump()), HasSubstr(std::string("x.json /") + list + "/1")) << list;
  }
}

TEST_F(BadExercise, WithoutStepsAndRulesNothingCanBeMarked) {
  json empty = sound();
  empty.erase("steps");
  empty.erase("rules");
  EXPECT_THAT(saysOf(empty.dump()), HasSubstr("an exercise requires steps or rules"));
}

TEST_F(BadExercise, NestedDeeplyItIsRefusedWithoutARecursionOfItsOwn) {
  EXPECT_NE(saysOf(std::string(200000, '[')), "");
  EXPECT_NE(saysOf(std::string(5000, '[') + std::string(5000, ']')), "");
  EXPECT_THAT(saysOf("/steps/0/done", std::string(200, '(') + "setups >= 1" + std::string(200, ')')),
              HasSubstr("nested too deeply"));
  std::string nots = "setups >= 1";
  for (int i = 0; i < 400; ++i) nots = "not " + nots;
  EXPECT_THAT(saysOf("/steps/0/done", nots), HasSubstr("nested too deeply"));
  EXPECT_THAT(saysOf("/steps/0/done", "setups >= 1 and " + std::string(100000, 'x')), HasSubstr("too long"));
}

TEST_F(BadExercise, AConditionWithTooManyCasesIsRefusedAtOnce) {
  std::string many = "(setups >= 1 or hints >= 1)";
  for (int i = 0; i < 40; ++i) many += " and (setups >= 1 or hints >= 1)";
  EXPECT_THAT(saysOf("/steps/0/done", many), HasSubstr("/steps/0/done"));
}

TEST_F(BadExercise, CutOffAnywhereItIsRefused) {
  const auto text = sound().dump();
  for (std::size_t n = 0; n < text.size(); n += 7) EXPECT_THAT(saysOf(text.substr(0, n)), HasSubstr("x.json")) << n;
}

// What is left of it either reads or is refused with the file's name; a crash or a hang would end the test.
TEST_F(BadExercise, WithBytesChangedItIsReadOrRefused) {
  const auto text = sound().dump();
  std::mt19937 random(7);
  for (int i = 0; i < 400; ++i) {
    auto changed = text;
    for (int k = 0; k < 1 + i % 4; ++k) changed[random() % changed.size()] = static_cast<char>(random() % 256);
    const auto file = folder_.path() / "x.json";
    std::ofstream(file, std::ios::binary) << changed;
    if (const auto read = readExercise(file); !read) {
      EXPECT_THAT(describe(read.error()), HasSubstr("x.json"));
    }
  }
}

TEST_F(BadExercise, AListOfActionsIsRefusedByItsPlaceToo) {
  const auto file = folder_.path() / "actions.json";
  const auto says = [&](const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
    const auto read = readActions(file);
    return read ? std::string() : describe(read.error());
  };
  EXPECT_EQ(says(R"([{"press": "power"}])"), "");
  EXPECT_EQ(says(R"({"actions": [{"press": "power"}]})"), "");
  EXPECT_THAT(says("{}"), HasSubstr("a list of actions is needed"));
  EXPECT_THAT(says(R"([{"press": "power"}, 5])"), HasSubstr("actions.json /1"));
  EXPECT_THAT(says(R"({"actions": [{"verb": "export"}]})"), HasSubstr("actions.json /actions/0/verb"));
}

}  // namespace
}  // namespace standpoint
