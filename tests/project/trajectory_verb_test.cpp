// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <fstream>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "pointclouds/formats.h"
#include "project/storage/project_files.h"
#include "project/survey/scan_preparation.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using standpoint::testing::KeptScans;

// A loop in the lower room, whose inner faces are at x = 0 and 6, y = 0 and 4, z = 0 and 2.8.
json loop(const char* name = "loop") {
  return {{"add", name}, {"through", {"500001,5600001", "500003.5,5600001", "500003.5,5600002:1.5", "500001,5600002"}}};
}

Document withLoop() {
  auto outcome = run("trajectory", twoStoreyDocument(), loop());
  EXPECT_TRUE(outcome) << describe(outcome.error());
  return outcome->document;
}

json along(const std::filesystem::path& output) {
  return {{"trajectory", "loop"}, {"instrument", "velodyne-vlp-16"}, {"output", output.string()}};
}

// With a twentieth of its firings, where a scan need not be dense.
json thinlyAlong(const std::filesystem::path& output) {
  const auto shipped = std::filesystem::path(SOURCE_DIR) / "scanners/instruments/velodyne-vlp-16.json";
  const auto thin = output.parent_path() / "thin.json";
  json device = json::parse(std::ifstream(shipped));
  device["id"] = "thin";
  device["moving"]["points_per_s"]["value"] = 15000;
  device["moving"]["firing_us"]["value"] = 20 * 55.296;
  std::ofstream(thin) << device;
  json options = along(output);
  options["instrument"] = thin.string();
  return options;
}

KeptScans pointsOf(const std::filesystem::path& file) {
  KeptScans kept;
  EXPECT_TRUE(standpoint::testing::readAll(file, kept)) << file;
  return kept;
}

// From the nearest of the room's faces.
double offFaces(const Eigen::Vector3d& p) {
  const double x = p.x() - 500000, y = p.y() - 5600000;
  double off =
      std::min({std::abs(x), std::abs(x - 6), std::abs(y), std::abs(y - 4), std::abs(p.z()), std::abs(p.z() - 2.8)});
  const bool table = x > 3.99 && x < 5.01 && y > 2.49 && y < 3.51 && p.z() < 0.76;
  return table ? 0 : off;
}

TEST(TrajectoryVerb, KeepsWhatWasClickedWithTheProject) {
  const TemporaryFolder folder;
  const Document made = withLoop();
  Progress progress;
  ASSERT_TRUE(saveProject(made, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  const auto list = run("trajectory", *back, json::object());
  ASSERT_TRUE(list);
  const json& row = list->answer["trajectories"][0];
  EXPECT_EQ(row["name"], "loop");
  EXPECT_EQ(row["waypoints"], 4);
  EXPECT_NEAR(row["length_m"].get<double>(), 6, 0.4);
  EXPECT_GT(row["seconds"].get<double>(), 8);
  EXPECT_EQ(back->job->trajectories[0].waypoints[2].stop_s, 1.5);
  EXPECT_NEAR(back->job->trajectories[0].waypoints[0].floor_m.z(), 0, 1e-6);
}

TEST(TrajectoryVerb, RenamesAndRemoves) {
  const Document made = withLoop();
  const auto renamed = run("trajectory", made, {{"rename", "loop"}, {"name", "ground floor"}});
  ASSERT_TRUE(renamed);
  EXPECT_EQ(renamed->document.job->trajectories[0].name, "ground floor");
  const auto removed = run("trajectory", renamed->document, {{"remove", "ground floor"}});
  ASSERT_TRUE(removed);
  EXPECT_TRUE(removed->document.job->trajectories.empty());
}

TEST(TrajectoryVerb, ChangesWaypointsWithTheirStopsAndLooks) {
  const Document made = withLoop();
  const auto& before = made.job->trajectories[0];
  json options = {{"change", "loop"}, {"carrier", "trolley"}, {"height", 1.5}, {"speed", 0.5}};
  for (const auto& waypoint : before.waypoints)
    options["through"].push_back(waypointText(waypoint, *made.georeference));
  options["through"][1] = "500003,5600001,0:2:90";
  options["through"].push_back("500001,5600003::-30");
  const auto changed = run("trajectory", made, options);
  ASSERT_TRUE(changed) << describe(changed.error());
  EXPECT_EQ(changed->description, "Changed trajectory loop");
  const auto& after = changed->document.job->trajectories[0];
  ASSERT_EQ(after.waypoints.size(), 5U);
  EXPECT_EQ(after.carrier, "trolley");
  EXPECT_EQ(after.height_m, 1.5);
  EXPECT_EQ(after.speed_mps, 0.5);
  EXPECT_EQ(after.waypoints[0].floor_m, before.waypoints[0].floor_m) << "to the last digit";
  EXPECT_EQ(after.waypoints[2].stop_s, 1.5);
  EXPECT_NEAR(after.waypoints[1].floor_m.x(), 3, 1e-6);
  EXPECT_EQ(after.waypoints[1].stop_s, 2);
  EXPECT_NEAR(after.waypoints[1].look_rad.value_or(0), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(after.waypoints[4].look_rad.value_or(0), -std::numbers::pi / 6, 1e-12);
  const auto usual = run("trajectory", changed->document, {{"change", "loop"}, {"height", 0}, {"speed", 0}});
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual->document.job->trajectories[0].height_m, 0);
  EXPECT_EQ(usual->document.job->trajectories[0].waypoints.size(), 5U);
  EXPECT_EQ(usual->document.job->trajectories[0].carrier, "trolley") << "what is not said stays";
}

TEST(TrajectoryVerb, ChangesNoTrajectoryOfAFile) {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "w.csv").string();
  const Document made = withLoop();
  ASSERT_TRUE(run("trajectory", made, {{"write", "loop"}, {"output", file}}));
  const auto read = run("trajectory", made, {{"add", "again"}, {"file", file}});
  ASSERT_TRUE(read);
  const auto changed = run("trajectory", read->document, {{"change", "again"}, {"speed", 2}});
  ASSERT_FALSE(changed);
  EXPECT_NE(describe(changed.error()).find("is what its file has"), std::string::npos);
}

TEST(MovingScanVerb, IsShownToWhoeverWatchesIt) {
  struct Watcher : PointSink {
    Result<void> begin(const ScanHeader&) override { return {}; }
    Result<void> write(const PointBlock& block) override { return points += block.size(), Result<void>(); }
    Result<void> end() override { return {}; }
    Result<void> close() override { return {}; }
    std::uint64_t points = 0;
  };
  const TemporaryFolder folder;
  auto options =
      optionsFrom(scanFields(), *checkOptions(*findVerb(verbs(), "scan"), thinlyAlong(folder.path() / "o.e57")));
  ASSERT_TRUE(options);
  const auto watcher = std::make_shared<Watcher>();
  Progress progress;
  const auto outcome = runScan(withLoop(), *options, {nullptr, watcher, {}}, progress);
  ASSERT_TRUE(outcome) << describe(outcome.error());
  EXPECT_EQ(watcher->points, outcome->answer.stations[0].points);
}

TEST(TrajectoryVerb, WritesWhatItReadsAgain) {
  const TemporaryFolder folder;
  const Document made = withLoop();
  for (const std::string name : {"w.csv", "w.tum", "w.trj"}) {
    const auto file = (folder.path() / name).string();
    ASSERT_TRUE(run("trajectory", made, {{"write", "loop"}, {"output", file}})) << name;
    const auto read = run("trajectory", made, {{"add", "again"}, {"file", file}, {"carrier", "hand"}});
    ASSERT_TRUE(read) << name << describe(read.error());
    const json& rows = read->answer["trajectories"];
    EXPECT_NEAR(rows[1]["seconds"].get<double>(), rows[0]["seconds"].get<double>(), 0.01) << name;
    EXPECT_NEAR(rows[1]["length_m"].get<double>(), rows[0]["length_m"].get<double>(), 0.2)
        << name << ": steps and swaying are no way";
  }
}

TEST(TrajectoryVerb, NamesWhatThePathRunsThrough) {
  const auto through = run("trajectory", twoStoreyDocument(),
                           {{"add", "blind"}, {"through", {"500001,5600001", "500001,5600003", "500009,5600003,0"}}});
  ASSERT_TRUE(through) << describe(through.error());
  bool wall = false;
  for (const auto& issue : through->report.issues) wall |= issue.message.find("east0") != std::string::npos;
  EXPECT_TRUE(wall);
}

TEST(TrajectoryVerb, RefusesWhatIsNoTrajectoryWithARemedy) {
  const TemporaryFolder folder;
  const Document made = withLoop();
  const auto refused = [&](const json& options, const char* words) {
    const auto outcome = run("trajectory", made, options);
    ASSERT_FALSE(outcome) << options;
    EXPECT_NE(describe(outcome.error()).find(words), std::string::npos) << describe(outcome.error());
  };
  refused(loop(), "already");
  refused({{"add", "a/b"}, {"through", {"500001,5600001", "500002,5600001"}}}, "cannot be a trajectory's name");
  refused({{"add", "short"}, {"through", {"500001,5600001"}}}, "at least two places");
  refused({{"add", "odd"}, {"through", {"500001,5600001", "north"}}}, "'north' must be X,Y");
  refused({{"add", "odd"}, {"through", {"500001,5600001", "500002,5600001:-3"}}}, "0 to 3600 seconds");
  refused({{"add", "odd"}, {"through", {"500001,5600001", "500002,5600001:1:500"}}}, "-360 to 360 degrees");
  refused({{"change", "x"}, {"speed", 1}}, "available: loop");
  refused({{"change", "loop"}, {"remove", "loop"}}, "specify one of");
  refused({{"change", "loop"}, {"through", {"500001,5600001", "500060,5600001"}}}, "no floor at");
  refused({{"add", "out"}, {"through", {"500001,5600001", "500060,5600001"}}}, "no floor at");
  refused({{"add", "none"}, {"file", (folder.path() / "none.tum").string()}}, "none.tum");
  refused({{"through", {"500001,5600001", "500002,5600001"}}}, "--add NAME");
  refused({{"remove", "x"}}, "available: loop");
  refused({{"write", "loop"}, {"output", (folder.path() / "w.doc").string()}}, "unsupported format '.doc'");
  refused({{"write", "loop"}}, "belong together");
  std::ofstream(folder.path() / "back.tum") << "0 1 1 1 0 0 0 1\n2 1 1 1 0 0 0 1\n1 1 1 1 0 0 0 1\n";
  refused({{"add", "back"}, {"file", (folder.path() / "back.tum").string()}}, "line 3");
}

// Samples of our own CSV: time, then the place.
std::vector<Eigen::Vector4d> samplesOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<Eigen::Vector4d> samples;
  for (std::string line; std::getline(in, line);) {
    Eigen::Vector4d s;
    if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &s[0], &s[1], &s[2], &s[3]) == 4) samples.push_back(s);
  }
  return samples;
}

// 41 m up and down the room, with three stops of 3 s on its last lap.
TEST(TrajectoryVerb, IsHeldByControlPointsWhereItStops) {
  const TemporaryFolder folder;
  std::vector<std::string> through;
  for (int lap = 0; lap < 4; ++lap)
    for (const char* place : {"500001,5600001", "500003.5,5600001", "500003.5,5600002", "500001,5600002"})
      through.push_back(place);
  for (const std::size_t k : {through.size() - 4, through.size() - 3, through.size() - 2}) through[k] += ":3";
  const auto made = run("trajectory", twoStoreyDocument(), {{"add", "laps"}, {"through", through}});
  ASSERT_TRUE(made) << describe(made.error());
  const auto control = (folder.path() / "control.txt").string();
  std::ofstream(control) << "C1 500001 5600001 0 1\nC2 500003.5 5600001.1 0 1\nC3 500003.5 5600002 0 1\n"
                            "C4 500002.2 5600001 0 1\n";
  const auto written = [&](json options) {
    const auto file = folder.path() / "written.csv";
    options["write"] = "laps", options["output"] = file.string(), options["rate"] = 20;
    const auto outcome = run("trajectory", made->document, options);
    EXPECT_TRUE(outcome) << describe(outcome.error());
    return std::pair{samplesOf(file), outcome ? outcome->report : Report{}};
  };
  const auto truth = written(json::object()).first;
  ASSERT_GT(truth.size(), 500U);
  // The mean error of the third stop, where shaking averages out; our own files have local coordinates.
  const auto offAtStop = [&](const std::vector<Eigen::Vector4d>& solved) {
    Eigen::Vector3d off = Eigen::Vector3d::Zero();
    int count = 0;
    double last = 0;
    for (const auto& t : truth)
      if ((t.segment<2>(1) - Eigen::Vector2d(3.5, 2)).norm() < 0.05) last = t[0];
    for (std::size_t i = 0; i < truth.size(); ++i)
      if (truth[i][0] > last - 2 && truth[i][0] < last - 0.5) off += solved[i].tail<3>() - truth[i].tail<3>(), ++count;
    return Eigen::Vector3d(off / count);
  };
  double open = 0, held = 0;
  constexpr int kSeeds = 8;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    json options = {
        {"solved-for", "leica-blk2go"}, {"trajectory-error", "handheld"}, {"closures", "off"}, {"error-seed", seed}};
    open += offAtStop(written(options).first).squaredNorm() / kSeeds;
    options["control"] = control;
    held += offAtStop(written(options).first).squaredNorm() / kSeeds;
  }
  EXPECT_GT(std::sqrt(open), 0.008);
  EXPECT_NEAR(std::sqrt(held), std::sqrt(3.0) * 0.0031, 0.0018);  // of sigmas 1 and 3 mm along each axis
  const auto report = written({{"solved-for", "leica-blk2go"}, {"control", control}}).second;
  std::string told;
  for (const auto& issue : report.issues) told += issue.message + "\n";
  EXPECT_NE(told.find("3 control points hold it"), std::string::npos) << told;
  EXPECT_NE(told.find("does not stop within 0.5 m of control point C4"), std::string::npos) << told;
}

TEST(MovingScanVerb, SeesTheRoomAlongTheTrajectory) {
  const TemporaryFolder folder;
  json options = along(folder.path() / "o.e57");
  options["ideal"] = true;
  const auto outcome = run("scan", withLoop(), options);
  ASSERT_TRUE(outcome) << describe(outcome.error());
  const json& row = outcome->answer["stations"][0];
  EXPECT_EQ(row["station"], "loop");
  EXPECT_GT(row["points"].get<std::uint64_t>(), 1000000U);
  EXPECT_EQ(outcome->document.job->trajectories[0].scans.size(), 1U);
  const auto kept = pointsOf(folder.path() / "o.e57");
  ASSERT_EQ(kept.scans.size(), 1U);
  const auto& scan = kept.scans[0];
  ASSERT_EQ(scan.points.time_s.size(), scan.points.size());
  EXPECT_EQ(std::set<int>(scan.points.channel.begin(), scan.points.channel.end()).size(), 16U);
  double worst = 0;
  for (std::size_t i = 0; i < scan.points.size(); i += 101)
    worst = std::max(worst, offFaces(scan.header.file_from_scanner *
                                     Eigen::Vector3d(scan.points.x_m[i], scan.points.y_m[i], scan.points.z_m[i])));
  EXPECT_LT(worst, 2e-5);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "o.trajectory.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "o.true.csv"));
}

// A trajectory that errs bends the walls; the truth of the points stays on them, and both trajectories tell it.
TEST(MovingScanVerb, PlacesPointsByTheTrajectoryThatTheSurveyorKnows) {
  const TemporaryFolder folder;
  json options = thinlyAlong(folder.path() / "o.e57");
  options["without"] = "range-noise,angle-noise,bias,footprint,chance,incidence-noise,range-offset";
  options["trajectory-error"] = "poor";
  options["truth"] = true;
  const auto outcome = run("scan", withLoop(), options);
  ASSERT_TRUE(outcome) << describe(outcome.error());
  const auto kept = pointsOf(folder.path() / "o.e57");
  const auto& scan = kept.scans[0];
  double squares = 0, worst_truth = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < scan.points.size(); i += 11, ++count) {
    const auto& t = scan.points.truth;
    const Eigen::Vector3d point =
        scan.header.file_from_scanner * Eigen::Vector3d(scan.points.x_m[i], scan.points.y_m[i], scan.points.z_m[i]);
    squares += std::pow(offFaces(point), 2);
    worst_truth =
        std::max(worst_truth, offFaces(truePose(scan.header) * Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i])));
  }
  EXPECT_LT(worst_truth, 2e-5);
  EXPECT_GT(std::sqrt(squares / static_cast<double>(count)), 0.0005);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 0.02);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "o.true.csv"));
}

// A lever arm that is 30 mm longer than it is believed shifts each point by as much.
TEST(MovingScanVerb, PutsPointsOffByWhatIsWronglyBelievedOfItsMounting) {
  const TemporaryFolder folder;
  json options = thinlyAlong(folder.path() / "o.e57");
  options["ideal"] = true, options["truth"] = true;
  options["mounting"] = {"x=0.1", "z=0.2", "pitch=10"};
  options["mounting-error"] = {"y=0.03"};
  const auto outcome = run("scan", withLoop(), options);
  ASSERT_TRUE(outcome) << describe(outcome.error());
  const auto kept = pointsOf(folder.path() / "o.e57");
  const auto& scan = kept.scans[0];
  ASSERT_GT(scan.points.size(), 20000U);
  for (std::size_t i = 0; i < scan.points.size(); i += 11) {
    const auto& t = scan.points.truth;
    const Eigen::Vector3d off =
        scan.header.file_from_scanner * Eigen::Vector3d(scan.points.x_m[i], scan.points.y_m[i], scan.points.z_m[i]) -
        truePose(scan.header) * Eigen::Vector3d(t.x_m[i], t.y_m[i], t.z_m[i]);
    ASSERT_NEAR(off.norm(), 0.03, 1e-4);
  }
}

// Scanned once and solved again: by the truth the points come to lie on the walls.
TEST(MovingScanVerb, IsSolvedAgainWithoutScanningAgain) {
  const TemporaryFolder folder;
  json options = thinlyAlong(folder.path() / "o.e57");
  options["without"] = "range-noise,angle-noise,bias,footprint,chance,incidence-noise,range-offset";
  options["trajectory-error"] = "poor", options["truth"] = true;
  const Document made = withLoop();
  ASSERT_TRUE(run("scan", made, options));
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  ASSERT_TRUE(run("trajectory", made,
                  {{"write", "loop"},
                   {"output", path("again.csv")},
                   {"solved-for", (folder.path() / "thin.json").string()},
                   {"trajectory-error", "poor"}}));
  const auto bytes = [&](const char* name) {
    std::ifstream file(path(name));
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("again.csv"), bytes("o.trajectory.csv"));
  const auto placed = run("convert", {},
                          {{"in", path("o.e57")},
                           {"out", path("true.e57")},
                           {"from-trajectory", path("again.csv")},
                           {"to-trajectory", path("o.true.csv")}});
  ASSERT_TRUE(placed) << describe(placed.error());
  const auto before = pointsOf(folder.path() / "o.e57"), after = pointsOf(folder.path() / "true.e57");
  ASSERT_EQ(after.scans[0].points.size(), before.scans[0].points.size());
  EXPECT_NE(after.scans[0].header.guid, before.scans[0].header.guid);
  double worst_before = 0, worst_after = 0;
  for (const auto* kept : {&before, &after})
    for (std::size_t i = 0; i < kept->scans[0].points.size(); i += 11) {
      const auto& points = kept->scans[0].points;
      const double off = offFaces(kept->scans[0].header.file_from_scanner *
                                  Eigen::Vector3d(points.x_m[i], points.y_m[i], points.z_m[i]));
      double& worst = kept == &before ? worst_before : worst_after;
      worst = std::max(worst, off);
    }
  EXPECT_GT(worst_before, 0.001);
  EXPECT_LT(worst_after, 1e-4);
  const auto shorter = run("trajectory", made, {{"add", "short"}, {"through", {"500001,5600001", "500001.5,5600001"}}});
  ASSERT_TRUE(shorter);
  ASSERT_TRUE(run("trajectory", shorter->document, {{"write", "short"}, {"output", path("short.csv")}}));
  const auto refused = run("convert", {},
                           {{"in", path("o.e57")},
                            {"out", path("x.e57")},
                            {"from-trajectory", path("again.csv")},
                            {"to-trajectory", path("short.csv")}});
  ASSERT_FALSE(refused);
  EXPECT_NE(describe(refused.error()).find("is not within this trajectory"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.e57"));
}

TEST(MovingScanVerb, InShardsHasThePointsOfTheWhole) {
  const TemporaryFolder folder;
  const Document document = withLoop();
  ASSERT_TRUE(run("scan", document, thinlyAlong(folder.path() / "whole.las")));
  std::uint64_t points = 0;
  for (int k = 1; k <= 3; ++k) {
    json options = thinlyAlong(folder.path() / ("part" + std::to_string(k) + ".las"));
    options["shard"] = std::to_string(k) + "/3";
    const auto part = run("scan", document, options);
    ASSERT_TRUE(part) << describe(part.error());
    points += part->answer["stations"][0]["points"].get<std::uint64_t>();
  }
  EXPECT_EQ(points, pointsOf(folder.path() / "whole.las").scans[0].points.size());
}

TEST(MovingScanVerb, KeepsItsScansWhenTheProjectChangedMeanwhile) {
  const Document base = withLoop();
  Job job = *base.job;
  job.trajectories[0].scans.push_back({.instrument = "velodyne-vlp-16", .file = "o.e57"});
  Document result = base;
  result.job = std::make_shared<const Job>(job);
  const auto newest = run("trajectory", base, loop("other"));
  ASSERT_TRUE(newest);
  const Document carried = findVerb(verbs(), "scan")->carry_over(base, result, newest->document);
  ASSERT_EQ(carried.job->trajectories.size(), 2U);
  EXPECT_EQ(carried.job->trajectories[0].scans.size(), 1U);
  EXPECT_TRUE(carried.job->trajectories[1].scans.empty());
}

TEST(MovingScanVerb, IsAnotherScanInAnotherPartAndByOtherPoses) {
  const TemporaryFolder folder;
  const Document document = withLoop();
  std::set<std::string> guids;
  for (const auto& [key, value] : {std::pair{"shard", "1/40"}, {"shard", "2/40"}, {"deskew", "none"}}) {
    json options = thinlyAlong(folder.path() / (std::string(key) + std::to_string(guids.size()) + ".e57"));
    options["shard"] = "1/40";
    options[key] = value;
    ASSERT_TRUE(run("scan", document, options));
    guids.insert(pointsOf(options["output"].get<std::string>()).scans[0].header.guid);
  }
  EXPECT_EQ(guids.size(), 3U);
}

TEST(MovingScanVerb, GoesAlongAFile) {
  const TemporaryFolder folder;
  std::ofstream file(folder.path() / "walk.tum");
  file.precision(12);
  for (int k = 0; k <= 100; ++k) file << k * 0.01 << " " << 500001 + 0.01 * k << " 5600001 1.4 0 0 0 1\n";
  file.close();
  json options = thinlyAlong(folder.path() / "o.e57");
  options["trajectory"] = (folder.path() / "walk.tum").string();
  options["ideal"] = true;
  const auto outcome = run("scan", twoStoreyDocument(), options);
  ASSERT_TRUE(outcome) << describe(outcome.error());
  EXPECT_NEAR(outcome->answer["stations"][0]["instrument_seconds"].get<double>(), 1, 1e-9);
  EXPECT_GT(outcome->answer["stations"][0]["points"].get<std::uint64_t>(), 10000U);
}

TEST(MovingScanVerb, RefusesWhatBelongsToStations) {
  const TemporaryFolder folder;
  const Document document = withLoop();
  const auto refused = [&](const char* key, const json& value, const char* words) {
    json options = thinlyAlong(folder.path() / "o.e57");
    options[key] = value;
    const auto outcome = run("scan", document, options);
    ASSERT_FALSE(outcome) << key;
    EXPECT_NE(describe(outcome.error()).find(words), std::string::npos) << describe(outcome.error());
  };
  refused("instrument", "leica-rtc360", "stands on a tripod");
  refused("trajectory", "nowhere", "unknown trajectory 'nowhere'");
  refused("stations", "S1", "belongs to stations");
  refused("panorama", true, "belongs to stations");
  refused("field-fault", {"until=0.5"}, "belongs to stations");
  refused("resume", true, "belongs to stations");
  refused("mounting", {"left=1"}, "must be x, y, z");
  refused("mounting-error", {"clock=soon"}, "must be a number");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "o.e57"));
}

}  // namespace
}  // namespace standpoint
