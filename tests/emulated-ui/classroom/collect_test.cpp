// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/collect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/emulated-ui/classroom/class_exercise.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

json rowOf(const json& answer, const std::string& student) {
  for (const auto& row : answer["results"])
    if (row["student"] == student) return row;
  return {};
}

TEST(Collect, MarksAClassOfThirtyByReplayAndNamesTheTwoThatWereTamperedWith) {
  const Classroom room(30);
  for (std::size_t i = 1; i < 30; ++i) {
    const auto student = Classroom::id(i);
    auto actions = room.goodActions(student);
    if (i % 5 == 0) actions.erase(0);  // never levelled
    room.handIn(student, actions);
  }
  Classroom::tamper(room.folder / "results/C1-s-007.result.json",
                    [](json& result) { result["actions"][16]["action"] = R"({"wait":1})"; });
  Classroom::tamper(room.folder / "results/C1-s-010.result.json", [](json& result) { result["score"] = 1; });
  const auto done = room.collect();
  ASSERT_TRUE(done) << describe(done.error());
  const auto& answer = done->answer;
  EXPECT_EQ(answer["verified"], 27);
  EXPECT_EQ(answer["refused"], 2);
  EXPECT_EQ(answer["missing"], 1);
  EXPECT_EQ(rowOf(answer, "s-007")["from_action"], 17);
  EXPECT_THAT(rowOf(answer, "s-007")["why"].get<std::string>(), HasSubstr("does not replay from action 17"));
  EXPECT_EQ(rowOf(answer, "s-010")["verdict"], "other mark");
  EXPECT_THAT(rowOf(answer, "s-010")["why"].get<std::string>(), HasSubstr("its actions give 75 %"));
  EXPECT_EQ(rowOf(answer, "s-001")["score"], 1);
  EXPECT_EQ(rowOf(answer, "s-005")["score"], 0.75);
  EXPECT_EQ(rowOf(answer, "s-005")["passed"], false);
  EXPECT_EQ(answer["mistakes"], json({{"M03", 4}}));
  EXPECT_EQ(done->report.losses(), 2U);

  const auto& level = answer["criteria"][2];
  EXPECT_EQ(level["id"], "level");
  EXPECT_EQ(level["met"], 23);
  EXPECT_EQ(level["of"], 27);
  EXPECT_NEAR(level["facility"], 23.0 / 27, 1e-9);

  const auto moodle = room.text("table/moodle.csv");
  EXPECT_THAT(moodle, HasSubstr("username,C1,C1 feedback\r\nus-001,100.00,\"Passed"));
  EXPECT_THAT(moodle, HasSubstr("us-005,75.00,"));
  EXPECT_THAT(moodle, Not(HasSubstr("us-007")));
  EXPECT_THAT(moodle, Not(HasSubstr("us-010")));
  const auto page = room.text("table/table.html");
  EXPECT_THAT(page, HasSubstr("does not replay from action 17"));
  EXPECT_THAT(page, HasSubstr("nothing handed in"));
  EXPECT_THAT(page, Not(HasSubstr("Student 3"))) << "names stay away unless they are asked for";
  EXPECT_TRUE(std::filesystem::exists(room.folder / "table/marks/C1-s-001.mark.json"));
  EXPECT_FALSE(std::filesystem::exists(room.folder / "table/marks/C1-s-007.mark.json"));
}

TEST(Collect, RefusesAFriendsFileAFriendsActionsAnotherAssignmentAndAChangedDate) {
  const Classroom room(6), other(2);
  const auto mine = room.handIn("s-001", room.goodActions("s-001"));
  const auto key = *ownKey();
  // A friend's file under one's own name, signed anew.
  std::filesystem::copy(mine, room.folder / "results/copy.json");
  Classroom::tamper(
      room.folder / "results/copy.json", [](json& r) { r["student"] = "s-002"; }, &key);
  // Of an exercise that the student has signed himself.
  auto order = AssignmentOrder{
      classExercise(), "class", {{"s-003", "", "s-003", ""}}, "", {{1, {{"number", "one"}, {"lean", 3}}}}};
  const auto forged = assign(order, key);
  std::filesystem::copy(mine, room.folder / "results/forged.json");
  Classroom::tamper(
      room.folder / "results/forged.json",
      [&](json& r) {
        r["assignment"] = fileText(forged.seal);
        r["assignment_hash"] = forged.hash;
      },
      &key);
  // Only when it was finished.
  std::filesystem::copy(mine, room.folder / "results/late.json");
  Classroom::tamper(room.folder / "results/late.json", [](json& r) { r["finished"] = "2020-01-01T00:00:00Z"; });
  // Somebody who is not in the class.
  std::filesystem::copy(mine, room.folder / "results/stranger.json");
  Classroom::tamper(
      room.folder / "results/stranger.json", [](json& r) { r["student"] = "x-999"; }, &key);
  const auto done = room.collect();
  ASSERT_TRUE(done) << describe(done.error());
  std::map<std::string, std::string> verdicts;
  for (const auto& row : done->answer["results"]) verdicts[row["file"]] = row["verdict"];
  EXPECT_EQ(verdicts["C1-s-001.result.json"], "yes");
  EXPECT_THAT(verdicts["copy.json"], ::testing::AnyOf("changed", "other assignment"));
  EXPECT_EQ(verdicts["forged.json"], "other assignment");
  EXPECT_EQ(verdicts["late.json"], "bad signature");
  EXPECT_EQ(verdicts["stranger.json"], "unknown student");
}

TEST(Collect, OfAFriendsActionsOnOnesOwnVariantGivesAnotherMark) {
  const Classroom room(12);
  const auto friends = [&](const std::string& of) {
    for (std::size_t i = 2; i <= 12; ++i)
      if (room.numberOf(Classroom::id(i)) != room.numberOf(of)) return Classroom::id(i);
    return std::string();
  }("s-001");
  ASSERT_NE(friends, "");
  room.handIn("s-001", room.goodActions(friends));
  const auto done = room.collect();
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer["results"][0]["score"], 0.5);
  EXPECT_EQ(done->answer["results"][0]["passed"], false);
}

TEST(Collect, MarksLateResultsAndLeavesOtherFilesAlone) {
  const Classroom room(3, "2020-01-01T00:00Z");
  room.handIn("s-001", room.goodActions("s-001"), "results/Student 1_assignsubmission_file_");
  room.folder.write("results/notes.txt", "remember");
  room.folder.write("results/settings.json", "{}");
  room.folder.write("results/broken.json", R"({"format": "standpoint-result-1", "payload": )");
  room.folder.write("results/empty.json", "");
  const auto done = room.collect();
  ASSERT_TRUE(done) << describe(done.error());
  ASSERT_EQ(done->answer["results"].size(), 1U);
  EXPECT_EQ(done->answer["results"][0]["late"], true);
  EXPECT_EQ(done->answer["results"][0]["verified"], true);
  std::map<std::string, Severity> said;
  for (const auto& issue : done->report.issues) said[issue.source] = issue.severity;
  EXPECT_EQ(said["notes.txt"], Severity::note);
  EXPECT_EQ(said["settings.json"], Severity::note);
  EXPECT_EQ(said["broken.json"], Severity::warning);
  EXPECT_THAT(room.text("table/table.csv"), HasSubstr("\"yes, late\""));
}

TEST(Collect, CountsTheNewestResultOfAStudentAndTakesStatisticsOfTheFirst) {
  const Classroom room(2);
  auto poor = room.goodActions("s-001");
  poor.erase(0);
  const auto key = *ownKey();
  const auto first = room.handIn("s-001", poor, "results/a");
  Classroom::tamper(
      first, [](json& r) { r["finished"] = "2026-01-01T00:00:00Z"; }, &key);
  room.handIn("s-001", room.goodActions("s-001"), "results/b");
  const auto done = room.collect();
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(done->answer["results"][0]["counts"], false);
  EXPECT_EQ(done->answer["results"][1]["counts"], true);
  EXPECT_EQ(done->answer["results"][1]["score"], 1);
  EXPECT_EQ(done->answer["criteria"][2]["met"], 0);
  EXPECT_THAT(room.text("table/moodle.csv"), HasSubstr("us-001,100.00"));
}

TEST(Collect, AsksForTheKeyOfTheAssignmentAndForAFolder) {
  const Classroom room(1);
  std::filesystem::create_directories(room.folder / "results");
  const auto with = [&](const char* option, const std::string& value) {
    json options = {{"folder", room.path("results")},
                    {"assignment", room.path("C1.json")},
                    {"class", room.path("class.csv")},
                    {"key", room.path("class.key")},
                    {"output", room.path("t")}};
    options[option] = value;
    const auto done = Classroom::verb("collect", options);
    return done ? std::string("done") : describe(done.error());
  };
  EXPECT_EQ(with("folder", room.path("results")), "done");
  EXPECT_THAT(with("key", room.path("no.key")), HasSubstr("there is no such key"));
  EXPECT_THAT(with("folder", room.path("nowhere")), HasSubstr("is no folder"));
  EXPECT_THAT(with("assignment", room.path("class.csv")), HasSubstr("class.csv"));
  ASSERT_TRUE(SigningKey::make(room.folder / "other.key"));
  EXPECT_THAT(with("key", room.path("other.key")), HasSubstr("was signed with another key"));
  room.folder.write("bad.key", R"({"format": "standpoint-key-1", "secret": "AAAA", "public": "x"})");
  EXPECT_THAT(with("key", room.path("bad.key")), HasSubstr("bad.key /secret"));
}

}  // namespace
}  // namespace standpoint
