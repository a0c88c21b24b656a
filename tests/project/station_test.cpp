// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;

TEST(Station, OnAFloorStandsItsHeightAboveTheLowestFloorWithRoom) {
  const auto s = run("station", twoStoreyDocument(), {{"add", "S1"}, {"on", {500002, 5600002}}, {"height", 1.7}});
  ASSERT_TRUE(s) << describe(s.error());
  EXPECT_NEAR(s->answer["placed"]["at"][2].get<double>(), 1.7, 1e-5);
  EXPECT_EQ(s->description, "Added station S1");
}

TEST(Station, OnTheUpperFloorIsMeantByItsHeight) {
  const auto s = run("station", twoStoreyDocument(), {{"add", "S1"}, {"on", {500002, 5600002, 3.1}}});
  ASSERT_TRUE(s) << describe(s.error());
  EXPECT_NEAR(s->answer["placed"]["at"][2].get<double>(), 4.6, 1e-5);
}

TEST(Station, AtAPointIsTheInstrumentsCentreInTheFilesFrame) {
  const auto s = run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002.25, 5600001.5, 1.25}}});
  ASSERT_TRUE(s) << describe(s.error());
  EXPECT_EQ(s->answer["placed"]["at"], json({500002.25, 5600001.5, 1.25}));
  EXPECT_EQ(s->document.job->stations[0].true_pose.translation, Eigen::Vector3d(2.25, 1.5, 1.25));
}

TEST(Station, IsRefusedWhereTheInstrumentDoesNotFit) {
  const Document d = twoStoreyDocument();
  const auto in_table = run("station", d, {{"add", "S1"}, {"at", {500004.05, 5600003, 0.7}}});
  ASSERT_FALSE(in_table);
  EXPECT_EQ(in_table.error().kind, ErrorKind::unusable);
  EXPECT_NE(in_table.error().message.find("table"), std::string::npos);
  EXPECT_FALSE(run("station", d, {{"add", "S1"}, {"on", {600000, 5600002}}})) << "no floor there";
  EXPECT_FALSE(run("station", d, {{"add", "S1"}, {"on", {500002, 5600002, 1.5}}})) << "no floor at that height";
  const auto under_table = run("station", d, {{"add", "S1"}, {"on", {500004.05, 5600003, 0}}});
  ASSERT_FALSE(under_table);
  EXPECT_NE(under_table.error().message.find("table"), std::string::npos) << under_table.error().message;
  EXPECT_NE(under_table.error().message.find("is in the way"), std::string::npos) << under_table.error().message;
  EXPECT_FALSE(run("station", d, {{"add", "S1"}, {"on", {500002, 5600002, 0}}, {"height", 2.9}})) << "no head-room";
  EXPECT_FALSE(run("station", d, {{"add", "a/b"}, {"on", {500002, 5600002}}})) << "its name becomes a file's";
}

TEST(Station, PlacesItselfWhereItSeesMostAndApartFromTheOthers) {
  const auto first = run("station", twoStoreyDocument(), {{"add", "S1"}});
  ASSERT_TRUE(first) << describe(first.error());
  const auto second = run("station", first->document, {{"add", "S2"}});
  ASSERT_TRUE(second) << describe(second.error());
  const auto& stations = second->document.job->stations;
  EXPECT_GE((stations[0].true_pose.translation - stations[1].true_pose.translation).norm(), 2.5);
}

TEST(StationRow, StandsEvenlyBetweenTwoPlacesInOneStep) {
  const auto row =
      run("station", twoStoreyDocument(),
          {{"add", "S1"}, {"on", {500000.5, 5600001, 0}}, {"row-to", {500005.5, 5600001, 0}}, {"row-count", 3}});
  ASSERT_TRUE(row) << describe(row.error());
  EXPECT_EQ(row->description, "Added 3 stations: S1 to S3");
  const auto& stations = row->document.job->stations;
  ASSERT_EQ(stations.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(stations[k].name, "S" + std::to_string(k + 1));
    EXPECT_NEAR(stations[k].true_pose.translation.x(), 0.5 + 2.5 * static_cast<double>(k), 1e-5);
    EXPECT_NEAR(stations[k].true_pose.translation.z(), 1.6, 1e-5);
  }
}

TEST(StationRow, AtASpacingGoesAsFarAsItReaches) {
  const auto row =
      run("station", twoStoreyDocument(),
          {{"add", "K7"}, {"on", {500000.5, 5600001, 0}}, {"row-to", {500005.5, 5600001, 0}}, {"row-spacing", 2}});
  ASSERT_TRUE(row) << describe(row.error());
  const auto& stations = row->document.job->stations;
  ASSERT_EQ(stations.size(), 3U);
  EXPECT_EQ(stations[2].name, "K9");
  EXPECT_NEAR(stations[2].true_pose.translation.x(), 4.5, 1e-5);
}

TEST(StationRow, LeavesOutWhatCannotStandAndSaysSo) {
  const json through_the_table = {
      {"add", "S1"}, {"on", {500001, 5600003, 0}}, {"row-to", {500004.5, 5600003, 0}}, {"row-count", 2}};
  const auto row = run("station", twoStoreyDocument(), through_the_table);
  ASSERT_TRUE(row) << describe(row.error());
  EXPECT_EQ(row->document.job->stations.size(), 1U);
  EXPECT_EQ(row->description, "Added station S1");
  EXPECT_NE(said(row->report).find("left out of the row"), std::string::npos);
  json nowhere = through_the_table;
  nowhere["on"] = {600000, 5600003, 0};
  nowhere["row-to"] = {600004, 5600003, 0};
  EXPECT_FALSE(run("station", twoStoreyDocument(), nowhere));
}

TEST(StationRow, NeedsBothEndsAndEitherANumberOrASpacing) {
  const json one = {{"add", "S1"}, {"on", {500001, 5600001, 0}}};
  for (json more : {json{{"row-count", 3}}, json{{"row-to", {500004, 5600001, 0}}},
                    json{{"row-to", {500004, 5600001, 0}}, {"row-count", 3}, {"row-spacing", 1}}}) {
    json options = one;
    options.update(more);
    const auto row = run("station", twoStoreyDocument(), options);
    ASSERT_FALSE(row) << more;
    EXPECT_EQ(row.error().kind, ErrorKind::usage) << more;
  }
}

TEST(Station, IsRenamedAndKeepsWhatItHas) {
  Document d = run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002, 5600002, 1.5}}})->document;
  d = run("station", d, {{"add", "S2"}, {"at", {500004, 5600002, 1.5}}})->document;
  const auto renamed = run("station", d, {{"rename", "S1"}, {"name", "Hall"}});
  ASSERT_TRUE(renamed) << describe(renamed.error());
  EXPECT_EQ(renamed->description, "Renamed station S1 to Hall");
  EXPECT_EQ(renamed->document.job->stations[0].name, "Hall");
  EXPECT_EQ(renamed->document.job->stations[0].true_pose.translation, d.job->stations[0].true_pose.translation);
  for (const char* name : {"S2", "", "a/b", "a,b"})
    EXPECT_FALSE(run("station", d, {{"rename", "S1"}, {"name", name}})) << name;
  EXPECT_FALSE(run("station", d, {{"rename", "S9"}, {"name", "Hall"}}));
  EXPECT_FALSE(run("station", d, {{"rename", "S1"}, {"move", "S1"}, {"name", "Hall"}}));
}

TEST(Station, MovesAndIsRemovedAndItsNameIsUnique) {
  const Document d = run("station", twoStoreyDocument(), {{"add", "S1"}, {"at", {500002, 5600002, 1.5}}})->document;
  EXPECT_FALSE(run("station", d, {{"add", "S1"}, {"at", {500003, 5600002, 1.5}}}));
  const auto moved = run("station", d, {{"move", "S1"}, {"at", {500002.35, 5600002, 1.5}}});
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->description, "Moved station S1 by 0.35 m");
  EXPECT_EQ(d.job->stations[0].true_pose.translation.x(), 2) << "the old value is untouched";
  const auto turned = run("station", d, {{"move", "S1"}, {"at", {500002, 5600002, 1.5}}, {"yaw-deg", 30}});
  ASSERT_TRUE(turned) << describe(turned.error());
  EXPECT_EQ(turned->description, "Turned station S1");
  EXPECT_TRUE(run("station", moved->document, {{"remove", "S1"}})->document.job->stations.empty());
  const auto missing = run("station", d, {{"remove", "S9"}});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("S1"), std::string::npos) << "says which stations there are";
}

TEST(Target, IsAddedListedAndRemoved) {
  const auto t = run("target", twoStoreyDocument(), {{"add", "T1"}, {"at", {500001, 5600001, 1}}});
  ASSERT_TRUE(t);
  EXPECT_EQ(t->answer["targets"].size(), 1U);
  EXPECT_FALSE(run("target", t->document, {{"add", "T1"}, {"at", {500001, 5600001, 1}}}));
  EXPECT_TRUE(run("target", t->document, {{"remove", "T1"}})->document.job->targets.empty());
}

}  // namespace
}  // namespace standpoint
