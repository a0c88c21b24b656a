// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/exercise_words.h"
#include "tests/emulated-ui/working.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> lossesOf(const Report& report) {
  std::vector<std::string> losses;
  for (const auto& issue : report.issues)
    if (issue.severity == Severity::loss) losses.push_back(issue.source + ": " + issue.message);
  return losses;
}

TEST(Languages, AreSevenAndHaveEveryWordOfEveryDevice) {
  const auto words = wordsOfAllDevices();
  ASSERT_TRUE(words) << describe(words.error());
  EXPECT_THAT(words->languages(), ElementsAre("de", "en", "es", "fr", "it", "pl", "uk"));
  EXPECT_THAT(lossesOf(words->check()), IsEmpty());
}

// The four that were written with the rule at hand.
TEST(Languages, KeepLabelsShortEnoughForTilesAndButtons) {
  const auto words = wordsOfAllDevices();
  ASSERT_TRUE(words) << describe(words.error());
  for (const auto& issue : words->check().issues)
    for (const auto* language : {"(es)", "(fr)", "(it)", "(pl)"})
      if (issue.source.ends_with(language)) ADD_FAILURE() << issue.source << ": " << issue.message;
}

TEST(Languages, HaveEveryTextOfTheExercises) {
  const auto words = ExerciseWords::read(wordsFolder());
  ASSERT_TRUE(words) << describe(words.error());
  EXPECT_THAT(lossesOf(words->check(shippedExercises().readable)), IsEmpty());
}

class WordFiles : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name) << text;
  }
  std::vector<std::string> findings() const {
    const auto words = Words::read(folder_.path());
    EXPECT_TRUE(words) << describe(words.error());
    std::vector<std::string> all;
    for (const auto& issue : words->check().issues) all.push_back(issue.source + ": " + issue.message);
    return all;
  }
  TemporaryFolder folder_;
};

TEST_F(WordFiles, OfOneLanguageAddItToTheWordsOfOthers) {
  write("common.json", R"({"words": {"scan": {"en": "Scan"}, "language=en": {"en": "English"}}})");
  write("pl/common.json", R"({"language": "pl", "words": {"scan": "Skanuj", "language=pl": "Polski"}})");
  write("pl/x7.json", R"({"language": "pl", "words": {"scan": "Start"}})");
  auto words = Words::read(folder_.path());
  ASSERT_TRUE(words) << describe(words.error());
  ASSERT_THAT(languageFiles(folder_.path(), "x7"), ElementsAre(folder_.path() / "pl" / "x7.json"));
  ASSERT_TRUE(words->add(folder_.path() / "pl" / "x7.json", "x7"));
  EXPECT_EQ(words->text("rtc", "scan", "pl"), "Skanuj");
  EXPECT_EQ(words->text("x7", "scan", "pl"), "Start");
  EXPECT_EQ(words->text("rtc", "scan", "it"), "Scan");
  EXPECT_EQ(words->text("rtc", "language=pl", "en"), "Polski") << "as those call it who speak it";
  EXPECT_THAT(findings(), IsEmpty());
}

TEST_F(WordFiles, DoNotLendADeviceASharedWordOfAnotherMeaning) {
  write("common.json", R"({"words": {"range": {"en": "Range", "pl": "Zasięg"}}})");
  write("p.json", R"({"of": "p", "words": {"range": {"en": "Distance"}}})");
  const auto words = Words::read(folder_.path());
  ASSERT_TRUE(words) << describe(words.error());
  EXPECT_EQ(words->text("p", "range", "pl"), "Distance");
  EXPECT_FALSE(words->has("p", "range", "pl"));
}

TEST_F(WordFiles, AreRefusedByNameAndPlace) {
  write("a.json", R"({"words": {"scan": {"en": "Scan", "pl": "Skan"}}})");
  write("pl/common.json", R"({"language": "pl", "words": {"scan": "Skanuj"}})");
  auto words = Words::read(folder_.path());
  ASSERT_FALSE(words);
  EXPECT_EQ(describe(words.error()), "pl/common.json /words/scan: already defined in another file");
  write("pl/common.json", R"({"language": "pl", "words": {"stop": 3}})");
  words = Words::read(folder_.path());
  ASSERT_FALSE(words);
  EXPECT_THAT(describe(words.error()), HasSubstr("pl/common.json /words/stop"));
}

TEST_F(WordFiles, AreCheckedForWhatALanguageLacks) {
  write("common.json", R"({"words": {
    "language=en": {"en": "English"}, "language=pl": {"pl": "Polski"},
    "a": {"en": "Scan"},
    "b": {"pl": "Skan"},
    "c": {"en": "{battery} left", "pl": "zostało {card}"},
    "d": {"en": "{n} {n|one=scan|other=scans}", "pl": "{n} {n|one=skan|many=skanów}"},
    "e": {"en": "{n} {n|one=scan|few=scans|other=scans}", "pl": "skany: {n}"},
    "f": {"en": "On", "pl": "Obecnie włączone"}}})");
  EXPECT_THAT(findings(), ElementsAre("a (pl): no text for 'Scan'", "b: has a text in 'pl', but none in English",
                                      "c (pl): 'zostało {card}' names other facts than '{battery} left'",
                                      "d (pl): 'n' lacks the form 'few'", "e (en): 'n' has no form 'few' here",
                                      "f (pl): 'Obecnie włączone' is much longer than 'On'"));
}

TEST_F(WordFiles, AddTextsToAnExerciseThatLacksThem) {
  write("pl/exercises.json", R"({"language": "pl", "exercises": {"Scan.": "Zeskanuj.", "Go home.": "Idź do domu."}})");
  const auto words = ExerciseWords::read(folder_.path());
  ASSERT_TRUE(words) << describe(words.error());
  Exercise exercise;
  exercise.title.texts = {{"en", "Scan."}, {"pl", "Skan"}};
  exercise.goal.texts = {{"en", "Scan."}};
  exercise.steps.resize(1);
  exercise.steps[0].text.texts = {{"en", "Wait."}};
  words->addTo(exercise);
  EXPECT_EQ(exercise.title.in("pl"), "Skan") << "its own text stays";
  EXPECT_EQ(exercise.goal.in("pl"), "Zeskanuj.");
  EXPECT_EQ(exercise.steps[0].text.in("pl"), "Wait.");
  EXPECT_THAT(lossesOf(words->check({{exercise, "exercises/x.json"}})),
              ElementsAre("exercises/x.json /steps/0/text: no text in 'pl' for 'Wait.'",
                          "exercises (pl): no exercise says 'Go home.'"));
}

TEST_F(WordFiles, AddTextsToEveryVariantOfAnExercise) {
  write("pl/exercises.json", R"({"language": "pl", "exercises": {
    "Scan at ${resolution}.": "Zeskanuj z ${resolution}.", "Wait ${time} s.": "Czekaj."}})");
  const auto words = ExerciseWords::read(folder_.path());
  ASSERT_TRUE(words) << describe(words.error());
  const auto json = nlohmann::json::parse(R"({
    "id": "E99", "title": {"en": "Scan at ${resolution}."}, "goal": {"en": "Wait."},
    "devices": ["faro-focus"],
    "model": "house", "variants": {"resolution": {"choices": ["1/20", "1/16"]}},
    "rules": [{"id": "r", "text": {"en": "Wait ${resolution} s."}, "when": "end",
               "holds": "setups >= 1", "points": 1}]})");
  for (const auto* resolution : {"1/16", "1/20"}) {
    auto exercise = exerciseFrom(json, "x.json", {{"resolution", resolution}});
    ASSERT_TRUE(exercise) << describe(exercise.error());
    words->addTo(*exercise);
    EXPECT_EQ(exercise->title.in("pl"), std::string("Zeskanuj z ") + resolution + ".");
    EXPECT_THAT(lossesOf(words->check({{*exercise, "exercises/x.json"}})),
                ElementsAre("exercises/x.json /goal: no text in 'pl' for 'Wait.'",
                            "exercises/x.json /rules/0/text: no text in 'pl' for 'Wait ${resolution} s.'",
                            "exercises (pl): no exercise says 'Wait ${time} s.'",
                            "exercises (pl): 'Czekaj.' names other figures than 'Wait ${time} s.'"));
  }
}

// At rest, with scans, on the screen.
Device atRest(const std::shared_ptr<const DeviceType>& type, const std::string& screen) {
  const auto& phases = type->definition.phases;
  const auto rests =
      std::find_if(phases.begin(), phases.end(), [](const PhaseRow& phase) { return phase.on && !phase.ends(); });
  return working(type, *rests, screen);
}

std::pair<std::string, std::string> screenAndWidgetOfTheLanguage(const DeviceDefinition& definition) {
  for (const auto& screen : definition.screens)
    for (const auto& widget : screen.widgets)
      if (widget.value == "language") return {screen.id, widget.id};
  ADD_FAILURE() << definition.id << " has no setting of its language";
  return {};
}

class DeviceLanguages : public testing::TestWithParam<const EmulatedDevice*> {};

TEST_P(DeviceLanguages, AreSwitchedAtAnyTimeAndHoldOnEveryScreen) {
  const auto type = loadDevice(*GetParam());
  ASSERT_TRUE(type) << describe(type.error());
  const auto& words = *(*type)->words;
  const auto [page, switcher] = screenAndWidgetOfTheLanguage((*type)->definition);
  for (const auto& screen : (*type)->definition.screens) {
    auto device = atRest(*type, screen.id);
    for (const auto& language : words.languages()) {
      device.change().screen = page;
      const auto switched = device.act(switcher, language);
      ASSERT_TRUE(switched) << describe(switched.error());
      device.change().screen = screen.id;
      const auto shown = device.screen();
      EXPECT_EQ(device.value("language"), language);
      if (const auto title = words.text(GetParam()->id, screen.id, language); title.find('{') == std::string::npos) {
        EXPECT_EQ(shown.title, title) << screen.id;
      }
      for (const auto& widget : shown.widgets)
        EXPECT_EQ(widget.label.find_first_of("{}"), std::string::npos)
            << screen.id << '/' << widget.id << ": " << widget.label;
    }
  }
}

TEST_P(DeviceLanguages, AreOfferedByTheirOwnNames) {
  const auto type = loadDevice(*GetParam());
  ASSERT_TRUE(type) << describe(type.error());
  const auto [page, switcher] = screenAndWidgetOfTheLanguage((*type)->definition);
  const auto shown = atRest(*type, page).screen();
  std::set<std::string> names;
  for (const auto& option : findWidget(shown, switcher)->options) names.insert(option.label);
  EXPECT_THAT(names, testing::UnorderedElementsAre("English", "Deutsch", "Українська", "Polski", "Español", "Français",
                                                   "Italiano"));
}

INSTANTIATE_TEST_SUITE_P(All, DeviceLanguages, testing::ValuesIn(everyDevice()), deviceName);

TEST(Languages, CountAndWriteNumbersAsTheyDo) {
  TestDevice d("leica-rtc360");
  auto& state = d->change();
  for (const auto& [language, singular, plural] : {std::tuple{"pl", "i 1 pozycję?", "i 3 pozycje?"},
                                                   {"uk", "(1 станція)", "(3 станції)"},
                                                   {"it", "con 1 postazione?", "con 3 postazioni?"},
                                                   {"en", "its 1 setup from", "its 3 setups from"}}) {
    state.language = language;
    state.projects.assign(1, {});
    state.project = 0;
    state.projects[0].setups.assign(1, {});
    EXPECT_THAT(d->word("dialog.delete_job_question"), HasSubstr(singular));
    state.projects[0].setups.assign(3, {});
    EXPECT_THAT(d->word("dialog.delete_job_question"), HasSubstr(plural));
  }
  state.around.tilt_x_deg = 6.25;
  state.language = "fr";
  EXPECT_THAT(d->word("dialog.tilt_question"), HasSubstr("incliné de 6,250°"));
  state.language = "en";
  EXPECT_THAT(d->word("dialog.tilt_question"), HasSubstr("tilted by 6.250°"));
}

}  // namespace
}  // namespace standpoint
