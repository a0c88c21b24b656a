// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "pointclouds/formats.h"
#include "project/storage/project_files.h"
#include "survey/movers/moving_world.h"
#include "tests/pointclouds/kept_scans.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using nlohmann::json;
using standpoint::testing::KeptScans;

json passerby() {
  return {{"add", "Ada"}, {"through", {"500001,5600001", "500005,5600001:0.5", "500005,5600002"}}, {"repeat", true}};
}

Document after(Document document, const std::vector<std::pair<const char*, json>>& steps) {
  for (const auto& [verb, options] : steps) {
    auto outcome = run(verb, document, options);
    EXPECT_TRUE(outcome) << verb << describe(outcome.error());
    if (outcome) document = outcome->document;
  }
  return document;
}

KeptScans scanOf(const Document& document, json options, const std::filesystem::path& file) {
  options["output"] = file.string(), options["truth"] = true;
  const auto scanned = run("scan", document, options);
  EXPECT_TRUE(scanned) << describe(scanned.error());
  KeptScans kept;
  EXPECT_TRUE(standpoint::testing::readAll(file, kept));
  return kept;
}

// Points on products of that class, and how many of them are flagged as moving.
std::pair<std::size_t, std::size_t> of(const KeptScans& kept, const std::string& ifc_class) {
  std::size_t points = 0, moving = 0;
  for (const auto& scan : kept.scans)
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const std::uint32_t product = scan.points.product[i];
      if (product >= scan.header.products.size() || scan.header.products[product].ifc_class != ifc_class) continue;
      ++points;
      moving += (scan.points.truth.flags[i] & point_flag::kMoving) != 0 ? 1 : 0;
    }
  return {points, moving};
}

const json kQuick = {{"instrument", "faro-focus-s350"}, {"set", {"resolution=1/32", "quality=4x"}}};

TEST(MoverVerb, KeepsEachKindWithTheProject) {
  const TemporaryFolder folder;
  const Document made = after(
      twoStoreyDocument(),
      {{"mover", passerby()},
       {"mover", {{"add", "Van"}, {"kind", "vehicle"}, {"through", {"500001,5600003", "500003,5600003"}}}},
       {"mover",
        {{"add", "Carousel"},
         {"kind", "turning"},
         {"product", {"table"}},
         {"axis-at", {500004.5, 5600003, 0}},
         {"turn", 30}}},
       {"mover", {{"add", "Lift"}, {"kind", "sliding"}, {"product", {"slab1"}}, {"axis", {0, 0, -1}}, {"way", 0.5}}}});
  Progress progress;
  ASSERT_TRUE(saveProject(made, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  ASSERT_EQ(back->job->movers.size(), 4U);
  EXPECT_EQ(back->job->movers, made.job->movers);
  const auto list = run("mover", *back, json::object());
  ASSERT_TRUE(list);
  EXPECT_EQ(list->answer["movers"][1]["kind"], "vehicle");
  EXPECT_GT(list->answer["movers"][1]["seconds"].get<double>(), 1);
  EXPECT_TRUE(list->answer["movers"][0]["seconds"].is_null());  // there and back again
}

TEST(MoverVerb, PutsPeopleIntoScansThatAskForThem) {
  const TemporaryFolder folder;
  const Document made =
      after(twoStoreyDocument(), {{"station", {{"add", "S1"}, {"on", {500003, 5600003, 0}}}}, {"mover", passerby()}});
  const auto seen = of(scanOf(made, kQuick, folder.path() / "with.e57"), "Person");
  EXPECT_GT(seen.first, 50U);
  EXPECT_EQ(seen.second, seen.first);
  json without = kQuick;
  without["movers"] = "off";
  EXPECT_EQ(of(scanOf(made, without, folder.path() / "without.e57"), "Person").first, 0U);
  // Another second is another scan.
  json later = kQuick;
  later["movers-from"] = 2.5;
  const auto other = scanOf(made, later, folder.path() / "later.e57");
  EXPECT_NE(other.scans[0].header.guid, scanOf(made, kQuick, folder.path() / "again.e57").scans[0].header.guid);
}

// The laser's turn takes 64 s, and the images come after it. Somebody who leaves at 60 s is, for them, where they are
// ever after, and for the laser where they were before.
TEST(MoverVerb, PutsPeopleIntoImagesWhereTheyAreAfterTheLasersTurn) {
  const TemporaryFolder folder;
  const Document made =
      after(twoStoreyDocument(), {{"station", {{"add", "S1"}, {"on", {500003, 5600003, 0}}}},
                                  {"mover", {{"add", "Ada"}, {"through", {"500001,5600001:60", "500004,5600001"}}}}});
  const auto scanned = [&](const char* name, const json& more) {
    json options = kQuick;
    options["set"].push_back("colour=on");
    options["panorama"] = true, options["panorama-size"] = 512;
    options.update(more);
    return scanOf(made, options, folder.path() / name);
  };
  const auto pictureIn = [](const KeptScans& kept) {
    return kept.pictures.empty() ? std::vector<std::uint8_t>() : kept.pictures[0][0].bytes;
  };
  const auto leaves = scanned("leaves.e57", json::object()), left = scanned("left.e57", {{"movers-from", 1000}});
  const auto nobody = scanned("nobody.e57", {{"movers", "off"}});
  ASSERT_FALSE(pictureIn(leaves).empty());
  EXPECT_EQ(pictureIn(leaves), pictureIn(left));
  EXPECT_NE(pictureIn(leaves), pictureIn(nobody));
  EXPECT_NE(leaves.scans[0].points.x_m, left.scans[0].points.x_m);
}

// By which a point is laid back to where its surface was.
TEST(MoverVerb, GivesEachPointItsTimeWhereSomethingMoves) {
  const TemporaryFolder folder;
  const Document made =
      after(twoStoreyDocument(), {{"station", {{"add", "S1"}, {"on", {500003, 5600003, 0}}}}, {"mover", passerby()}});
  for (const auto& [movers, timed] : {std::pair{"on", true}, {"off", false}}) {
    json options = kQuick;
    options["movers"] = movers, options["output"] = (folder.path() / (std::string(movers) + ".e57")).string();
    ASSERT_TRUE(run("scan", made, options));
    KeptScans kept;
    ASSERT_TRUE(standpoint::testing::readAll(folder.path() / (std::string(movers) + ".e57"), kept));
    EXPECT_EQ(kept.scans[0].header.has_time, timed) << movers;
    EXPECT_EQ(kept.scans[0].points.time_s.empty(), !timed) << movers;
  }
}

// Ada is where the clock of the project's second scan has brought her.
TEST(MoverVerb, GoesOnWhileTheCrewGetsToTheNextStation) {
  const TemporaryFolder folder;
  const Document made = after(twoStoreyDocument(), {{"station", {{"add", "S1"}, {"on", {500003, 5600003, 0}}}},
                                                    {"station", {{"add", "S2"}, {"on", {500003, 5600003, 0}}}},
                                                    {"mover", passerby()}});
  const auto kept = scanOf(made, kQuick, folder.path() / "both.e57");
  ASSERT_EQ(kept.scans.size(), 2U);
  const ScanHeader& second = kept.scans[1].header;
  const double began_s = second.acquisition_start_gps_s - kept.scans[0].header.acquisition_start_gps_s;
  EXPECT_NEAR(began_s, kept.scans[0].header.acquisition_seconds + 60, 1e-6);
  const auto path = moverPath(made.job->movers[0]);
  ASSERT_TRUE(path);
  std::size_t seen = 0, away = 0;  // from where the clock of each scan alone would have her
  for (std::size_t i = 0; i < kept.scans[1].points.size(); ++i) {
    const PointBlock& b = kept.scans[1].points;
    if (second.products[b.product[i]].ifc_class != "Person") continue;
    const Eigen::Vector3d place =
        truePose(second) * Eigen::Vector3d(b.truth.x_m[i], b.truth.y_m[i], b.truth.z_m[i]) - made.georeference->shift_m;
    const auto off = [&](double clock_s) { return (place - (*path)->pose(clock_s).translation).head<2>().norm(); };
    EXPECT_LT(off(began_s + b.time_s[i]), 0.6);
    ++seen, away += off(b.time_s[i]) > 0.6 ? 1 : 0;
  }
  EXPECT_GT(seen, 50U);
  EXPECT_GT(away, 50U);
}

TEST(MoverVerb, ScansAStationAtItsTimeWithTheOthersOrAlone) {
  const TemporaryFolder folder;
  const Document made = after(twoStoreyDocument(), {{"station", {{"add", "S1"}, {"on", {500003, 5600003, 0}}}},
                                                    {"station", {{"add", "S2"}, {"on", {500002, 5600003, 0}}}},
                                                    {"mover", passerby()}});
  const auto scanned = [&](const char* name, json options) {
    options.update(kQuick);
    options["output"] = (folder.path() / name).string();
    const auto outcome = run("scan", made, options);
    EXPECT_TRUE(outcome) << describe(outcome.error());
    return standpoint::testing::bytesOf(folder.path() / name / "S2.e57");
  };
  const std::string whole = scanned("whole", json::object());
  ASSERT_GT(whole.size(), 1000U);
  EXPECT_TRUE(scanned("alone", {{"stations", "S2"}}) == whole);
  EXPECT_TRUE(scanned("shard", {{"shard", "2/2"}}) == whole);
  EXPECT_TRUE(scanned("one thread", {{"threads", 1}}) == whole);
  EXPECT_FALSE(scanned("at once", {{"movers-from", 0}}) == whole);
}

TEST(MoverVerb, TurnsAProductOfTheModel) {
  const TemporaryFolder folder;
  const Document made = after(twoStoreyDocument(), {{"station", {{"add", "S1"}, {"on", {500002, 5600002, 0}}}},
                                                    {"mover",
                                                     {{"add", "Carousel"},
                                                      {"kind", "turning"},
                                                      {"product", {"table"}},
                                                      {"axis-at", {500004.5, 5600003, 0}},
                                                      {"turn", 90}}}});
  const auto kept = scanOf(made, kQuick, folder.path() / "s.e57");
  const auto seen = of(kept, "IfcFurniture");
  EXPECT_GT(seen.first, 50U);
  EXPECT_EQ(seen.second, seen.first);
  double farthest = 0;  // from the axis: corners sweep half of the diagonal
  const auto& scan = kept.scans[0];
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if ((scan.points.truth.flags[i] & point_flag::kMoving) != 0) {
      const Eigen::Vector3d place =
          truePose(scan.header) *
          Eigen::Vector3d(scan.points.truth.x_m[i], scan.points.truth.y_m[i], scan.points.truth.z_m[i]);
      farthest = std::max(farthest, (place - Eigen::Vector3d(500004.5, 5600003, place.z())).norm());
    }
  EXPECT_LT(farthest, std::sqrt(0.5) + 1e-3);
}

TEST(MoverVerb, OpensADoorByItsLeaf) {
  const TemporaryFolder folder;
  auto imported = run("import", {}, {{"files", {(samplesFolder() / "house.ifc").string()}}});
  ASSERT_TRUE(imported) << describe(imported.error());
  std::string door;
  for (const auto& p : imported->document.environment()->products)
    if (p.ifc_class == "IfcDoor" && door.empty()) door = p.global_id;
  ASSERT_FALSE(door.empty());
  const Document made =
      after(imported->document, {{"station", {{"add", "S1"}, {"on", {4.3, 1.6, 0}}}},
                                 {"mover", {{"add", "Door"}, {"kind", "door"}, {"product", {door}}, {"turn", 20}}}});
  const auto seen = of(scanOf(made, kQuick, folder.path() / "s.e57"), "IfcDoor");
  EXPECT_GT(seen.first, seen.second);  // frames, and other doors, stand still
}

TEST(MoverVerb, ShowsWhoCarriesTheScanner) {
  const TemporaryFolder folder;
  const Document made = after(twoStoreyDocument(),
                              {{"trajectory", {{"add", "walk"}, {"through", {"500002,5600001", "500003,5600001"}}}}});
  json along = {{"trajectory", "walk"}, {"instrument", "leica-blk2go"}};
  const auto seen = of(scanOf(made, along, folder.path() / "with.e57"), "Operator");
  EXPECT_GT(seen.first, 1000U);
  EXPECT_EQ(seen.second, seen.first);
  along["operator"] = "off";
  EXPECT_EQ(of(scanOf(made, along, folder.path() / "without.e57"), "Operator").first, 0U);
}

TEST(MoverVerb, ShowsWhoCarriedAnImportedTrajectoryWhereACarrierIsStated) {
  const TemporaryFolder folder;
  Document made = after(twoStoreyDocument(),
                        {{"trajectory", {{"add", "walk"}, {"through", {"500002,5600001", "500003,5600001"}}}}});
  const std::string file = (folder.path() / "walk.csv").string();
  made = after(made, {{"trajectory", {{"write", "walk"}, {"output", file}}},
                      {"trajectory", {{"add", "held"}, {"file", file}, {"carrier", "hand"}}},
                      {"trajectory", {{"add", "flown"}, {"file", file}, {"carrier", "uav"}}},
                      {"trajectory", {{"add", "nobody"}, {"file", file}}}});
  const auto seenAlong = [&](const std::string& trajectory) {
    const json along = {{"trajectory", trajectory}, {"instrument", "leica-blk2go"}};
    return of(scanOf(made, along, folder.path() / "s.e57"), "Operator").first;
  };
  const auto by_waypoints = static_cast<double>(seenAlong("walk"));
  // The same person, whose way is found from where the scanner was instead of through waypoints.
  EXPECT_NEAR(static_cast<double>(seenAlong("held")), by_waypoints, 0.25 * by_waypoints);
  EXPECT_EQ(seenAlong("flown"), 0U);
  EXPECT_EQ(seenAlong("nobody"), 0U);
  EXPECT_EQ(seenAlong(file), 0U);
}

TEST(MoverVerb, LetsACrowdWalkOnTheWalkableSurface) {
  const auto none = run("mover", twoStoreyDocument(), {{"add", "crowd"}, {"kind", "crowd"}});
  ASSERT_FALSE(none);
  EXPECT_NE(describe(none.error()).find("'collide' first"), std::string::npos);
  const Document made = after(twoStoreyDocument(), {{"collide", json::object()},
                                                    {"mover", {{"add", "crowd"}, {"kind", "crowd"}, {"count", 12}}}});
  ASSERT_GE(made.job->movers.size(), 10U);
  for (const Mover& mover : made.job->movers) {
    ASSERT_GT(mover.way_m.size(), 100U);
    for (const Eigen::Vector3d& place : mover.way_m) {
      EXPECT_TRUE(place.x() > 0 && place.x() < 6) << place;
      EXPECT_TRUE(place.y() > 0 && place.y() < 4) << place;
    }
  }
  const auto again = after(twoStoreyDocument(), {{"collide", json::object()},
                                                 {"mover", {{"add", "crowd"}, {"kind", "crowd"}, {"count", 12}}}});
  EXPECT_EQ(again.job->movers, made.job->movers);
  const auto removed = run("mover", made, {{"remove", "crowd"}});
  ASSERT_TRUE(removed);
  EXPECT_TRUE(removed->document.job->movers.empty());
}

TEST(MoverVerb, KeepsTheWaysOfACrowdWithTheProject) {
  const TemporaryFolder folder;
  const Document made = after(twoStoreyDocument(), {{"collide", json::object()},
                                                    {"station", {{"add", "S1"}, {"on", {500003, 5600003, 0}}}},
                                                    {"mover", {{"add", "crowd"}, {"kind", "crowd"}, {"count", 3}}}});
  Progress progress;
  ASSERT_TRUE(saveProject(made, folder.path() / "p", progress));
  const auto back = loadProject(folder.path() / "p", progress);
  ASSERT_TRUE(back) << describe(back.error());
  EXPECT_EQ(back->job->movers, made.job->movers);
  const auto bytesFrom = [&](const Document& document, const char* name) {
    json options = kQuick;
    options["output"] = (folder.path() / name).string();
    const auto ran = run("scan", document, options);
    EXPECT_TRUE(ran) << describe(ran.error());
    return standpoint::testing::bytesOf(folder.path() / name);
  };
  const std::string of_memory = bytesFrom(made, "memory.e57");
  ASSERT_GT(of_memory.size(), 1000U);
  EXPECT_TRUE(of_memory == bytesFrom(*back, "disk.e57"));
}

// Centres by the ways alone: between them it is some millimetres (Crowd tests).
TEST(MoverVerb, LetsACrowdGiveWayToTripodsToEachOtherAndToWhoCarriesAScanner) {
  const Document base = after(twoStoreyDocument(),
                              {{"collide", json::object()},
                               {"station", {{"add", "S1"}, {"on", {500001.5, 5600002, 0}}}},
                               {"trajectory", {{"add", "walk"}, {"through", {"500001,5600001", "500005,5600001"}}}}});
  const json crowd = {{"add", "crowd"}, {"kind", "crowd"}, {"count", 8}, {"gives-way-to", {"walk"}}};
  const Document made = after(base, {{"mover", crowd}});
  const auto& movers = made.job->movers;
  ASSERT_GE(movers.size(), 6U);
  for (std::size_t step = 0; step < movers[0].way_m.size(); ++step)
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const Eigen::Vector3d& at = movers[i].way_m[step];
      for (std::size_t k = 0; k < i; ++k)
        if (std::abs(at.z() - movers[k].way_m[step].z()) < 1) {
          EXPECT_GT((at - movers[k].way_m[step]).head<2>().norm(), 0.5);
        }
      if (at.z() < 1) {
        EXPECT_GT((at.head<2>() - Eigen::Vector2d(1.5, 2)).norm(), 0.7);
      }
    }
  json without = crowd;
  without.erase("gives-way-to");
  EXPECT_NE(after(base, {{"mover", without}}).job->movers, movers);
}

TEST(MoverVerb, RefusesWhatCannotMoveWithARemedy) {
  const Document made = after(twoStoreyDocument(), {{"mover", passerby()}});
  const auto refused = [&](const json& options, const char* words) {
    const auto outcome = run("mover", made, options);
    ASSERT_FALSE(outcome) << options;
    EXPECT_NE(describe(outcome.error()).find(words), std::string::npos) << describe(outcome.error());
  };
  refused(passerby(), "already");
  refused({{"add", "B"}, {"through", {"500001,5600001"}}}, "at least two places");
  refused({{"add", "B"}, {"through", {"500001,5600001", "500100,5600001"}}}, "no floor");
  refused({{"add", "B"}, {"kind", "door"}, {"product", {"table"}}}, "no door with a leaf");
  refused({{"add", "B"}, {"kind", "turning"}, {"product", {"chair"}}, {"axis-at", {0, 0, 0}}}, "no product 'chair'");
  refused({{"add", "B"}, {"kind", "turning"}, {"product", {"table"}}}, "where its axis is");
  refused({{"add", "B"}, {"kind", "turning"}, {"product", {"table"}}, {"axis-at", {0, 0, 0}}, {"axis", {0, 0, 0}}},
          "no direction");
  refused({{"add", "B"}, {"kind", "sliding"}, {"product", {"table"}}}, "how far it slides");
  refused({{"add", "B"}, {"kind", "sliding"}, {"product", {"table"}}, {"turn", 5}}, "--speed and --way");
  refused({{"add", "a/b"}, {"through", {"500001,5600001", "500002,5600001"}}}, "cannot be a mover's name");
  refused({{"add", "B"}, {"through", {"500001,5600001", "500002,5600001"}}, {"gives-way-to", {"walk"}}},
          "only a crowd gives way");
  refused({{"remove", "Bob"}}, "available: Ada");
  refused({{"through", {"500001,5600001", "500002,5600001"}}}, "name the new mover");
}

TEST(MoverVerb, SaysWhichMoverTheModelHasLost) {
  const TemporaryFolder folder;
  Document made = after(twoStoreyDocument(), {{"station", {{"add", "S1"}, {"on", {500003, 5600003, 0}}}}});
  Job job = *made.job;
  job.movers.push_back({.name = "Gate", .kind = MoverKind::sliding, .products = {"gone"}, .extent = 1});
  made.job = std::make_shared<const Job>(job);
  json options = kQuick;
  options["output"] = (folder.path() / "s.e57").string();
  const auto scanned = run("scan", made, options);
  ASSERT_FALSE(scanned);
  EXPECT_NE(describe(scanned.error()).find("no product 'gone' any more"), std::string::npos);
}

}  // namespace
}  // namespace standpoint
