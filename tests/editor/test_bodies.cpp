// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "core/units.h"
#include "editor/bodies/standing.h"
#include "editor/bodies/tripod.h"
#include "survey/instruments.h"

namespace standpoint {
namespace {

struct Box {
  Eigen::Vector3f min = Eigen::Vector3f::Constant(1e9F), max = Eigen::Vector3f::Constant(-1e9F);
  void add(const BodyMesh& mesh) {
    for (const auto& p : mesh.positions) min = min.cwiseMin(p), max = max.cwiseMax(p);
  }
  Eigen::Vector3f size() const { return max - min; }
};

Box boxOf(const InstrumentBody& body) {
  Box box;
  for (const auto* part : {&body.foot, &body.head}) box.add(*part);
  return box;
}

double volume(const BodyMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    sum += a.cast<double>().dot(b.cast<double>().cross(c.cast<double>())) / 6;
  }
  return sum;
}

// Edges that are not walked once each way.
std::size_t openEdges(const BodyMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> walked;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      walked[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return static_cast<std::size_t>(
      std::count_if(walked.begin(), walked.end(), [](const auto& e) { return e.second != 0; }));
}

TEST(InstrumentBodies, AreClosedSolidsOfAtMostTwoThousandTrianglesWithTheirTripod) {
  for (const auto& body : instrumentBodies()) {
    const auto tripod = tripodOf(body, 1.7);
    std::size_t triangles = 0;
    for (const auto* mesh : {&body.foot, &body.head, &body.mirror, &tripod}) {
      triangles += mesh->triangles.size();
      EXPECT_EQ(mesh->paints.size(), mesh->triangles.size()) << body.id;
      EXPECT_EQ(openEdges(*mesh), 0U) << body.id;
    }
    EXPECT_GT(volume(body.head), 0) << body.id;
    EXPECT_GT(volume(tripod), 0) << body.id;
    EXPECT_LE(triangles, 2000U) << body.id;
  }
}

// Data sheets' outer sizes (width over depth over height, mm), or their diameter.
TEST(InstrumentBodies, AreAsLargeAsTheirDataSheetsSay) {
  struct Row {
    const char* instrument;
    double wide, deep, high;
  };
  for (const auto& row :
       {Row{"leica-rtc360", 240, 120, 230}, Row{"leica-blk360-g1", 100, 100, 165}, Row{"leica-blk360-g2", 80, 80, 155},
        Row{"leica-p40", 358, 238, 395}, Row{"faro-focus-s350", 230, 103, 187}, Row{"trimble-x7", 178, 170, 353},
        Row{"riegl-vz-400i", 206, 206, 308}}) {
    const auto size = boxOf(bodyOf(row.instrument)).size();
    const bool has_camera = std::string_view(row.instrument) == "riegl-vz-400i";  // on its lid
    EXPECT_NEAR(size.y(), row.wide / 1000, 0.012) << row.instrument;
    EXPECT_NEAR(size.x(), row.deep / 1000, 0.012) << row.instrument;
    EXPECT_NEAR(size.z() - (has_camera ? 0.056 : 0), row.high / 1000, 0.008) << row.instrument;
  }
}

TEST(InstrumentBodies, EveryInstrumentOnATripodHasOneAndTheDevicesHaveTheirOwn) {
  const auto known = knownInstruments();
  ASSERT_TRUE(known);
  std::set<std::string_view> used;
  for (const auto& instrument : *known)
    if (!instrument.moving) used.insert(bodyOf(instrument.id).id);
  EXPECT_EQ(used.size(), instrumentBodies().size());
  EXPECT_EQ(bodyOf("").id, "generic");
  EXPECT_EQ(bodyOf("my-own-scanner").id, "generic");
  EXPECT_EQ(bodyOf("leica-blk2go").id, "generic");
}

TEST(Tripods, StandOnTheFloorUnderTheFootAndNeverBelowIt) {
  for (const auto& body : instrumentBodies())
    for (const double height : {0.1, 0.2, 0.3, 0.5, 0.9, 1.7, 2.4}) {
      const auto tripod = tripodOf(body, height);
      if (tripod.positions.empty()) continue;
      Box box;
      box.add(tripod);
      EXPECT_GE(box.min.z(), -height - 0.006) << body.id << ' ' << height;
      EXPECT_LE(box.max.z(), -body.foot_m + 0.016) << body.id << ' ' << height;
      if (height > 0.3) EXPECT_NEAR(box.min.z(), -height, 0.006) << body.id << ' ' << height;
      EXPECT_NEAR(box.max.z(), -body.foot_m, 0.016) << body.id << ' ' << height;
    }
}

Job jobOf(std::size_t stations) {
  Job job;
  for (std::size_t i = 0; i < stations; ++i) {
    Station s;
    s.name = "K" + std::to_string(i);
    s.instrument_height_m = 1.6;
    s.true_pose.translation = {3.0 * static_cast<double>(i), 0, 1.6};
    job.stations.push_back(std::move(s));
  }
  return job;
}

const auto kAll = [](const Station&) { return true; };

TEST(StandingInstruments, ShowTheDesksElseTheNewestScansElseThePlannedOne) {
  auto job = jobOf(3);
  job.stations[1].scans.resize(2);
  job.stations[1].scans[0].instrument = "leica-rtc360";
  job.stations[1].scans[1].instrument = "faro-focus-s70";
  StandingKeeper keeper;
  HeldInstrument held;
  held.instrument = "riegl-vz-400i";
  held.station = "K2";
  held.motion.head_rad = 1;
  const auto scene = keeper.of(job, held, "trimble-x7", {0, -10, 1.6}, kAll);
  ASSERT_TRUE(scene.still && scene.working);
  ASSERT_EQ(scene.still->still.size(), 2U);
  EXPECT_EQ(scene.still->still[0].body->id, "trimble-x7") << "which would scan there";
  EXPECT_EQ(scene.still->still[1].body->id, "faro-focus");
  EXPECT_EQ(scene.working->stands.body->id, "riegl-vz");
  EXPECT_EQ(scene.working->motion.head_rad, 1);
  EXPECT_EQ(scene.working->stands.centre_m.x(), 6);
}

TEST(StandingInstruments, KeepTheirPointerWhileNothingChangesAndLeaveOutTheOneThatIsLookedOutOf) {
  const auto job = jobOf(3);
  StandingKeeper keeper;
  const auto first = keeper.of(job, {}, "", {0, -10, 1.6}, kAll), again = keeper.of(job, {}, "", {1, -9, 1.6}, kAll);
  EXPECT_EQ(first.still, again.still);
  EXPECT_EQ(keeper.of(job, {}, "", {3, 0.05, 1.6}, kAll).still->still.size(), 2U);
  EXPECT_EQ(keeper.of(job, {}, "", {0, -10, 1.6}, [](const Station& s) { return s.name == "K1"; }).still->still.size(),
            1U);
  EXPECT_EQ(keeper.of({}, {}, "", {0, 0, 0}, kAll).still, nullptr);
  const auto planned = keeper.of(job, {}, "faro-focus-s350", {0, -10, 1.6}, kAll);
  EXPECT_NE(planned.still, first.still) << "another instrument is chosen";
  EXPECT_EQ(first.still->still[0].body->id, "generic") << "none is";
}

TEST(StandingInstruments, OfManyAreTheNearest) {
  const auto job = jobOf(3 * kMostInstruments);
  StandingKeeper keeper;
  const auto scene = keeper.of(job, {}, "", {0, -1, 1.6}, kAll);
  ASSERT_EQ(scene.still->still.size(), kMostInstruments);
  EXPECT_EQ(scene.still->still.back().centre_m.x(), 3.0 * (kMostInstruments - 1));
}

}  // namespace
}  // namespace standpoint
