// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/rehearsal.h"

#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/rehearsal/marks.h"
#include "emulated-ui/rehearsal/recorded_exercise.h"
#include "emulated-ui/sighting.h"
#include "tests/emulated-ui/marked.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

// A Focus that is on, at S1, with an open project and the coarsest settings.
json shortLesson() {
  return json::parse(R"({
    "id": "X1", "title": {"en": "Scan", "de": "Scannen"}, "goal": {"en": "Scan.", "de": "Scannen."},
      "devices": ["faro-focus"], "model": "house",
    "setup": [{"verb": "station", "options": {"add": "S1", "on": [4.3, 1.6, 0]}}],
    "start": [{"press": "power"}, {"wait": 130}, {"hand": "stand_at", "value": "S1"}, {"press": "manage"},
      {"press": "scan_projects"}, {"press": "new_project"},
              {"press": "name", "value": "House"}, {"press": "create"}, {"press": "parameters"},
                {"press": "resolution_quality"},
              {"press": "resolution", "value": "1/32"}, {"press": "back"}, {"press": "scan_area"}, {"press": "area",
                "value": "150,170,-5,5"}, {"press": "back"}, {"press": "back"}],
    "steps": [{"id": "scan", "text": {"en": "Scan.", "de": "Scannen."}, "done": "setups >= 1"},
              {"id": "look", "text": {"en": "Look.", "de": "Ansehen."}, "done": "setups.looked_at >= 1"}],
    "rules": [{"id": "level", "text": {"en": "Level.", "de": "Lotrecht."}, "when": "each scan_started",
      "holds": "tilt <= 2", "points": 1,
               "because": {"en": "The cloud leans.", "de": "Die Wolke ist schief."}, "proof": "expected.spacing"}]})");
}

class RehearsalTest : public testing::Test {
 protected:
  Exercise read(const json& text) {
    const auto file = folder_.path() / "x.json";
    std::ofstream(file) << text;
    auto exercise = readExercise(file);
    EXPECT_TRUE(exercise) << describe(exercise.error());
    return exercise.value_or(Exercise{});
  }
  std::unique_ptr<Rehearsal> start(const json& text) {
    auto rehearsal = Rehearsal::start(read(text), {}, folder_.path(), {}, quiet_);
    EXPECT_TRUE(rehearsal) << describe(rehearsal.error());
    return rehearsal ? *std::move(rehearsal) : nullptr;
  }
  std::string refusal(const json& text) {
    const auto rehearsal = Rehearsal::start(read(text), {}, folder_.path(), {}, quiet_);
    return rehearsal ? std::string() : describe(rehearsal.error());
  }
  Result<void> act(Rehearsal& rehearsal, const json& action) {
    return rehearsal.act(*actionFrom(action, "test", ""), quiet_);
  }

  TemporaryFolder folder_;
  Progress quiet_;
};

TEST_F(RehearsalTest, AStepThatIsDoneBeforeTheStudentComesIsRefusedByFileAndPlace) {
  auto text = shortLesson();
  text["steps"][0]["done"] = "power == on";
  EXPECT_THAT(refusal(text), HasSubstr("x.json /steps/0/done"));
  EXPECT_THAT(refusal(text), HasSubstr("'power == on' is true"));
}

// While it starts, the Focus is not yet at 1/32.
TEST_F(RehearsalTest, WhatHeldOnlyOnTheWayToTheStartIsNotDone) {
  auto text = shortLesson();
  text["steps"][0]["done"] = "setting.resolution != 1/32 and count.phase.booting == 0";
  const auto rehearsal = start(text);
  ASSERT_TRUE(rehearsal);
  EXPECT_FALSE(rehearsal->steps()[0].done);
  EXPECT_EQ(rehearsal->fact("count.pressed")->number, 0) << "what the start did is not counted";
}

TEST_F(RehearsalTest, ALaterStepThatHoldsAlreadyIsAWarningWhereTheOrderCountsAndRefusedWhereItDoesNot) {
  auto text = shortLesson();
  text["steps"][1]["done"] = "screen == home";  // the way back is a step of its own
  Report report;
  ASSERT_TRUE(checkStart(read(text), report, quiet_));
  ASSERT_EQ(report.issues.size(), 1U);
  EXPECT_EQ(report.issues[0].severity, Severity::warning);
  EXPECT_EQ(report.issues[0].source, "x.json /steps/1/done");
  text["in_order"] = false;
  EXPECT_THAT(refusal(text), HasSubstr("x.json /steps/1/done"));
}

TEST_F(RehearsalTest, WhatTheEnvironmentOrTheDeviceRefusesAtTheStartIsToldByFileAndPlace) {
  auto nowhere = shortLesson();
  nowhere["setup"][0]["options"]["on"] = {4000, 1.6, 0};
  EXPECT_THAT(refusal(nowhere), HasSubstr("x.json /setup/0/options"));
  auto wrong_page = shortLesson();
  wrong_page["start"].push_back({{"press", "create"}});
  EXPECT_THAT(refusal(wrong_page), HasSubstr("x.json /start/16"));
}

TEST_F(RehearsalTest, ARuleThatNothingAskedSaysSoAndClaimsNoConsequence) {
  const auto rehearsal = start(shortLesson());
  ASSERT_TRUE(rehearsal);
  const std::pair<const char*, const char*> kSaid[] = {{"en", "Not evaluated: no scan was started"},
                                                       {"de", "Nicht bewertet: kein Scan wurde gestartet"},
                                                       {"uk", "Не оцінено: жодного скану не розпочато"}};
  for (const auto& [language, said] : kSaid) {
    const auto marks = marked(*rehearsal, "", language);
    const auto& rule = marks.rules[0];
    EXPECT_EQ(rule.found, said);
    EXPECT_FALSE(rule.held);
    EXPECT_FALSE(rule.because);
    EXPECT_FALSE(rule.proof);
    EXPECT_THAT(marksText(marks), HasSubstr(said));
    EXPECT_THAT(marksHtml(marks, *rehearsal, "2026-05-04"), HasSubstr(said));
  }
}

TEST_F(RehearsalTest, ANumberThatIsTypedIsComparedAsOneAndHasItsUnitInTheMarks) {
  auto text = shortLesson();
  text["questions"] = json::parse(R"([{"id": "width", "text": {"en": "How wide?", "de": "Wie breit?"},
    "number": {"minimum": 0, "maximum": 5, "unit": "m"}}])");
  text["steps"][0]["done"] = "answer.width >= 0.85 and answer.width <= 0.95";
  const auto rehearsal = start(text);
  ASSERT_TRUE(rehearsal);
  EXPECT_FALSE(rehearsal->steps()[0].done);
  for (const char* wrong : {"9", "wide"}) {
    const auto refused = act(*rehearsal, {{"answer", "width"}, {"value", wrong}});
    ASSERT_FALSE(refused);
    EXPECT_THAT(describe(refused.error()), HasSubstr("is not a number from 0 to 5"));
  }
  EXPECT_FALSE(actionFrom({{"answer", "width"}, {"value", ""}}, "test", "")) << "nothing was typed";
  ASSERT_TRUE(act(*rehearsal, {{"answer", "width"}, {"value", "0.7"}}));
  EXPECT_FALSE(rehearsal->steps()[0].done);
  ASSERT_TRUE(act(*rehearsal, {{"answer", "width"}, {"value", "0.9"}}));
  EXPECT_TRUE(rehearsal->steps()[0].done);
  const auto marks = marked(*rehearsal);
  EXPECT_EQ(marks.answers[0].value, "0.9");
  EXPECT_EQ(marks.answers[0].answer, "0.9 m");
}

TEST_F(RehearsalTest, MarkingStopsWhenItIsCancelled) {
  const auto rehearsal = start(shortLesson());
  ASSERT_TRUE(rehearsal);
  Progress cancelled;
  cancelled.cancel();
  const auto marks = marksOf(*rehearsal, "", "en", cancelled);
  ASSERT_FALSE(marks);
  EXPECT_EQ(marks.error().kind, ErrorKind::cancelled);
}

TEST_F(RehearsalTest, ARuleThatWasAskedAndDidNotHoldSaysWhatItMeans) {
  auto text = shortLesson();
  text["rules"][0]["holds"] = "tilt > 2";
  const auto rehearsal = start(text);
  ASSERT_TRUE(rehearsal);
  ASSERT_TRUE(act(*rehearsal, {{"press", "start_scan"}}));
  const auto rule = marked(*rehearsal).rules[0];
  EXPECT_THAT(rule.found, HasSubstr("tilt = "));
  EXPECT_EQ(rule.because, "The cloud leans.");
  EXPECT_TRUE(rule.proof);
  ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
}

TEST_F(RehearsalTest, AFailedScanTellsItsReasonInTheMarks) {
  std::ofstream(folder_.path() / "scans") << "a file where the folder should be";
  const auto rehearsal = start(shortLesson());
  ASSERT_TRUE(rehearsal);
  ASSERT_TRUE(act(*rehearsal, {{"press", "start_scan"}}));
  ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
  const auto marks = marked(*rehearsal);
  ASSERT_EQ(marks.failures.size(), 1U);
  const auto& reason = marks.failures[0].reason;
  EXPECT_THAT(reason, HasSubstr("Cannot create"));
  EXPECT_THAT(marksText(marks), HasSubstr(reason));
  EXPECT_THAT(marksCsv(marks), HasSubstr("Cannot create"));
  EXPECT_THAT(marksHtml(marks, *rehearsal, "2026-05-04"), HasSubstr("Cannot create"));
}

TEST_F(RehearsalTest, AScanIsLookedAtWhenItsPictureIsThereNotWhenTheKeyIsPressed) {
  const auto rehearsal = start(shortLesson());
  ASSERT_TRUE(rehearsal);
  ASSERT_TRUE(act(*rehearsal, {{"press", "start_scan"}}));
  ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
  ASSERT_TRUE(rehearsal->steps()[0].done);
  ASSERT_TRUE(act(*rehearsal, {{"press", "look"}}));
  EXPECT_FALSE(rehearsal->steps()[1].done) << "there is no picture yet";
  ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
  EXPECT_NE(rehearsal->device().newestSetup()->preview, nullptr);
  EXPECT_TRUE(rehearsal->steps()[1].done);
}

TEST_F(RehearsalTest, TheCloudLeansByWhatNothingHasCompensated) {
  for (const auto& [inclinometer, lean_deg] : {std::pair{"off", 1.41418}, std::pair{"on", 0.0}}) {
    const auto rehearsal = start(shortLesson());
    ASSERT_NE(rehearsal, nullptr);
    for (const json& action :
         {json{{"hand", "tilt"}, {"value", "1,1"}}, json{{"press", "parameters"}}, json{{"press", "sensors"}},
          json{{"press", "inclinometer"}, {"value", inclinometer}}, json{{"press", "back"}}, json{{"press", "back"}},
          json{{"press", "start_scan"}}, json{{"finish", true}}})
      ASSERT_TRUE(act(*rehearsal, action)) << action;
    const auto tilt = rehearsal->fact("data.tilt");
    ASSERT_TRUE(tilt) << inclinometer;
    EXPECT_NEAR(tilt->number.value(), lean_deg, 0.01)
        << inclinometer << ": acos(cos 1 cos 1), or the sensor's 19 arc seconds";
  }
}

// B2 is stuck to the far side of the hall's wall: the fit finds the near side, 2.5 m off.
TEST_F(RehearsalTest, ATargetBehindAWallCannotBeSighted) {
  auto text = shortLesson();
  text["devices"] = {"leica-p-series"};
  text["setup"] = json::parse(R"([{"verb": "station", "options": {"add": "P1", "on": [3.5, 2.5, 0]}},
    {"verb": "target", "options": {"add": "B1", "on-surface": [0.5, 3.6, 1.5], "type": "bw-152"}},
    {"verb": "target", "options": {"add": "B2", "on-surface": [6.3, 2.5, 1.2], "type": "bw-152"}}])");
  text["start"] =
      json::parse(R"([{"hand": "stand_at", "value": "P1"}, {"press": "power"}, {"finish": true}, {"press": "manage"},
    {"press": "new_project"}, {"press": "name", "value": "House"}, {"press": "create"}, {"press": "scan_menu"},
      {"hand": "level"}])");
  const auto rehearsal = start(text);
  ASSERT_NE(rehearsal, nullptr);
  SightOrder order;
  order.instrument = "leica-p40", order.station = "P1", order.kind = "checkerboard";
  order.settings = rehearsal->device().state().settings;
  for (const auto& [target, found] : {std::pair{"B1", true}, std::pair{"B2", false}}) {
    order.target = target;
    const auto sighted = sightTarget(rehearsal->document(), order, folder_.path() / "sight.e57", 1, quiet_);
    ASSERT_TRUE(sighted) << describe(sighted.error());
    EXPECT_EQ(sighted->found, found) << sighted->why_not;
  }
}

TEST_F(RehearsalTest, WhatWasNeverMeasuredIsNotThere) {
  const auto rehearsal = start(shortLesson());
  ASSERT_NE(rehearsal, nullptr);
  for (const char* name :
       {"data.tilt", "targets.residual", "targets.error", "targets.points", "targets.distances", "links.error",
        "links.overlap", "links.wrong", "links.closure", "repeats.spread", "sights.residual", "sights.distances"})
    EXPECT_FALSE(rehearsal->fact(name)) << name;
}

TEST_F(RehearsalTest, AHeldRuleTellsWhatWasThereWhenItWasAsked) {
  const auto rehearsal = start(shortLesson());
  ASSERT_NE(rehearsal, nullptr);
  ASSERT_TRUE(act(*rehearsal, {{"hand", "tilt"}, {"value", "0.5,0"}}));
  ASSERT_TRUE(act(*rehearsal, {{"press", "start_scan"}}));
  ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
  ASSERT_TRUE(act(*rehearsal, {{"hand", "tilt"}, {"value", "4,0"}}));
  const auto rules = rehearsal->judge();
  EXPECT_TRUE(rules[0].held);
  EXPECT_EQ(rules[0].found, "tilt = 0.5");
}

// The proof is of the scan that the mistake was made in, whatever is scanned afterwards.
TEST_F(RehearsalTest, ABrokenRuleKeepsTheValuesItWasJudgedBy) {
  auto text = shortLesson();
  text["rules"][0]["because"]["en"] =
      "It leans by {data.tilt}; over 10 m that is {data.tilt / 57.2958 * 10000 : 0} mm, and {data.nothing} {";
  EXPECT_THAT(refusal(text), HasSubstr("/rules/0/because"));
  text["rules"][0]["because"]["en"] =
      "It leans by {data.tilt}; over 10 m that is {data.tilt / 57.2958 * 10000 : 0} mm.";
  text["rules"][0]["proof"] = "data.tilt";
  const auto rehearsal = start(text);
  ASSERT_NE(rehearsal, nullptr);
  const auto scan = [&](const char* tilt, bool asks) {
    ASSERT_TRUE(act(*rehearsal, {{"hand", "tilt"}, {"value", tilt}}));
    ASSERT_TRUE(act(*rehearsal, {{"press", "start_scan"}}));
    if (asks) (void)act(*rehearsal, {{"press", "continue"}});
    ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
    ASSERT_TRUE(act(*rehearsal, {{"press", "home"}}));
  };
  scan("5.5,0", true);
  ASSERT_EQ(rehearsal->fact("setups")->number, 1);
  const double leant = *rehearsal->fact("data.tilt")->number;
  EXPECT_NEAR(leant, 5.5, 0.1);
  scan("0.5,0", false);
  ASSERT_EQ(rehearsal->fact("setups")->number, 2);
  EXPECT_LT(*rehearsal->fact("data.tilt")->number, 0.1);
  const auto marks = marked(*rehearsal);
  const auto& rule = marks.rules[0];
  EXPECT_EQ(rule.found, "tilt = 5.5");
  ASSERT_TRUE(rule.proof);
  EXPECT_EQ(std::get<double>(rule.proof->value), leant);
  EXPECT_EQ(*rule.because,
            fmt::format("It leans by {:.3g}°; over 10 m that is {:.0f} mm.", leant, leant / 57.2958 * 10000));
}

TEST_F(RehearsalTest, EachStoredScanTellsWhatItWasMadeWith) {
  const auto rehearsal = start(shortLesson());
  ASSERT_NE(rehearsal, nullptr);
  EXPECT_FALSE(rehearsal->fact("newest.setting.resolution"));
  EXPECT_FALSE(rehearsal->fact("setup.1.points"));
  ASSERT_TRUE(act(*rehearsal, {{"press", "start_scan"}}));
  ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
  ASSERT_TRUE(act(*rehearsal, {{"press", "home"}}));
  for (const char* widget : {"parameters", "resolution_quality"}) ASSERT_TRUE(act(*rehearsal, {{"press", widget}}));
  ASSERT_TRUE(act(*rehearsal, {{"press", "resolution"}, {"value", "1/20"}}));
  EXPECT_EQ(rehearsal->fact("setting.resolution")->text, "1/20");
  EXPECT_EQ(rehearsal->fact("newest.setting.resolution")->text, "1/32") << "as it was scanned";
  EXPECT_EQ(rehearsal->fact("setup.1.setting.resolution")->text, "1/32");
  EXPECT_EQ(rehearsal->fact("setup.1.station")->text, "S1");
  EXPECT_EQ(rehearsal->fact("newest.points")->number, rehearsal->fact("data.points")->number);
  EXPECT_GT(*rehearsal->fact("newest.spacing")->number, *rehearsal->fact("expected.spacing")->number);
  EXPECT_FALSE(rehearsal->fact("setup.2.points"));
  auto asks = shortLesson();
  asks["steps"][0]["done"] = "newest.setting.resolution == 1/33";
  EXPECT_THAT(refusal(asks), HasSubstr("/steps/0/done"));
}

// A sector of the window wall is scanned; nothing of the floor is.
TEST_F(RehearsalTest, APartOfTheRoomTellsWhatOfItHasPoints) {
  auto text = shortLesson();
  text["parts"] = json::parse(R"({"all": {"box": [0, 0, 0, 9, 6, 3]}, "above": {"box": [0, 0, 2.2, 9, 6, 3]}})");
  text["steps"][1]["done"] = "part.all.seen > 2";
  EXPECT_THAT(refusal(text), HasSubstr("/steps/1/done")) << "a share is at most 1";
  text["steps"][1]["done"] = "part.all.points > 0";
  const auto rehearsal = start(text);
  ASSERT_NE(rehearsal, nullptr);
  EXPECT_EQ(*rehearsal->fact("part.all.seen")->number, 0);
  ASSERT_TRUE(act(*rehearsal, {{"press", "start_scan"}}));
  ASSERT_TRUE(act(*rehearsal, {{"finish", true}}));
  const auto figure = [&](const char* name) { return rehearsal->fact(name)->number.value_or(-1); };
  EXPECT_TRUE(rehearsal->steps()[1].done || rehearsal->steps()[0].done);
  EXPECT_GT(figure("part.all.points"), 20);
  EXPECT_GT(figure("part.all.seen"), 0);
  EXPECT_LT(figure("part.all.seen"), 0.5);
  EXPECT_GT(figure("part.all.spacing"), 5);
  EXPECT_GT(figure("part.all.hole"), 1);
  EXPECT_LT(figure("part.all.hole"), figure("part.all.area"));
  EXPECT_GT(figure("part.all.hole_x"), 0);
  EXPECT_EQ(figure("part.above.points"), 0) << "the window of 5 degrees ends below";
}

TEST_F(RehearsalTest, APartThatIsNotInTheModelIsRefusedByItsPlace) {
  const auto saysOf = [&](const char* part) {
    auto text = shortLesson();
    text["parts"] = {{"it", json::parse(part)}};
    return refusal(text);
  };
  EXPECT_THAT(saysOf(R"({"product": "West wal"})"),
              testing::AllOf(HasSubstr("/parts/it/product"), HasSubstr("the model has no product 'West wal'"),
                             HasSubstr("West wall")));
  EXPECT_THAT(saysOf(R"({"floor": "Cellar"})"),
              testing::AllOf(HasSubstr("/parts/it/floor"), HasSubstr("Ground floor")));
  EXPECT_THAT(saysOf(R"({"box": [0, 0, 500, 1, 1, 501]})"), HasSubstr("/parts/it/box"));
  EXPECT_THAT(saysOf(R"({"product": "West wall", "box": [20, 20, 0, 21, 21, 1]})"), HasSubstr("/parts/it/box"));
}

TEST_F(RehearsalTest, NobodyStandsAtAStationThatIsNotThere) {
  const auto rehearsal = start(shortLesson());
  ASSERT_TRUE(rehearsal);
  const auto moved = act(*rehearsal, {{"hand", "stand_at"}, {"value", "S2"}});
  ASSERT_FALSE(moved);
  EXPECT_THAT(describe(moved.error()), HasSubstr("did you mean 'S1'?"));
  EXPECT_EQ(rehearsal->fact("station")->text, "S1");
}

TEST_F(RehearsalTest, APressWithAValueCountsWithoutItToo) {
  const auto rehearsal = start(shortLesson());
  ASSERT_TRUE(rehearsal);
  for (const char* widget : {"parameters", "resolution_quality"}) ASSERT_TRUE(act(*rehearsal, {{"press", widget}}));
  ASSERT_TRUE(act(*rehearsal, {{"press", "resolution"}, {"value", "1/20"}}));
  EXPECT_EQ(rehearsal->fact("count.pressed.resolution_quality/resolution")->number, 1);
}

// A setting that is what it always is would be done before anybody comes.
TEST_F(RehearsalTest, ARecordedExerciseKeepsWhereItStoodAndWhatWasWaitedForAndIsPassedByItsOwnSolution) {
  const auto rehearsal = start(shortLesson());
  ASSERT_TRUE(rehearsal);
  const auto& settings = rehearsal->device().type().instrument.settings;
  const auto default_value =
      std::find_if(settings.begin(), settings.end(), [](const auto& s) { return s.key == "quality"; })->default_value;
  Recording recording(rehearsal->device(), rehearsal->document(), &rehearsal->exercise());
  const auto done = [&](const json& action) {
    ASSERT_TRUE(act(*rehearsal, action));
    const auto read = *actionFrom(action, "test", "");
    if (read.kind != RehearsalAction::Kind::wait && read.kind != RehearsalAction::Kind::finish)
      recording.note(read, rehearsal->device());
  };
  for (const char* widget : {"parameters", "resolution_quality"}) done({{"press", widget}});
  done({{"press", "resolution"}, {"value", "1/8"}});
  done({{"press", "quality"}, {"value", default_value}});
  for (const char* widget : {"back", "back"}) done({{"press", widget}});
  done({{"wait", 30}});
  done({{"press", "start_scan"}});
  done({{"finish", true}});
  done({{"press", "look"}});
  done({{"finish", true}});
  const auto demands = demandsOf(recording, rehearsal->device());
  std::vector<std::string> ids;
  for (const auto& demand : demands) ids.push_back(demand.row["id"]);
  EXPECT_THAT(ids, testing::ElementsAre("resolution", "scan", "whole", "level", "look"));
  EXPECT_EQ(demands[0].text, "Resolution: 1/8");
  const auto recorded = recordedExercise(recording, rehearsal->device(), demands, "R1");
  EXPECT_THAT(recorded["solution"], testing::Contains(json{{"wait", 30.0}}));
  EXPECT_THAT(recorded["solution"], testing::Contains(json{{"finish", true}}));
  EXPECT_EQ(recorded["setup"][0]["options"]["add"], "S1");
  const auto file = folder_.path() / "own" / "r1.json";
  const auto written = writeRecorded(recorded, {}, file, quiet_);
  ASSERT_TRUE(written) << describe(written.error());
  EXPECT_TRUE(std::filesystem::exists(file));
  auto wrong = recorded;
  wrong["steps"][1]["done"] = "setups >= 2";
  const auto refused = writeRecorded(wrong, {}, folder_.path() / "own" / "r2.json", quiet_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(describe(refused.error()), HasSubstr("steps not done: 'scan'")) << "it is not written";
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "own" / "r2.json"));
}

}  // namespace
}  // namespace standpoint
