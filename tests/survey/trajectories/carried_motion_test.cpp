// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/trajectories/carried_motion.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/data_folder.h"
#include "survey/trajectories/trajectory_file.h"
#include "tests/project/support.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using Eigen::Vector3d;

// Evenly along x, 1.5 m up, 1 m/s.
CarriedMotion alongX(double from_m, double to_m) {
  Trajectory samples;
  for (int k = 0; k <= 20; ++k) {
    samples.time_s.push_back((to_m - from_m) * k / 20);
    samples.pose.push_back({Eigen::Quaterniond::Identity(), {from_m + samples.time_s.back(), 0, 1.5}});
  }
  CarriedMotion carried;
  carried.path = carried.truth = std::make_shared<const PoseSpline>(*PoseSpline::through(samples));
  carried.length_m = to_m - from_m;
  return carried;
}

// σ of the position at the end of the path, by axes, of a walk that drifts alike in all directions where surfaces face
// all of them.
Vector3d expectedAtTheEnd(const std::shared_ptr<const Environment>& environment, const CarriedMotion& carried) {
  Progress progress;
  const auto scene = *RayScene::build(environment, progress);
  const ErrorProfile drifts{.id = "drifts", .name = "Drifts", .drift_m_sqrt_m = 0.0014};
  const MotionSolving solving{.profile = &drifts, .max_range_m = 25};
  const auto expected = expectedMotion(carried, *scene, {}, solving, progress);
  EXPECT_TRUE(expected) << describe(expected.error());
  return expected ? expected->back().position_m : Vector3d(Vector3d::Zero());
}

std::shared_ptr<Environment> withConcrete() {
  auto environment = std::make_shared<Environment>();
  environment->surfaces.push_back({"Concrete", {0.6F, 0.6F, 0.6F, 1}, "#1", {}, {}});
  return environment;
}

// 20 m along x, back 1 m beside it, at 1 m/s.
CarriedMotion alongAndBack() {
  Trajectory samples;
  for (int k = 0; k <= 41; ++k) {
    const double back = std::clamp(k - 20.0, 0.0, 1.0);
    samples.time_s.push_back(k);
    samples.pose.push_back({Eigen::Quaterniond::Identity(), {k <= 20 ? k : 41.0 - k, back, 1.5}});
  }
  CarriedMotion carried;
  carried.path = carried.truth = std::make_shared<const PoseSpline>(*PoseSpline::through(samples));
  return carried;
}

TEST(CarriedMotion, IsAsLongAsTheWayOfWhoWalksWithIt) {
  const TemporaryFolder folder;
  CarriedTrajectory walk;
  walk.name = "walk";
  walk.waypoints = {{{0, 0, 0}, 10, {}}, {{6, 0, 0}, 20, {}}, {{6, 4, 0}, {}, {}}};
  Report report;
  Progress progress;
  const Georeference local;
  const auto laid = carriedMotion(walk, local, report, progress);
  ASSERT_TRUE(laid) << describe(laid.error());
  const auto* format = trajectoryFormat("csv");
  walk.file = folder.path() / "walk.csv";
  const auto frame = *fileFrame(local, "csv");
  ASSERT_TRUE(format->write(walk.file, evenSamples(*laid->truth, 200), frame));
  walk.waypoints.clear();
  const auto read = carriedMotion(walk, local, report, progress);
  ASSERT_TRUE(read) << describe(read.error());
  EXPECT_NEAR(laid->length_m, 10, 0.1);
  EXPECT_NEAR(read->length_m, laid->length_m, 0.2) << "steps, shaking and half a minute of standing are no way";
  walk.carrier = "trolley";
  EXPECT_GT(carriedMotion(walk, local, report, progress)->length_m, 1.1 * read->length_m) << "as the file has it";
}

TEST(CarriedMotion, MeetsAClosedDoorOnceAsAHintAndNotWhereAMoverOpensIt) {
  const auto house = withConcrete();
  addBox(*house, "floor", "IfcSlab", {-1, -2, -0.2}, {6, 2, 0});
  addBox(*house, "door", "IfcDoor", {2, -0.5, 0}, {2.06, 0.5, 2.1});
  addBox(*house, "wall", "IfcWall", {4, -2, 0}, {4.2, 2, 2.5});
  Progress progress;
  const auto scene = *RayScene::build(house, progress);
  const auto met = obstaclesOf(alongX(0, 5), *scene);
  ASSERT_EQ(met.size(), 3U) << "the door once, both faces of the wall";
  EXPECT_TRUE(met[0].closed_door);
  EXPECT_NEAR(met[0].place_m.x(), 2, 1e-3);
  EXPECT_FALSE(met[1].closed_door || met[2].closed_door);
  Report report;
  const Georeference local;
  findObstacles(alongX(0, 3), *scene, local, "W1", {}, report);
  ASSERT_EQ(report.issues.size(), 1U);
  EXPECT_EQ(report.issues.front().severity, Severity::note);
  EXPECT_NE(report.issues.front().message.find("a scan finds IfcDoor"), std::string::npos);
  Mover mover;
  mover.kind = MoverKind::door;
  mover.products = {house->products[met[0].product].id};
  EXPECT_TRUE(obstaclesOf(alongX(0, 3), *scene, openedDoors(std::vector{mover})).empty());
}

TEST(CarriedMotion, IsNotHeldByWhatIsBehindAWall) {
  const auto closures = [](bool wall) {
    const auto hall = withConcrete();
    addBox(*hall, "hall", "IfcBuildingElementProxy", {-2, -2, 0}, {24, 3, 3});
    if (wall) addBox(*hall, "wall", "IfcWall", {-2, 0.45, 0}, {19.5, 0.55, 3});
    Progress progress;
    return closuresOf(alongAndBack(), **RayScene::build(hall, progress), 25)->size();
  };
  EXPECT_GE(closures(false), 1U);
  EXPECT_EQ(closures(true), 0U);
}

// M20, by what rays from the path meet: the ends of the corridor are out of the scanner's range.
TEST(CarriedMotion, M20_DriftsFiveTimesAsMuchAlongABareCorridorAsAcross) {
  const auto corridor = withConcrete();
  addBox(*corridor, "floor", "IfcSlab", {-200, -2, -0.2}, {300, 2, 0});
  addBox(*corridor, "ceiling", "IfcSlab", {-200, -2, 2.7}, {300, 2, 2.9});
  addBox(*corridor, "south", "IfcWall", {-200, -1.3, 0}, {300, -1.1, 2.7});
  addBox(*corridor, "north", "IfcWall", {-200, 1.1, 0}, {300, 1.3, 2.7});
  const Vector3d sigma = expectedAtTheEnd(corridor, alongX(0, 70));
  EXPECT_NEAR(sigma.x(), 5 * 0.0014 * std::sqrt(70), 0.0006);
  EXPECT_NEAR(sigma.x() / std::min(sigma.y(), sigma.z()), 5, 0.5);
}

TEST(CarriedMotion, M20_DriftsAlikeInARoomLikeACube) {
  const auto room = withConcrete();
  addBox(*room, "room", "IfcBuildingElementProxy", {-3, -3, -1.5}, {3, 3, 4.5});
  const Vector3d sigma = expectedAtTheEnd(room, alongX(-1, 1));
  EXPECT_GE(sigma.minCoeff(), 0.0014 * std::sqrt(2) - 1e-6);
  EXPECT_LE(sigma.maxCoeff() / sigma.minCoeff(), 1.3);
}

// Walls close by and ends 70 m apart: the sample is as bare as a corridor can be but for the last metres.
TEST(CarriedMotion, DriftsNearlyAsMuchInTheSampleCorridor) {
  Progress progress;
  const auto imported =
      runVerb(*findVerb(verbs(), "import"), {}, {{"files", {(samplesFolder() / "corridor.ifc").string()}}}, progress);
  ASSERT_TRUE(imported) << describe(imported.error());
  const Vector3d sigma = expectedAtTheEnd(imported->document.environment(), alongX(2, 68));
  const double ratio = sigma.x() / sigma.y();
  EXPECT_GT(ratio, 4);
  EXPECT_LE(ratio, 5.5);
}

}  // namespace
}  // namespace standpoint
