// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "project/storage/project_files.h"
#include "project/survey/measure_verb.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const json kDistance = {{"add", "M1"},
                        {"kind", "distance"},
                        {"points", {"500001,5600001,0", "500004,5600005,0"}},
                        {"note", "door to table"}};

TEST(Measure, AddsAMeasurementInTheFrameOfTheFileAndKeepsItInTheLocalOne) {
  const auto done = run("measure", twoStoreyDocument(), kDistance);
  ASSERT_TRUE(done) << describe(done.error());
  ASSERT_TRUE(done->document.measurements);
  const auto& m = done->document.measurements->front();
  EXPECT_EQ(m.points[0], Eigen::Vector3d(1, 1, 0));
  EXPECT_NEAR(done->answer["placed"]["figures"]["distance_m"].get<double>(), 5, 1e-9);
  EXPECT_EQ(done->answer["placed"]["points"][1][0].get<double>(), 500004);
  EXPECT_EQ(done->description, "Measured distance M1: 5.000 m");
}

TEST(Measure, StatesAnglesInDegrees) {
  const auto done = run(
      "measure", twoStoreyDocument(),
      {{"add", "corner"}, {"kind", "angle"}, {"points", {"500001,5600000,0", "500000,5600000,0", "500000,5600001,0"}}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_NEAR(done->answer["placed"]["figures"]["angle_deg"].get<double>(), 90, 1e-9);
}

TEST(Measure, SurvivesSavingAndOpeningTheProject) {
  const TemporaryFolder folder;
  const auto done = run("measure", twoStoreyDocument(), kDistance);
  ASSERT_TRUE(done);
  Progress progress;
  ASSERT_TRUE(saveProject(done->document, folder.path() / "p", progress));
  const auto again = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(again) << describe(again.error());
  ASSERT_TRUE(again->measurements);
  EXPECT_EQ(*again->measurements, *done->document.measurements);
}

TEST(Measure, RenamesAndRemovesByName) {
  const auto first = run("measure", twoStoreyDocument(), kDistance);
  ASSERT_TRUE(first);
  EXPECT_EQ(freeMeasurementName(first->document), "M2");
  const auto renamed = run("measure", first->document, {{"rename", "M1"}, {"name", "width"}});
  ASSERT_TRUE(renamed) << describe(renamed.error());
  EXPECT_EQ(renamed->document.measurements->front().name, "width");
  const auto removed = run("measure", renamed->document, {{"remove", "width"}});
  ASSERT_TRUE(removed) << describe(removed.error());
  EXPECT_TRUE(removed->document.measurements->empty());
}

TEST(Measure, RefusesWithTheReason) {
  const auto why = [](const Document& document, const json& options) {
    const auto done = run("measure", document, options);
    return done ? std::string("done") : describe(done.error());
  };
  const Document empty = twoStoreyDocument();
  const auto one = run("measure", empty, kDistance);
  ASSERT_TRUE(one);
  EXPECT_THAT(why(one->document, kDistance), HasSubstr("already exists"));
  EXPECT_THAT(why(one->document, {{"remove", "M7"}}), HasSubstr("available: M1"));
  EXPECT_THAT(why(empty, {{"add", "M1"}, {"points", {"1,2"}}}), HasSubstr("must be X,Y,Z"));
  EXPECT_THAT(why(empty, {{"add", "M1"}, {"points", {"1,2,3"}}}), HasSubstr("needs 2 points"));
  EXPECT_THAT(why(empty, {{"points", {"1,2,3"}}}), HasSubstr("requires --add"));
  EXPECT_THAT(why(empty, {{"add", "M1"}, {"remove", "M1"}}), HasSubstr("specify one of"));
}

}  // namespace
}  // namespace standpoint
