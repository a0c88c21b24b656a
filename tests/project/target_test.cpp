// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

Document withStation() {
  return run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002, 5600001.5, 1.6}}})->document;
}

std::string targetRefusal(const Document& d, const json& options) {
  const auto done = run("target", d, options);
  return done ? std::string("placed") : done.error().message;
}

TEST(Target, IsMovedAndRenamedAndKeepsItsKindAndDirection) {
  const auto d =
      run("target", withStation(), {{"add", "T1"}, {"at", {500004, 5600001.5, 1.6}}, {"type", "bw-152"}})->document;
  const Target before = d.job->targets.at(0);
  const auto moved = run("target", d, {{"move", "T1"}, {"at", {500004.05, 5600001.5, 1.6}}});
  ASSERT_TRUE(moved) << describe(moved.error());
  const Target& t = moved->document.job->targets.at(0);
  EXPECT_EQ(moved->description, "Moved target T1 by 0.05 m");
  EXPECT_NEAR(t.centre.x(), before.centre.x() + 0.05, 1e-9);
  EXPECT_TRUE(t.normal.isApprox(before.normal, 1e-9));
  EXPECT_EQ(t.size_m, before.size_m);
  EXPECT_EQ(t.kind, before.kind);
  const auto renamed = run("target", moved->document, {{"rename", "T1"}, {"name", "Column"}});
  ASSERT_TRUE(renamed) << describe(renamed.error());
  EXPECT_EQ(renamed->document.job->targets.at(0).name, "Column");
  EXPECT_THAT(targetRefusal(d, {{"rename", "T1"}, {"name", "a b"}}), HasSubstr("invalid"));
  EXPECT_THAT(targetRefusal(d, {{"move", "T9"}, {"at", {500004, 5600001.5, 1.6}}}), HasSubstr("unknown"));
}

TEST(Target, OnATripodStandsItsHeightAboveTheFloorAndAPlateLooksAtTheNearestStation) {
  const auto done =
      run("target", withStation(), {{"add", "T1"}, {"on", {500004, 5600001.5}}, {"height", 1.6}, {"type", "bw-152"}});
  ASSERT_TRUE(done) << describe(done.error());
  const Target& t = done->document.job->targets.at(0);
  EXPECT_LT((t.centre - Eigen::Vector3d(4, 1.5, 1.6)).norm(), 1e-5);
  EXPECT_LT((t.normal + Eigen::Vector3d::UnitX()).norm(), 1e-5);
  EXPECT_DOUBLE_EQ(t.size_m, 0.1524);
  const json& seen = done->answer.at("seen_from").at(0);
  EXPECT_NEAR(seen.at("distance_m").get<double>(), 2, 1e-5);
  EXPECT_TRUE(seen.at("why_not").is_null());
}

TEST(Target, StuckToAWallTakesItsNormalAndASphereStandsOffByItsRadiusAndItsBase) {
  const Document d = withStation();
  const auto plate =
      run("target", d, {{"add", "C1"}, {"on-surface", {500000.1, 5600001, 1.2}}, {"kind", "checkerboard"}});
  ASSERT_TRUE(plate) << describe(plate.error());
  EXPECT_LT((plate->document.job->targets[0].normal - Eigen::Vector3d::UnitX()).norm(), 1e-6);
  EXPECT_THAT(plate->answer.at("placed").at("stands_on").get<std::string>(), HasSubstr("west0"));
  const auto sphere = run("target", d, {{"add", "K1"}, {"on-surface", {500000.1, 5600001, 1.2}}, {"stand-off", 0.03}});
  ASSERT_TRUE(sphere) << describe(sphere.error());
  EXPECT_NEAR(sphere->document.job->targets[0].centre.x(), 0.0725 + 0.03, 1e-6);
}

TEST(Target, RightOnAWallIsOnTheSideWhereAStationStands) {
  for (const double x : {0.0, 6.0}) {
    const auto done = run("target", withStation(),
                          {{"add", "T"}, {"on-surface", {500000 + x, 5600001, 1.2}}, {"type", "sphere-200"}});
    ASSERT_TRUE(done) << describe(done.error());
    EXPECT_NEAR(done->document.job->targets[0].centre.x(), x < 3 ? 0.1 : 5.9, 1e-6);
  }
}

TEST(Target, OnTheCeilingLooksDown) {
  const auto done =
      run("target", withStation(), {{"add", "T"}, {"on-surface", {500002, 5600002, 2.7}}, {"kind", "checkerboard"}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_LT((done->document.job->targets[0].normal + Eigen::Vector3d::UnitZ()).norm(), 1e-6);
}

TEST(Target, IsRefusedWithTheReason) {
  const Document d = withStation();
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}, {"at", {500003, 5600002, 2.9}}}), HasSubstr("inside IfcSlab slab1"));
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}, {"at", {500004.5, 5600003, 0.4}}}),
              HasSubstr("inside IfcFurniture table"));
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}, {"at", {500000.05, 5600002, 1}}}), HasSubstr("west0"));
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}, {"on", {600000, 5600002}}}), HasSubstr("no floor"));
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}, {"on", {500002, 5600002, 1.5}}}),
              HasSubstr("the nearest floor is at 0.000"));
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}, {"on-surface", {500003, 5600002, 1.4}}}),
              HasSubstr("no surface within 0.5 m"));
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}, {"type", "ball"}, {"at", {500003, 5600002, 1}}}),
              HasSubstr("sphere-145"));
  EXPECT_THAT(targetRefusal(d, {{"add", "T"}}), HasSubstr("--on-surface"));
  const Document once = run("target", d, {{"add", "T"}, {"at", {500003, 5600002, 1}}})->document;
  EXPECT_THAT(targetRefusal(once, {{"add", "T"}, {"at", {500002, 5600002, 1}}}), HasSubstr("already"));
}

TEST(Target, ThatHangsInTheAirIsPlacedAndSaid) {
  const auto done = run("target", withStation(), {{"add", "T"}, {"at", {500020, 5600002, 5}}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_THAT(said(done->report), HasSubstr("floating"));
}

TEST(Target, SaysWhatStationsCannotMeasureIt) {
  const Document d = withStation();
  const auto hidden = run("target", d, {{"add", "T"}, {"on", {500003, 5600002, 3}}});
  ASSERT_TRUE(hidden) << describe(hidden.error());
  EXPECT_THAT(said(hidden->report), HasSubstr("hidden from every station"));
  // On the south wall, 4 m along and 1.5 m across: seen at 69°.
  const auto flat =
      run("target", d, {{"add", "T"}, {"on-surface", {500005.8, 5600000.01, 1.6}}, {"kind", "checkerboard"}});
  ASSERT_TRUE(flat) << describe(flat.error());
  EXPECT_THAT(said(flat->report), HasSubstr("incidence 68° exceeds the limit of 60°"));
}

TEST(Target, WhereAStationStandsCannotBeMeasuredFromIt) {
  const auto done = run("target", withStation(), {{"add", "T"}, {"at", {500002, 5600001.5, 1.6}}});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_THAT(said(done->report), HasSubstr("not measurable from S1: only 0.00 m from the instrument"));
}

// instrument-facts.md §4.3: a sphere of 145 mm gets 60 points of a FARO at 1/16 up to 108.1 m / 16, and here it is 3.9
// m away.
TEST(Target, IsMeasuredAsFarAsTheGridLaysSixtyPointsOnIt) {
  const json options = {
      {"add", "T"}, {"on", {500005.9, 5600001.5}}, {"instrument", "faro-focus-s350"}, {"set", {"resolution=1/16"}}};
  const auto near = run("target", withStation(), options);
  ASSERT_TRUE(near) << describe(near.error());
  const json& row = near->answer.at("seen_from").at(0);
  EXPECT_NEAR(row.at("most_distance_m").get<double>(), 108.1 / 16, 0.01);
  EXPECT_TRUE(row.at("why_not").is_null());
  auto coarse = options;
  coarse["set"] = {"resolution=1/32", "quality=4x"};
  const auto far = run("target", withStation(), coarse);
  ASSERT_TRUE(far) << describe(far.error());
  EXPECT_THAT(far->answer.at("seen_from").at(0).at("why_not").get<std::string>(),
              HasSubstr("exceeds the limit of 3.4 m"));
}

}  // namespace
}  // namespace standpoint
