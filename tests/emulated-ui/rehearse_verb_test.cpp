// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/verbs/rehearse_verb.h"

#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "emulated-ui/menus.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Result<Outcome> rehearseVerb(const json& options) {
  Progress quiet;
  return runVerb(*findVerb(allVerbs(), "rehearse"), {}, options, quiet);
}

std::string shippedExercise(const char* name) { return (dataFolder() / "emulated-ui" / "exercises" / name).string(); }

std::string wholeText(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The example in the documentation, as a lecturer would copy it.
std::string documentedExample() {
  const auto text = wholeText(SOURCE_DIR "/docs/reference/exercises.md");
  const std::string fence = "```json\n";
  const auto from = text.find(fence);
  EXPECT_NE(from, std::string::npos);
  return from == std::string::npos
             ? ""
             : text.substr(from + fence.size(), text.find("```", from + fence.size()) - from - fence.size());
}

TEST(RehearseCheck, TellsOfSeveralFilesEachWhatIsWrongAndIsALossWhenOneIs) {
  const TemporaryFolder folder;
  const auto wrong = (folder.path() / "wrong.json").string(), no_json = (folder.path() / "no.json").string();
  auto text = json::parse(wholeText(shippedExercise("e03-spacing-x7.json")));
  text["steps"][0]["done"] = "screen == scan_pane";
  text["steps"][1]["widget"] = "mode_lists";
  std::ofstream(wrong) << text;
  std::ofstream(no_json) << "{";
  const auto checked = rehearseVerb({{"check", {wrong, shippedExercise("e03-spacing-x7.json"), no_json}}});
  ASSERT_TRUE(checked) << describe(checked.error());
  EXPECT_GT(checked->report.losses(), 0U);
  const auto& files = checked->answer["files"];
  EXPECT_FALSE(checked->answer["sound"].get<bool>());
  EXPECT_FALSE(files[0]["sound"].get<bool>());
  ASSERT_EQ(files[0]["findings"].size(), 2U) << "all of them, not the first";
  EXPECT_EQ(files[0]["findings"][0]["source"], "wrong.json /steps/0/done");
  EXPECT_EQ(files[0]["findings"][1]["source"], "wrong.json /steps/1/widget");
  EXPECT_TRUE(files[1]["sound"].get<bool>()) << files[1];
  EXPECT_EQ(files[1]["id"], "E03-X7");
  EXPECT_FALSE(files[2]["sound"].get<bool>());
  EXPECT_THAT(checked->text, HasSubstr("error: wrong.json /steps/0/done"));
}

TEST(RehearseCheck, StartsTheExercise) {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "x.json").string();
  auto text = json::parse(wholeText(shippedExercise("e03-spacing-x7.json")));
  text["steps"][0]["done"] = "power == on";
  std::ofstream(file) << text;
  const auto checked = rehearseVerb({{"check", {file}}});
  ASSERT_TRUE(checked) << describe(checked.error());
  EXPECT_EQ(checked->answer["files"][0]["findings"][0]["source"], "x.json /steps/0/done");
  EXPECT_GT(checked->report.losses(), 0U);
}

TEST(RehearseCheck, CarriesTheSolutionOutAndExpectsWhatTheAuthorSays) {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "x.json").string();
  const auto said = [&](const json& text) {
    std::ofstream(file) << text;
    const auto checked = rehearseVerb({{"check", {file}}});
    EXPECT_TRUE(checked) << describe(checked.error());
    return checked ? checked->answer["files"][0]["findings"].dump() : std::string();
  };
  const auto good = json::parse(wholeText(shippedExercise("e03-spacing-x7.json")));
  auto text = good;
  for (int i = 0; i < 2; ++i) text["solution"].erase(text["solution"].size() - 1);
  EXPECT_THAT(said(text), HasSubstr("x.json /solution"));
  EXPECT_THAT(said(text), HasSubstr("not passed"));
  text = good;
  text["expect"] = {{"score", 0.5}};
  EXPECT_THAT(said(text), HasSubstr("score 1, expected 0.5"));
  text["expect"] = {{"score", 1}};
  EXPECT_EQ(said(text), "[]");
  text.erase("solution");
  EXPECT_THAT(said(text), HasSubstr("no solution"));
}

TEST(RehearseCheck, OfSoundFilesOnlyIsNoLoss) {
  const auto checked = rehearseVerb({{"check", {shippedExercise("e19-walk.json")}}});
  ASSERT_TRUE(checked) << describe(checked.error());
  EXPECT_TRUE(checked->answer["sound"].get<bool>()) << checked->answer;
  EXPECT_EQ(checked->report.losses(), 0U);
}

TEST(RehearseCheck, GoesOnAfterAFileThatIsNotThere) {
  const auto good = (findDevice("leica-rtc360")->folder() / "tutorial.json").string();
  const auto checked = rehearseVerb({{"check", {"/nonexistent/x.json", good}}});
  ASSERT_TRUE(checked) << describe(checked.error());
  EXPECT_EQ(checked->report.losses(), 1U);
  EXPECT_EQ(checked->answer["files"][0]["findings"][0]["source"], "/nonexistent/x.json") << checked->answer;
  EXPECT_FALSE(checked->answer["files"][0]["sound"].get<bool>());
  EXPECT_TRUE(checked->answer["files"][1]["sound"].get<bool>());
}

TEST(Rehearse, ThatIsNotPassedIsALossWithTheReasonAndOneThatIsPassedIsNone) {
  const TemporaryFolder folder;
  const auto nothing = (folder.path() / "nothing.json").string();
  std::ofstream(nothing) << "[]";
  const auto out = (folder.path() / "out").string();
  const auto failed = rehearseVerb({{"exercise", "E03-X7"}, {"actions", nothing}, {"output", out}});
  ASSERT_TRUE(failed) << describe(failed.error());
  EXPECT_FALSE(failed->answer["passed"].get<bool>());
  ASSERT_EQ(failed->report.losses(), 1U);
  EXPECT_THAT(failed->report.issues.back().message, HasSubstr("not passed: "));
  EXPECT_THAT(failed->report.issues.back().message, HasSubstr("required: 'fine_enough'"));
  const auto passed = rehearseVerb({{"exercise", "E03-X7"}, {"solution", true}, {"output", out}});
  ASSERT_TRUE(passed) << describe(passed.error());
  EXPECT_TRUE(passed->answer["passed"].get<bool>());
  EXPECT_EQ(passed->report.losses(), 0U);
}

TEST(RehearseNames, ListsForEachDeviceWhatAnExerciseMayUse) {
  for (const auto& device : emulatedDevices()) {
    const auto names = rehearseVerb({{"names", true}, {"device", device.id}});
    ASSERT_TRUE(names) << describe(names.error());
    for (const char* list :
         {"settings", "screens", "dialogs", "phases", "facts", "hands", "troubles", "events", "keys"})
      EXPECT_FALSE(names->answer[list].empty()) << device.id << " " << list;
    for (const auto& [instrument, settings] : names->answer["settings"].items())
      for (const auto& [key, row] : settings.items()) EXPECT_THAT(names->text, HasSubstr(key)) << instrument;
  }
  const auto unknown = rehearseVerb({{"names", true}, {"device", "rtc360"}});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("did you mean 'leica-rtc360'?"));
}

TEST(RehearseDocs, HaveTheTableOfDevicesAsItIs) {
  const auto names = rehearseVerb({{"names", true}});
  ASSERT_TRUE(names) << describe(names.error());
  const auto docs = wholeText(SOURCE_DIR "/docs/reference/exercises.md");
  for (const auto& row : names->answer["devices"]) {
    const auto& start = row["start"];
    const auto listed = "| `" + row["id"].get<std::string>() + "` | `" + start["key"].get<std::string>() + "` | " +
                        std::to_string(std::lround(start["seconds"].get<double>())) + " s | `" +
                        start["screen"].get<std::string>() + "` |";
    EXPECT_TRUE(docs.find(listed) != std::string::npos) << "missing in docs/reference/exercises.md: " << listed;
  }
}

TEST(RehearseDocs, HaveAnExampleThatIsSoundAndIsPassedByItsSolution) {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "example.json").string();
  std::ofstream(file) << documentedExample();
  const auto checked = rehearseVerb({{"check", {file}}});
  ASSERT_TRUE(checked) << describe(checked.error());
  EXPECT_TRUE(checked->answer["files"][0]["findings"].empty()) << checked->text;
  const auto done =
      rehearseVerb({{"exercise", file}, {"solution", true}, {"output", (folder.path() / "out").string()}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer["score"], 1) << done->text;
  EXPECT_TRUE(done->report.issues.empty());
}

}  // namespace
}  // namespace standpoint
