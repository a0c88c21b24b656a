// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/classroom/assignment.h"

#include <functional>
#include <set>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emulated-ui/classroom/variant_check.h"
#include "tests/emulated-ui/classroom/class_exercise.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Assign, GivesOneFileWithoutSolutionNamesOrIds) {
  const Classroom room(12);
  const auto text = room.text("C1.json");
  for (const char* secret : {"solution", "mistakes", "Student 1", "s-001", "us-001"})
    EXPECT_THAT(text, Not(HasSubstr(secret)));
  EXPECT_EQ(room.assignment.students.size(), 12U);
  EXPECT_EQ(room.assignment.deadline, "2099-01-01T00:00:00Z");
  std::set<std::string> numbers;
  for (std::size_t i = 1; i <= 12; ++i) numbers.insert(room.numberOf(Classroom::id(i)));
  EXPECT_GT(numbers.size(), 1U) << "students get other variants";
  struct stat about {};
  ASSERT_EQ(stat(room.path("class.key").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0600U);
}

TEST(Assign, AgainGivesTheSameVariantsAndAddingAStudentChangesNobodyElses) {
  const Classroom room(4);
  const auto again = [&](const char* output) {
    const auto done = Classroom::verb("assign", {{"exercise", room.path("exercise.json")},
                                                 {"class", room.path("class.csv")},
                                                 {"deadline", "2099-01-01T00:00Z"},
                                                 {"key", room.path("class.key")},
                                                 {"variants", 3},
                                                 {"output", room.path(output)}});
    EXPECT_TRUE(done) << describe(done.error());
  };
  again("again.json");
  EXPECT_EQ(room.text("again.json"), room.text("C1.json"));
  room.folder.write("class.csv", room.text("class.csv") + "late-comer,,\n");
  again("more.json");
  const auto more = readAssignment(room.path("more.json"));
  ASSERT_TRUE(more) << describe(more.error());
  EXPECT_NE(more->variantOf("late-comer"), nullptr);
  for (const char* id : {"s-001", "s-002", "s-003", "s-004"})
    EXPECT_EQ(more->variantOf(id)->seed, room.assignment.variantOf(id)->seed);
}

TEST(Assign, AFileThatWasChangedIsRefusedWithItsName) {
  const Classroom room(2);
  Classroom::tamper(room.folder / "C1.json", [](json& payload) { payload["exercise"]["pass_mark"] = 0.1; });
  const auto read = readAssignment(room.path("C1.json"));
  ASSERT_FALSE(read);
  EXPECT_EQ(describe(read.error()),
            "C1.json: was changed after the lecturer signed it; ask for the file as it was given");
}

TEST(Assign, TheStudentNamesHimselfAndHasNoSolution) {
  const Classroom room(2);
  room.folder.write("a.json", "[]");
  const auto run = [&](const json& more) {
    json options = {{"exercise", room.path("C1.json")}, {"output", room.path("o")}};
    options.update(more);
    const auto done = Classroom::verb("rehearse", options);
    return done ? std::string("done") : describe(done.error());
  };
  EXPECT_THAT(run({{"actions", room.path("a.json")}}), HasSubstr("--student: specify who you are"));
  EXPECT_THAT(run({{"actions", room.path("a.json")}, {"student", "s-003"}}), HasSubstr("has no student 's-003'"));
  EXPECT_THAT(run({{"solution", true}, {"student", "s-001"}}), HasSubstr("has no solution"));
  EXPECT_EQ(run({{"actions", room.path("a.json")}, {"student", "s-001"}}), "done");
}

// What assign says of an exercise that was changed by `change`.
std::string assigned(const std::function<void(json&)>& change, Report* report = nullptr) {
  const TemporaryFolder folder;
  auto exercise = classExercise();
  change(exercise);
  // Another key draws other variants: this one is that of RFC 8032, section 7.1, test 1.
  const auto key = *SigningKey::read(folder.write("k", R"({"format": "standpoint-key-1",
    "secret": "nWGxne/9WmC6hEr0kuwsxERJxWl7MmkZcDusAxyuf2A=",
    "public": "11qYAYKxCrfVS/7TyWQHOg7hcvPapiMlrwIaaPcHURo="})"));
  Report said;
  Progress quiet;
  const auto done = checkedVariants(exercise, "x.json", 3, key, said, quiet);
  if (report != nullptr) *report = said;
  return done ? std::to_string(done->size()) + " variants" : describe(done.error());
}

TEST(Variants, AreGivenOnlyWhereTheirSolutionIsRightAndNothingElseIs) {
  EXPECT_EQ(assigned([](json&) {}), "3 variants");
  EXPECT_THAT(assigned([](json& e) { e["solution"].erase(3); }), HasSubstr("its solution is worth 50 %"));
  EXPECT_THAT(assigned([](json& e) { e.erase("solution"); }), HasSubstr("x.json /solution: without a solution"));
  EXPECT_THAT(assigned([](json& e) { e["pass_mark"] = 0, e["rules"][0]["must"] = false; }),
              HasSubstr("doing nothing passes"));
  EXPECT_THAT(assigned([](json& e) { e["rules"][0]["must"] = false; }), HasSubstr("mistake M03 passes"));
  Report report;
  EXPECT_EQ(assigned([](json& e) { e["pass_mark"] = 0.4; }, &report), "1 variants")
      << "a neighbour's answers would pass";
  EXPECT_TRUE(std::any_of(report.issues.begin(), report.issues.end(), [](const Issue& issue) {
    return issue.message.find("passes here, too") != std::string::npos;
  }));
}

TEST(Variants, OfAnExerciseWithoutOpenFiguresAreOne) {
  EXPECT_EQ(assigned([](json& e) { e = *withFigures(e, {{"number", "two"}, {"lean", 3}}, "x.json"); }), "1 variants");
}

}  // namespace
}  // namespace standpoint
