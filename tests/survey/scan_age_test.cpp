// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/scanning/scan_age.h"

#include <gtest/gtest.h>

#include "project/storage/project_files.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

class ScanAge : public testing::Test {
 protected:
  void SetUp() override {
    targets = {{"K1", TargetKind::sphere, {1, 1, 1}, Eigen::Vector3d::UnitX(), 0.145},
               {"K3", TargetKind::checkerboard, {3, 1, 1}, Eigen::Vector3d::UnitY(), 0.2}};
    station.name = "S1";
    station.true_pose.translation = {2, 2, 1.6};
    scan.as_scanned = AsScanned{station.true_pose, targets};
  }
  Station station;
  std::vector<Target> targets;
  Scan scan;
};

TEST_F(ScanAge, IsUpToDateWhileStationAndTargetsStandAsTheyStood) {
  EXPECT_EQ(ageText(scan, station, targets), "");
  targets[0].name = "North";
  EXPECT_EQ(ageText(scan, station, targets), "") << "another name is no other place";
}

TEST_F(ScanAge, NamesTheTargetThatWasMovedSince) {
  targets[1].centre.x() += 0.01;
  EXPECT_EQ(ageText(scan, station, targets), "older than K3");
}

TEST_F(ScanAge, NamesTheStationFirst) {
  targets[1].centre.x() += 0.01;
  station.true_pose.translation.y() += 0.5;
  EXPECT_EQ(ageText(scan, station, targets), "older than S1 and 1 more");
  EXPECT_EQ(newerThan(scan, station, targets), (std::vector<std::string>{"S1", "K3"}));
}

TEST_F(ScanAge, CountsTargetsThatWereAddedOrRemoved) {
  targets.push_back({"K4", TargetKind::sphere, {5, 1, 1}, Eigen::Vector3d::UnitX(), 0.145});
  EXPECT_EQ(ageText(scan, station, targets), "older than K4");
  targets.erase(targets.begin());
  EXPECT_EQ(newerThan(scan, station, targets), (std::vector<std::string>{"K4", "K1"}));
}

TEST_F(ScanAge, SaysNothingOfARecordThatDoesNotKnow) {
  scan.as_scanned.reset();
  station.true_pose.translation.y() += 0.5;
  EXPECT_EQ(ageText(scan, station, targets), "");
}

TEST_F(ScanAge, OfAWalkIsThatOfItsWay) {
  CarriedTrajectory walk{.name = "W1", .waypoints = {{{0, 0, 0}}, {{4, 0, 0}}}};
  EXPECT_EQ(ageText(scan, walk), "") << "nobody knows what it was made along";
  scan.along = wayFingerprint(walk);
  walk.name = "Hall";
  walk.scans = {scan};
  EXPECT_EQ(ageText(scan, walk), "") << "another name is no other way";
  const CarriedTrajectory as_scanned = walk;
  walk.waypoints[1].look_rad = 0;
  EXPECT_EQ(ageText(scan, walk), "older than Hall");
  walk = as_scanned;
  walk.speed_mps = 0.5;
  EXPECT_EQ(ageText(scan, walk), "older than Hall");
}

TEST_F(ScanAge, OfAStationIsThatOfItsNewestScan) {
  EXPECT_EQ(ageText(station, targets), "") << "it has none";
  station.scans = {scan};
  station.true_pose.translation.y() += 0.5;
  EXPECT_EQ(ageText(station, targets), "older than S1");
  station.scans.push_back(scan);
  station.scans.back().as_scanned->station = station.true_pose;
  EXPECT_EQ(ageText(station, targets), "");
}

TEST(ScanAgeOfAProject, ComesBackFromTheDiskExactly) {
  const TemporaryFolder folder;
  Progress progress;
  auto d = twoStoreyDocument();
  const auto step = [&](const char* verb, const nlohmann::json& options) {
    auto done = run(verb, d, options);
    ASSERT_TRUE(done) << describe(done.error());
    d = done->document;
  };
  step("station", {{"add", "S1"}, {"at", {500002.1, 5600002, 1.6}}, {"yaw-deg", 33.3}, {"tilt-deg", 0.7}});
  step("target", {{"add", "K3"}, {"at", {500001.3, 5600001, 1.1}}});
  step("scan", {{"instrument", "faro-focus-s350"},
                {"set", {"resolution=1/32", "quality=4x"}},
                {"output", (folder.path() / "s.e57").string()}});
  ASSERT_TRUE(saveProject(d, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  d = *back;
  const auto age = [&] { return ageText(d.job->stations[0], d.job->targets); };
  ASSERT_TRUE(d.job->stations[0].scans.at(0).as_scanned);
  EXPECT_EQ(age(), "");
  step("target", {{"move", "K3"}, {"at", {500001.3, 5600001.2, 1.1}}});
  EXPECT_EQ(age(), "older than K3");
  step("target", {{"move", "K3"}, {"at", {500001.3, 5600001, 1.1}}});
  EXPECT_EQ(age(), "") << "it stands again where it stood";
  step("station", {{"move", "S1"}, {"at", {500002.2, 5600002, 1.6}}, {"yaw-deg", 33.3}, {"tilt-deg", 0.7}});
  EXPECT_EQ(age(), "older than S1");
}

TEST(ScanAgeOfAProject, OfAWalkComesBackFromTheDisk) {
  const TemporaryFolder folder;
  Progress progress;
  auto walked =
      run("trajectory", twoStoreyDocument(), {{"add", "W1"}, {"through", {"500001.1,5600001.3", "500002,5600001"}}});
  ASSERT_TRUE(walked) << describe(walked.error());
  auto scanned =
      run("scan", walked->document,
          {{"trajectory", "W1"}, {"instrument", "velodyne-vlp-16"}, {"output", (folder.path() / "s.e57").string()}});
  ASSERT_TRUE(scanned) << describe(scanned.error());
  ASSERT_TRUE(saveProject(scanned->document, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  const CarriedTrajectory& then = back->job->trajectories.at(0);
  EXPECT_EQ(ageText(then.scans.at(0), then), "");
  const auto slower = run("trajectory", *back, {{"change", "W1"}, {"speed", 0.5}});
  ASSERT_TRUE(slower) << describe(slower.error());
  const CarriedTrajectory& now = slower->document.job->trajectories.at(0);
  EXPECT_EQ(ageText(now.scans.at(0), now), "older than W1");
}

}  // namespace
}  // namespace standpoint
