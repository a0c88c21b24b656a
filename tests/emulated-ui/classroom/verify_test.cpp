// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulated-ui/classroom/class_exercise.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

std::string verdictOf(const std::filesystem::path& file) {
  const auto done = Classroom::verb("rehearse", {{"verify", file.string()}});
  if (!done) return describe(done.error());
  EXPECT_EQ(done->report.losses(), done->answer["verified"].get<bool>() ? 0U : 1U);
  return done->answer["verified"] ? "verified" : done->answer["why"].get<std::string>();
}

// A link of the chain made anew, as a forger would who knows the format.
void relink(json& r) {
  auto link = digestOf(std::string(kResultKind) + '\n' + r["assignment_hash"].get<std::string>() + '\n' +
                       r["exercise_hash"].get<std::string>() + '\n' + r["model"].get<std::string>() + '\n' +
                       r["program"].get<std::string>() + '\n' + r["student"].get<std::string>() + '\n' +
                       r["seed"].get<std::string>());
  for (auto& a : r["actions"]) {
    link = digestOf(link + '\n' + a["action"].get<std::string>() + '\n' + std::to_string(a["ms"].get<long>()) + '\n' +
                    a["state"].get<std::string>());
    a["hash"] = link;
  }
  r["head"] = link;
}

class Verify : public ::testing::Test {
 protected:
  Verify() : room(2), file(room.handIn("s-001", room.goodActions("s-001"))) {}
  std::string after(const std::function<void(json&)>& change, bool signed_anew) const {
    const auto copy = room.folder / "copy.result.json";
    std::filesystem::copy_file(file, copy, std::filesystem::copy_options::overwrite_existing);
    const auto key = *ownKey();
    Classroom::tamper(copy, change, signed_anew ? &key : nullptr);
    return verdictOf(copy);
  }

  Classroom room;
  std::filesystem::path file;
};

TEST_F(Verify, AResultAsItWasHandedInGivesItsMark) {
  const auto done = Classroom::verb("rehearse", {{"verify", file.string()}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer["verified"], true) << done->answer;
  EXPECT_EQ(done->answer["score"], 1);
  EXPECT_THAT(done->text, HasSubstr("verified, score 100 %, passed"));
}

TEST_F(Verify, NamesTheActionFromWhichAResultDoesNotReplay) {
  const auto change17 = [](json& r) { r["actions"][16]["action"] = R"({"hand":"tilt","value":"5,5"})"; };
  EXPECT_THAT(after(change17, false), HasSubstr("does not replay from action 17: the record was changed"));
  EXPECT_THAT(after(change17, true), HasSubstr("does not replay from action 17: the record was changed"));
  // With a new chain, too: the instrument is then another than recorded.
  const auto relinked = [&](json& r) { change17(r), relink(r); };
  EXPECT_THAT(after(relinked, true), HasSubstr("does not replay from action 17: the instrument is in another state"));
  // What no instrument would let anybody do.
  const auto impossible = [&](json& r) { r["actions"][4]["action"] = R"({"press":"no_such_key"})", relink(r); };
  EXPECT_THAT(after(impossible, true), HasSubstr("does not replay from action 5: the instrument refuses it"));
  const auto nonsense = [&](json& r) { r["actions"][4]["action"] = "{", relink(r); };
  EXPECT_THAT(after(nonsense, true), HasSubstr("does not replay from action 5"));
  const auto shorter = [](json& r) { r["actions"].erase(r["actions"].size() - 1); };
  EXPECT_THAT(after(shorter, true), HasSubstr("the end of the record was cut off"));
}

TEST_F(Verify, AMarkThatTheActionsDoNotGiveIsRefusedUnderAnySignature) {
  const auto poor = room.handIn("s-002", json::parse(R"([{"press": "power"}, {"wait": 20}])"));
  std::filesystem::copy_file(poor, file, std::filesystem::copy_options::overwrite_existing);
  const auto better = [](json& r) {
    r["score"] = 1, r["points"] = 4, r["passed"] = true;
    for (auto& c : r["criteria"]) c["held"] = true, c["points"] = c["of"];
  };
  EXPECT_THAT(after(better, false), HasSubstr("the result says 100 %, its actions give 25 %"));
  EXPECT_THAT(after(better, true), HasSubstr("the result says 100 %, its actions give 25 %"));
  EXPECT_THAT(after([](json& r) { r["hints"] = 3; }, true), HasSubstr("the result says"));
}

TEST_F(Verify, AnotherStudentVariantOrAssignmentIsRefused) {
  EXPECT_THAT(after([](json& r) { r["student"] = "s-099", relink(r); }, true), HasSubstr("no student 's-099'"));
  EXPECT_THAT(after([](json& r) { r["seed"] = "0000000000000000", relink(r); }, true), HasSubstr("has variant"));
  EXPECT_THAT(after([](json& r) { r["exercise"] = "E06"; }, true), HasSubstr("is a result of E06, not of C1"));
  EXPECT_THAT(after(
                  [](json& r) {
                    auto given = json::parse(r["assignment"].get<std::string>());
                    auto payload = json::parse(given["payload"].get<std::string>());
                    payload["exercise"]["pass_mark"] = 0;
                    given["payload"] = payload.dump();
                    r["assignment"] = given.dump();
                  },
                  true),
              HasSubstr("was changed after the lecturer signed it"));
}

TEST_F(Verify, EndsOnFilesThatAreNoResultsAndOnActionsWithoutEnd) {
  EXPECT_THAT(verdictOf(room.folder / "class.csv"), HasSubstr("class.csv"));
  EXPECT_THAT(verdictOf(room.folder / "C1.json"), HasSubstr("C1.json /format"));
  EXPECT_THAT(verdictOf(room.folder / "nowhere.json"), HasSubstr("cannot be read"));
  EXPECT_THAT(after([](json& r) { r["score"] = "high"; }, false), HasSubstr("/score"));
  const auto forever = [](json& r) {
    for (auto& a : r["actions"]) a["action"] = R"({"wait":86400})";
    relink(r);
  };
  EXPECT_THAT(after(forever, true), HasSubstr("it takes more than two days"));
}

TEST(RehearseResult, OfAnotherExerciseIsRefused) {
  const TemporaryFolder folder;
  const auto run = [&](const char* exercise, const std::string& actions, const char* out) {
    return Classroom::verb("rehearse",
                           {{"exercise", exercise}, {"actions", actions}, {"output", (folder / out).string()}});
  };
  const auto nothing = folder.write("nothing.json", "[]").string();
  ASSERT_TRUE(run("E03-X7", nothing, "a"));
  const auto result = (folder / "a/result.json").string();
  EXPECT_TRUE(run("E03-X7", result, "b"));
  const auto other = run("E02", result, "c");
  ASSERT_FALSE(other);
  EXPECT_EQ(describe(other.error()), "result.json /exercise: is a result of E03-X7, not of E02");
  auto json = *readJsonFile(result);
  json["exercise_hash"] = "0";
  folder.write("a/result.json", json.dump());
  const auto older = run("E03-X7", result, "d");
  ASSERT_TRUE(older);
  EXPECT_THAT(older->report.issues.front().message, HasSubstr("another version of E03-X7"));
}

}  // namespace
}  // namespace standpoint
