// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "core/json_file.h"
#include "emulated-ui/menus.h"
#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/rehearsal.h"
#include "project/verb.h"
#include "tests/emulated-ui/marked.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using Actions = std::vector<RehearsalAction>;
using Kind = RehearsalAction::Kind;

const std::vector<KnownExercise>& shipped() {
  static const auto all = [] {
    auto known = knownExercises();
    for (const auto& error : known.refused) ADD_FAILURE() << describe(error);
    return known.readable;
  }();
  return all;
}

const Exercise& exercise(const std::string& id) {
  for (const auto& known : shipped())
    if (known.exercise.id == id) return known.exercise;
  ADD_FAILURE() << "there is no " << id;
  return shipped().front().exercise;
}

// What came of it when `actions` were done; what the device refuses is left out, as a student would go on.
struct CarriedOut {
  Marks marks;
  std::map<std::string, double> facts;
  std::vector<std::string> refused;
  Marks marks_before;  // when all was prepared and nothing done yet
};
CarriedOut rehearse(const Exercise& exercise, const Actions& actions, const std::vector<std::string>& facts = {}) {
  TemporaryFolder folder;
  Progress quiet;
  auto rehearsal = Rehearsal::start(exercise, {}, folder.path(), {}, quiet);
  EXPECT_TRUE(rehearsal) << describe(rehearsal.error());
  if (!rehearsal) return {};
  CarriedOut outcome;
  outcome.marks_before = marked(**rehearsal);
  for (const auto& action : actions)
    if (auto done = (*rehearsal)->act(action, quiet); !done)
      outcome.refused.push_back(toJson(action).dump() + ": " + describe(done.error()));
  outcome.marks = marked(**rehearsal);
  for (const auto& name : facts)
    if (const auto fact = (*rehearsal)->fact(name); fact && fact->number) outcome.facts[name] = *fact->number;
  return outcome;
}

// The exercise's own solution, with the facts that prove its rules; carried out once.
const CarriedOut& solved(const std::string& id) {
  static std::map<std::string, CarriedOut> outcomes;
  const auto known = outcomes.find(id);
  if (known != outcomes.end()) return known->second;
  const auto& e = exercise(id);
  std::vector<std::string> proofs;
  for (const auto& rule : e.rules)
    if (!rule.proof.empty()) proofs.push_back(rule.proof);
  return outcomes.emplace(id, rehearse(e, e.solution, proofs)).first->second;
}

std::string lines(const std::vector<std::string>& rows) {
  std::string text;
  for (const auto& row : rows) text += "\n" + row;
  return text;
}

bool held(const CarriedOut& outcome, const std::string& rule) {
  for (const auto& row : outcome.marks.rules)
    if (row.id == rule) return row.held;
  ADD_FAILURE() << "there is no rule " << rule;
  return true;
}

class ShippedExercise : public testing::TestWithParam<std::string> {};

TEST_P(ShippedExercise, IsSoundAndSpeaksSevenLanguages) {
  const auto& e = exercise(GetParam());
  for (const auto& fault : checkExercise(e)) ADD_FAILURE() << describe(fault);
  for (const char* language : {"en", "de", "uk", "es", "fr", "it", "pl"})
    EXPECT_TRUE(e.title.texts.contains(language)) << language;
  for (const auto& rule : e.rules)
    for (const auto* said : {&rule.because, &rule.cost})
      EXPECT_EQ(said->texts.size(), 7U) << rule.id << ": why it matters, and what it costs";
  EXPECT_FALSE(e.solution.empty());
  EXPECT_FALSE(e.source.empty());
}

TEST_P(ShippedExercise, GivesAllPointsForItsOwnSolutionAndIsNotPassedByDoingNothing) {
  const auto& outcome = solved(GetParam());
  ASSERT_FALSE(outcome.marks_before.exercise.empty());
  EXPECT_FALSE(outcome.marks_before.passed) << marksText(outcome.marks_before);
  EXPECT_TRUE(outcome.refused.empty()) << lines(outcome.refused);
  EXPECT_TRUE(outcome.marks.passed) << marksText(outcome.marks);
  EXPECT_DOUBLE_EQ(outcome.marks.score, 1) << marksText(outcome.marks);
}

// Every label that somebody sees on the exercise's devices, and what is written on the hands.
std::set<std::string> labelsOf(const Exercise& e, const std::string& language) {
  std::set<std::string> labels;
  for (const auto& row : emulatedDevices()) {
    if (!isFor(e, row.id)) continue;
    const auto type = loadDevice(row, e.instrument);
    EXPECT_TRUE(type) << describe(type.error());
    if (!type) continue;
    const auto& d = (*type)->definition;
    const auto take = [&](const std::string& key) {
      if ((*type)->words->has(d.id, key, "en")) labels.insert((*type)->words->text(d.id, key, language));
    };
    for (const auto& key : d.keys) take(key.words);
    for (const auto& screen : d.screens)
      for (const auto& w : screen.widgets) take(w.words);
    for (const auto& dialog : d.dialogs)
      for (const auto& button : dialog.buttons) take(button.id);
    for (const auto& setting : (*type)->instrument.settings)
      for (const auto& choice : setting.choices) {
        take(setting.key + "=" + choice.value);
        if (!(*type)->words->has(d.id, setting.key + "=" + choice.value, "en")) labels.insert(choice.label);
      }
    for (const auto& setting : (*type)->instrument.settings)
      if (!(*type)->words->has(d.id, setting.key, "en")) labels.insert(setting.label);
    for (const auto& value : d.values)
      for (const auto& choice : value.choices) take(value.id + "=" + choice);
    for (const char* key : {"on", "off"}) take(key);
    for (const auto& hand : handRows()) take(std::string("hand.") + hand.id);
  }
  return labels;
}

// 'so', „so“ or «so»; an apostrophe within a word opens nothing.
std::vector<std::string> quotedIn(const std::string& text, const std::string& language) {
  static const std::map<std::string, std::regex> kQuotes = {{"en", std::regex("(?:^|[^A-Za-z])'([^']+)'(?![A-Za-z])")},
                                                            {"de", std::regex("„([^“]+)“")},
                                                            {"uk", std::regex("«([^»]+)»")},
                                                            {"es", std::regex("«([^»]+)»")},
                                                            {"fr", std::regex("«\u00a0([^»]+)\u00a0»")},
                                                            {"it", std::regex("«([^»]+)»")},
                                                            {"pl", std::regex("„([^”]+)”")}};
  std::vector<std::string> found;
  const auto& quotes = kQuotes.at(language);
  for (auto at = std::sregex_iterator(text.begin(), text.end(), quotes); at != std::sregex_iterator(); ++at)
    found.push_back((*at)[1]);
  return found;
}

TEST_P(ShippedExercise, QuotesOnlyLabelsThatStandOnTheDeviceOrNamesThatItAsksFor) {
  const auto& e = exercise(GetParam());
  for (const auto& [language, title] : e.title.texts) {
    const auto labels = labelsOf(e, language);
    for (const auto& step : e.steps)
      for (const auto* text : {&step.text, &step.hint})
        for (const auto& quoted : quotedIn(text->in(language), language))
          EXPECT_TRUE(labels.contains(quoted) || step.done.text().find(quoted) != std::string::npos)
              << step.id << " (" << language << "): '" << quoted << "' stands nowhere on the device";
  }
}

TEST(ShippedExercises, HaveTheTutorialsBeforeAllOthersAndOneForEachDevice) {
  const auto& all = shipped();
  const auto first_other =
      std::find_if(all.begin(), all.end(), [](const KnownExercise& k) { return !k.exercise.tutorial; });
  EXPECT_TRUE(std::none_of(first_other, all.end(), [](const KnownExercise& k) { return k.exercise.tutorial; }));
  for (const auto& device : emulatedDevices())
    EXPECT_TRUE(std::any_of(all.begin(), first_other, [&](const KnownExercise& k) {
      return isFor(k.exercise, device.id);
    })) << device.id;
}

// "E03-X7" is E03 for another device.
TEST(ShippedExercises, AreEachInATopicOfTheGuideForLecturers) {
  std::ifstream in(SOURCE_DIR "/docs/guide/lecturer.md");
  const std::string guide{std::istreambuf_iterator<char>(in), {}};
  for (const auto& [e, file] : shipped()) {
    const std::regex listed("\\| [^\n]*\\b" + e.id.substr(0, e.id.find('-')) + "\\b[^\n]*\\|\n");
    EXPECT_TRUE(e.tutorial || std::regex_search(guide, listed))
        << "missing: " << e.id << " in the table of topics of docs/guide/lecturer.md";
  }
}

// As their files have them: each test is a process of its own, and to read all exercises with their devices takes a
// second.
std::vector<std::string> ids() {
  const std::filesystem::path folder = SOURCE_DIR "/emulated-ui";
  std::vector<std::filesystem::path> files;
  for (const auto& file : std::filesystem::directory_iterator(folder / "exercises"))
    if (file.path().extension() == ".json") files.push_back(file.path());
  for (const auto& device : std::filesystem::directory_iterator(folder / "devices"))
    if (const auto file = device.path() / "tutorial.json"; std::filesystem::exists(file)) files.push_back(file);
  std::vector<std::string> all;
  for (const auto& file : files)
    if (const auto json = readJsonFile(file)) all.push_back(json->value("id", file.filename().string()));
  std::sort(all.begin(), all.end());
  return all;
}

TEST(ShippedExercises, AreEachTriedByTheirOwnSolution) {
  std::vector<std::string> all;
  for (const auto& known : shipped()) all.push_back(known.exercise.id);
  std::sort(all.begin(), all.end());
  EXPECT_EQ(ids(), all);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedExercise, testing::ValuesIn(ids()),
                         [](const testing::TestParamInfo<std::string>& known) {
                           std::string name = known.param;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
                           return name;
                         });

// A solution with a beginner's mistake in it.
class Mistaken {
 public:
  explicit Mistaken(const std::string& id) : exercise_(exercise(id)), actions_(exercise_.solution) {}
  Mistaken& without(const std::string& name, const std::string& value = {}) {
    const auto before = actions_.size();
    std::erase_if(actions_,
                  [&](const RehearsalAction& a) { return a.name == name && (value.empty() || a.value == value); });
    EXPECT_LT(actions_.size(), before) << name;
    return *this;
  }
  Mistaken& with(const std::string& name, const std::string& value) {
    bool found = false;
    for (auto& a : actions_)
      if (a.name == name) a.value = value, found = true;
    EXPECT_TRUE(found) << name;
    return *this;
  }
  Mistaken& pressInstead(const std::string& name, const std::string& other) {
    for (auto& a : actions_)
      if (a.name == name) a.name = other;
    return *this;
  }
  Mistaken& after(const std::string& name, const RehearsalAction& more) {
    const auto at =
        std::find_if(actions_.begin(), actions_.end(), [&](const RehearsalAction& a) { return a.name == name; });
    EXPECT_NE(at, actions_.end()) << name;
    if (at != actions_.end()) actions_.insert(at + 1, more);
    return *this;
  }
  // Without all that comes after so many links.
  Mistaken& untilLink(int count) {
    auto at = actions_.begin();
    for (; at != actions_.end() && count > 0; ++at) count -= at->name == "link_now" ? 1 : 0;
    EXPECT_EQ(count, 0);
    if (at != actions_.end()) ++at;  // "finish"
    actions_.erase(at, actions_.end());
    return *this;
  }
  // Without waiting for the last scan: what is asked when it starts is known.
  Mistaken& untilLastScan() {
    EXPECT_EQ(actions_.back().kind, Kind::finish);
    actions_.pop_back();
    return *this;
  }
  Mistaken& edit(const std::function<void(RehearsalAction&)>& change) {
    std::for_each(actions_.begin(), actions_.end(), change);
    return *this;
  }
  CarriedOut outcome(const std::vector<std::string>& facts) const { return rehearse(exercise_, actions_, facts); }

 private:
  const Exercise& exercise_;
  Actions actions_;
};

RehearsalAction press(const std::string& name) { return {Kind::press, name, {}, 0, {}}; }

// Twice the white noise; what the surfaces and the mirror add stays as it is.
TEST(Mistake, DustOnTheOpticsShowsInTheNoise) {
  const auto& clean = solved("E01");
  const auto dusty = Mistaken("E01").without("wipe_optics").outcome({"data.noise"});
  EXPECT_FALSE(held(dusty, "optics"));
  EXPECT_GT(dusty.facts.at("data.noise"), 1.15 * clean.facts.at("data.noise"));
}

TEST(Mistake, AScanInTheOldJobLosesTheExercise) {
  const auto outcome =
      Mistaken("E02").without("create").without("first").without("name").without("new_job").without("job").outcome({});
  EXPECT_FALSE(held(outcome, "right_job"));
  EXPECT_FALSE(outcome.marks.passed);
}

TEST(Mistake, TheFinestResolutionGivesSixteenTimesThePoints) {
  const auto& right = solved("E03");
  const auto fine = Mistaken("E03").with("resolution", "1/1").outcome({"data.points"});
  EXPECT_FALSE(held(fine, "not_finer"));
  EXPECT_NEAR(fine.facts.at("data.points") / right.facts.at("data.points"), 16, 0.5);
}

TEST(Mistake, TheLowestQualityIsNoisier) {
  const auto& right = solved("E04");
  const auto fast = Mistaken("E04").with("quality", "1x").outcome({"data.noise"});
  EXPECT_FALSE(held(fast, "noise"));
  EXPECT_GT(fast.facts.at("data.noise"), 1.2 * right.facts.at("data.noise"));
}

TEST(Mistake, AnUnlevelledScanLeans) {
  const auto outcome = Mistaken("E05").without("level").after("start_scan", press("continue")).outcome({"data.tilt"});
  EXPECT_FALSE(held(outcome, "levelled"));
  EXPECT_FALSE(held(outcome, "plumb"));
  EXPECT_NEAR(outcome.facts.at("data.tilt"), 5.829, 0.01) << "acos(cos 5.4 cos 2.2)";
}

TEST(Mistake, AWalkDownThePathIsNotRoundTheHouse) {
  const auto way = nlohmann::json::parse(
      "[[7.5, 3, 0], [7.5, 1, 5], [7.5, -2, 13], [7.5, -6, 23], [7.5, -2, 33], [7.5, 1, 41], [7.5, 3, 46]]");
  const auto outcome = Mistaken("E19")
                           .edit([&](RehearsalAction& a) {
                             if (a.kind == Kind::walk) a.options = way;
                           })
                           .outcome({"walk.length"});
  EXPECT_NEAR(outcome.facts.at("walk.length"), 18, 1e-6) << "as it was walked";
  for (const auto& step : outcome.marks.steps)
    if (step.id == "walk" || step.id == "length") {
      EXPECT_EQ(step.done, step.id == "walk") << step.id;
    }
}

// What is held against the truth: the same walk too fast turns red, and one that does not come back closes nothing.
TEST(Mistake, AHurriedWalkTurnsRed) {
  const auto hurried = rehearse(exercise("E25"), exercise("E25").mistakes.front().actions, {"walk.speed"});
  EXPECT_FALSE(held(hurried, "light"));
  EXPECT_FALSE(hurried.marks.passed);
  EXPECT_GT(hurried.facts.at("walk.speed"), 1.3);
}

TEST(Mistake, AStationFarFromTheDoorJoinsNoRooms) {
  const auto outcome = Mistaken("E07")
                           .edit([](RehearsalAction& a) {
                             if (a.kind == Kind::verb) a.options["on"] = {1.6, 2.4, 0.0};
                           })
                           .outcome({"plan.overlap", "place.door"});
  EXPECT_FALSE(held(outcome, "door"));
  EXPECT_FALSE(held(outcome, "overlap"));
  EXPECT_LT(outcome.facts.at("plan.overlap"), 0.3);
}

TEST(Mistake, SpheresInOneLineHaveNoWidth) {
  int n = 0;
  const auto outcome = Mistaken("E08")
                           .edit([&](RehearsalAction& a) {
                             if (a.kind == Kind::verb)
                               a.options["on"] = {2.0 + 0.8 * n, 3.2, 0.0}, a.options["height"] = 1.4, ++n;
                           })
                           .outcome({"targets.width", "targets.heights"});
  EXPECT_FALSE(held(outcome, "line"));
  EXPECT_FALSE(held(outcome, "heights"));
  EXPECT_LT(outcome.facts.at("targets.width"), 0.01);
}

TEST(Mistake, TooCoarseAScanLeavesTooFewPointsOnTheSpheres) {
  const auto outcome = Mistaken("E09").with("resolution", "1/32").outcome({"newest.sampled"});
  EXPECT_FALSE(held(outcome, "sampled"));
  EXPECT_LT(outcome.facts.at("newest.sampled"), 60);
}

TEST(Mistake, ASingleScanKeepsWhoeverWalkedBy) {
  const auto outcome = Mistaken("E12").with("double_scan", "off").outcome({"data.moving"});
  EXPECT_FALSE(held(outcome, "double"));
  EXPECT_FALSE(held(outcome, "clean"));
  EXPECT_GT(outcome.facts.at("data.moving"), 0.01);
}

TEST(Mistake, WhoStaysInViewIsInTheCloud) {
  const auto outcome =
      Mistaken("E05").after("level", {Kind::hand, "stand_in_view", {}, 0, {}}).outcome({"data.moving"});
  EXPECT_GT(outcome.facts.at("data.moving"), 0.01);
}

TEST(Mistake, ConfusedTargetNamesSpoilTheDistancesBetweenThem) {
  const auto& right = solved("E13");
  EXPECT_LT(right.facts.at("sights.distances"), 10);
  const std::map<std::string, std::string> swapped = {{"T1", "T3"}, {"T2", "T2"}, {"T3", "T1"}, {"T4", "T4"}};
  Actions actions;
  for (const auto& action : exercise("E13").solution) {
    actions.push_back(action);
    if (action.name != "view_list") continue;
    actions.push_back(press("target_id"));
    actions.back().value = swapped.at(action.value);
  }
  const auto wrong = rehearse(exercise("E13"), actions, {"sights.distances"});
  EXPECT_FALSE(held(wrong, "ids"));
  EXPECT_GT(wrong.facts.at("sights.distances"), 100);
}

// The same height at all spheres leaves no residual, and the whole cloud 180 mm too low.
TEST(Mistake, AWrongTargetHeightFailsTheResectionThoughItsResidualsAreSmall) {
  Actions actions;
  for (const auto& action : exercise("E14").solution) {
    actions.push_back(action);
    if (action.name != "view_list") continue;
    actions.push_back(press("target_height"));
    actions.back().value = "0.18";
  }
  const auto wrong = rehearse(exercise("E14"), actions, {"newest.height"});
  EXPECT_TRUE(held(wrong, "residual"));
  EXPECT_NEAR(wrong.facts.at("newest.height"), 180, 5);
  EXPECT_FALSE(held(wrong, "delivered"));
  EXPECT_FALSE(wrong.marks.passed) << "score " << wrong.marks.score;
  EXPECT_NE(std::find(wrong.marks.must_broken.begin(), wrong.marks.must_broken.end(), "delivered"),
            wrong.marks.must_broken.end());
}

TEST(Mistake, AScanOfAMovedTripodIsBesideItsPlace) {
  const auto outcome = Mistaken("E23").pressInstead("discard", "keep").outcome({"data.error"});
  EXPECT_FALSE(held(outcome, "no_moved"));
}

TEST(Mistake, FormattingBeforeTheCopyLosesTheScans) {
  const auto outcome = Mistaken("E21").without("by_cable").outcome({"office.copies"});
  EXPECT_FALSE(held(outcome, "first_copy"));
  EXPECT_FALSE(held(outcome, "sizes"));
}

// From the living room straight into the kitchen: the link is refused, or rests on too little.
TEST(Mistake, AChainWithoutTheDoorIsTooWeak) {
  const auto outcome =
      Mistaken("E17").with("stand_at", "Kitchen").untilLink(1).outcome({"links.overlap", "links.joined"});
  EXPECT_FALSE(held(outcome, "overlap"));
  EXPECT_TRUE(outcome.facts.at("links.joined") == 0 || outcome.facts.at("links.overlap") < 0.3);
}

TEST(Mistake, ColourInTheDarkStoreTakesTimeForNothing) {
  const auto outcome = Mistaken("E11").with("images", "on").untilLastScan().outcome({"count.scan_started"});
  EXPECT_FALSE(held(outcome, "right"));
  EXPECT_EQ(outcome.facts.at("count.scan_started"), 2);
}

// The device says "registered": only the truth, and a look at the walls, tell that the room stands the wrong way round.
TEST(Mistake, ALinkThatIsTurnedRoundIsTakenWithoutALook) {
  const auto outcome = Mistaken("E16").without("refine").outcome({"links.wrong", "links.error"});
  EXPECT_FALSE(held(outcome, "no_wrong"));
  EXPECT_EQ(outcome.facts.at("links.wrong"), 1);
  EXPECT_GT(outcome.facts.at("links.error"), 500);
}

// E16 with the cloud laid by hand as its ring has it, instead of a number that is typed.
CarriedOut laidInE16(const std::string& laid) {
  return Mistaken("E16")
      .edit([&](RehearsalAction& a) {
        if (a.name == "turn") a = {Kind::press, "plan", laid, 0, {}, Gesture::lay};
      })
      .outcome({"links.wrong", "links.error", "links.joined"});
}

TEST(LaidByHand, ARingThatTurnsTheRoomRoundSolvesItAsTheTypedNumberDoes) {
  const auto outcome = laidInE16("0.3,-0.2,177");
  EXPECT_TRUE(outcome.marks.passed);
  EXPECT_EQ(outcome.facts.at("links.wrong"), 0);
  EXPECT_LT(outcome.facts.at("links.error"), 5) << "the fit refines what was laid roughly";
}

// Metres beside its place there are other walls, or none: no link, or a wrong one, as in the field.
TEST(LaidByHand, TooFarFromItsPlaceTheFitFailsOrIsWrong) {
  for (const char* laid : {"0,0,60", "6,4,180"}) {
    const auto outcome = laidInE16(laid);
    EXPECT_FALSE(outcome.marks.passed) << laid;
    EXPECT_TRUE(outcome.facts.at("links.joined") == 0 || outcome.facts.at("links.error") > 100) << laid;
  }
}

// The way of a handheld scanner is planned, and judged, as an action like others.
RehearsalAction walk(const nlohmann::json& way) {
  const auto action = actionFrom({{"walk", way}}, "test", "");
  EXPECT_TRUE(action) << describe(action.error());
  return action.value_or(RehearsalAction{});
}

TEST(Walk, IsAnActionThatReplays) {
  const auto way = nlohmann::json::parse("[[0, 0, 0], [3, 4, 10], [0, 0, 20]]");
  const auto action = walk(way);
  EXPECT_EQ(action.kind, Kind::walk);
  EXPECT_EQ(toJson(action), (nlohmann::json{{"walk", way}}));
  for (const char* wrong :
       {"[[0, 0, 0]]", "[[0, 0, 0], [1, 1]]", "[[0, 0, 5], [1, 1, 5]]", "[[0, 0, 0], [1, \"1\", 5]]", "7", "[]"})
    EXPECT_FALSE(actionFrom({{"walk", nlohmann::json::parse(wrong)}}, "test", "")) << wrong;
}

TEST(Walk, TellsLengthClosureAndSpeedAndTheLastOneCounts) {
  const std::vector<std::string> kWalkFacts = {"walk.length",     "walk.closure", "walk.speed",
                                               "walk.door_speed", "walk.drift",   "count.field.walk"};
  const auto open = rehearse(exercise("E19"), {walk({{0, 0, 0}, {30, 40, 100}})}, kWalkFacts);
  EXPECT_NEAR(open.facts.at("walk.length"), 50, 1e-9);
  EXPECT_NEAR(open.facts.at("walk.closure"), 50, 1e-9);
  EXPECT_NEAR(open.facts.at("walk.speed"), 0.5, 1e-9);
  EXPECT_FALSE(held(open, "closed"));
  const auto both = rehearse(
      exercise("E19"), {walk({{0, 0, 0}, {30, 40, 100}}), walk({{0, 0, 0}, {30, 40, 25}, {0, 0, 50}})}, kWalkFacts);
  EXPECT_EQ(both.facts.at("count.field.walk"), 2);
  EXPECT_NEAR(both.facts.at("walk.length"), 100, 1e-9) << "of the walk that was planned last";
  EXPECT_NEAR(both.facts.at("walk.closure"), 0, 1e-9);
  EXPECT_NEAR(both.facts.at("walk.speed"), 2, 1e-9);
  EXPECT_TRUE(held(both, "closed"));
  EXPECT_FALSE(held(both, "speed"));
}

}  // namespace
}  // namespace standpoint
