// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/answer_fields.h"

#include <set>

#include <gtest/gtest.h>

#include "core/units.h"
#include "project/survey/survey_verbs.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

struct Sample {
  double angle_rad = 90 * kRadPerDeg;
  std::uint64_t points = 7;
  std::string crs;
  std::optional<double> unknown, left_out;
  std::vector<PlanProposal> places = {{{1, 2, 3}, 0.5}};
};
const AnswerFields<Sample>& answerFields(const Sample*) {
  using A = Sample;
  static const AnswerFields<A> fields = {{"angle_deg", &A::angle_rad, answers::degrees}, {"points", &A::points},
                                         {"crs", &A::crs, answers::nullWhereEmpty},      {"unknown", &A::unknown},
                                         {"left_out", &A::left_out, kLeftOut},           {"places", &A::places}};
  return fields;
}

TEST(AnswerFields, AreWrittenInTheUnitsOfTheTableWithNullOrNothingWhereThereIsNothing) {
  EXPECT_EQ(AnswerValue<Sample>::write(Sample()).dump(),
            R"({"angle_deg":90.0,"crs":null,"places":[{"adds_m2":0.5,"at":[1.0,2.0,3.0]}],"points":7,"unknown":null})");
}

struct Several {
  std::string note, crs = "EPSG:1";
  std::map<std::string, PlanProposal> by_name = {{"b", {{1, 2, 3}, 0.5}}};
  std::variant<PlanProposal, std::string> either = "neither";
};
const AnswerFields<Several>& answerFields(const Several*) {
  using A = Several;
  static const AnswerFields<A> fields = {{"note", &A::note, answers::nullWhereEmpty, kLeftOut},
                                         {"crs", &A::crs, answers::nullWhereEmpty, kLeftOut},
                                         {"by_name", &A::by_name},
                                         {"either", &A::either}};
  return fields;
}

TEST(AnswerFields, OfSeveralKindsAreWrittenAsWhatTheyHold) {
  EXPECT_EQ(AnswerValue<Several>::write(Several()).dump(),
            R"({"by_name":{"b":{"adds_m2":0.5,"at":[1.0,2.0,3.0]}},"crs":"EPSG:1","either":"neither"})");
  EXPECT_EQ(AnswerValue<Several>::names(),
            (std::vector<std::string>{"note", "crs", "by_name", "by_name/at", "by_name/adds_m2", "either", "either/at",
                                      "either/adds_m2"}));
}

TEST(AnswerFields, NameWhatIsBelowThem) {
  EXPECT_EQ(AnswerValue<Sample>::names(), (std::vector<std::string>{"angle_deg", "points", "crs", "unknown", "left_out",
                                                                    "places", "places/at", "places/adds_m2"}));
}

TEST(AnswerFields, OfEveryVerbHaveUniqueNames) {
  for (const auto& v : verbs()) {
    std::set<std::string> names;
    for (const auto& name : v.answer_names) {
      EXPECT_TRUE(names.insert(name).second) << v.name << " " << name;
      EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_/"), std::string::npos) << name;
    }
    EXPECT_FALSE(names.empty()) << v.name;
  }
}

TEST(AnswerFields, OfAVerbAreTheKeysOfItsJson) {
  const auto done = run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002, 5600002, 1.5}}});
  ASSERT_TRUE(done) << describe(done.error());
  const auto* answer = answerAs<StationAnswer>(done->typed);
  ASSERT_NE(answer, nullptr);
  EXPECT_EQ(answer->placed->name, "S1");
  EXPECT_EQ(AnswerValue<StationAnswer>::write(*answer), done->answer);
  EXPECT_EQ(answerAs<PlanAnswer>(done->typed), nullptr);
}

}  // namespace
}  // namespace standpoint
