// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "core/random.h"
#include "editor/inspect/clip_box.h"
#include "editor/inspect/inspected_clouds.h"
#include "editor/inspect/measuring.h"
#include "editor/inspect/model_deviation.h"
#include "editor/inspect/panorama_view.h"
#include "editor/inspect/point_colour.h"
#include "editor/inspect/point_picking.h"
#include "editor/inspect/snapping.h"
#include "editor/inspect/solved_poses.h"
#include "tests/project/support.h"

namespace standpoint {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ColourScale, HasFiveToSevenRoundTicksWithinAnyScale) {
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const auto random = philox({3, 0}, i, 0, 0);
    const double low = (uniform(random[0]) - 0.5) * 200, span = std::pow(10, 6 * uniform(random[1]) - 3);
    const auto ticks = roundTicks(low, low + span);
    EXPECT_GE(ticks.size(), 5u) << low << " " << span;
    EXPECT_LE(ticks.size(), 7u) << low << " " << span;
    EXPECT_GE(ticks.front(), low - 1e-6 * span);
    EXPECT_LE(ticks.back(), low + span * (1 + 1e-6));
    const auto texts = tickTexts(ticks);
    EXPECT_EQ(std::set<std::string>(texts.begin(), texts.end()).size(), ticks.size());
    for (std::size_t k = 0; k < ticks.size(); ++k) EXPECT_NEAR(std::stod(texts[k]), ticks[k], 1e-5 * span);
  }
}

TEST(ColourScale, WritesTicksAsPeopleDo) {
  EXPECT_EQ(tickTexts(roundTicks(0, 90)), (std::vector<std::string>{"0", "20", "40", "60", "80"}));
  EXPECT_EQ(tickTexts(roundTicks(-1, 1)), (std::vector<std::string>{"-1.0", "-0.5", "0.0", "0.5", "1.0"}));
}

CloudHeader header(std::uint32_t channels) {
  CloudHeader h;
  h.channels = channels;
  h.origin_m = {500000, 5600000, 0};
  CloudStation station{"S1", {}, 0, 2, 0, 0};
  station.file_from_scanner.translation = {500001.5, 5600001.5, 1.5};
  h.stations = {station, station};
  h.stations[1].name = "S2";
  h.materials = {"concrete", "glass"};
  h.products = {{"#1", "", "IfcWall", "north"}, {"#2", "", "IfcDoor", ""}};
  return h;
}

std::vector<CloudPoint> hundred() {
  std::vector<CloudPoint> points(100);
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& p = points[i];
    p.position_m = {1.5F, 1.5F + static_cast<float>(i) / 10, 1.5F};
    p.intensity = static_cast<std::uint16_t>(i * 655);
    p.product = p.material = static_cast<std::uint16_t>(i < 70 ? 0 : 1);
    p.station = static_cast<std::uint16_t>(i < 30 ? 0 : 1);
    p.incidence_deg = static_cast<std::uint8_t>(i < 90 ? i : kNoIncidence);
    p.residual_tenth_mm = static_cast<std::int16_t>(i < 50 ? -20 : 20);
    p.time_s = static_cast<float>(i);
  }
  return points;
}

Pose poseAt(const Eigen::Vector3d& place, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), place};
}

// S1 was registered 5 mm and 0.01 rad off, S2 was not registered; the scans have the frame of header().
Job halfRegistered() {
  Job job;
  for (const char* name : {"S1", "S2"}) {
    Station station;
    station.name = name;
    station.true_pose = poseAt({1.5, 1.5, 1.5}, 0);
    station.scans.push_back({.file = std::string(name) + ".e57"});
    job.stations.push_back(station);
  }
  job.stations[0].solved_pose = poseAt({1.505, 1.5, 1.5}, 0.01);
  return job;
}

TEST(SolvedPoses, MoveEachScanToWhereItsStationIsBelievedToBe) {
  const Job job = halfRegistered();
  const Eigen::Vector3d shift_m(500000, 5600000, 0);
  const std::vector<std::filesystem::path> files = {"both.e57"};
  const auto moves = solvedMoves(job, header(0), shift_m, files);
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_LT((moves[0] * Eigen::Vector3d(1.5, 1.5, 1.5) - Eigen::Vector3d(1.505, 1.5, 1.5)).norm(), 1e-9);
  EXPECT_LT(
      (moves[0] * Eigen::Vector3d(2.5, 1.5, 1.5) - Eigen::Vector3d(1.505 + std::cos(0.01), 1.5 + std::sin(0.01), 1.5))
          .norm(),
      1e-9)
      << "turned about the scanner";
  const Eigen::Vector3d anywhere(4, 5, 6);
  EXPECT_EQ(moves[1] * anywhere, anywhere) << "S2 was not registered";
}

TEST(SolvedPoses, KnowTheStationOfANamelessScanByItsFile) {
  const Job job = halfRegistered();
  auto nameless = header(0);
  for (auto& scan : nameless.stations) scan.name = "Scan 1";
  const Eigen::Vector3d shift_m(500000, 5600000, 0), place(1.5, 1.5, 1.5);
  const auto movedBy = [&](std::vector<std::filesystem::path> files, std::size_t scan) {
    return (solvedMoves(job, nameless, shift_m, files)[scan] * place - place).norm();
  };
  EXPECT_GT(movedBy({"S1.e57"}, 0), 0.004);
  EXPECT_EQ(movedBy({"S2.e57"}, 0), 0);
  EXPECT_EQ(movedBy({"other.e57"}, 0), 0);
  EXPECT_GT(movedBy({"S2.e57", "S1.e57"}, 1), 0.004) << "each scan has its file";
}

TEST(SolvedPoses, AreComparedWithTheTruth) {
  Job job = halfRegistered();
  const auto offsets = poseOffsets(job);
  ASSERT_EQ(offsets.size(), 2u);
  EXPECT_NEAR(offsets[0].moved_m, 0.005, 1e-9);
  EXPECT_NEAR(offsets[0].turned_rad, 0.01, 1e-9);
  EXPECT_FALSE(offsets[1].registered);
  EXPECT_TRUE(hasSolvedPose(job));
  job.stations[0].scans.clear();
  EXPECT_FALSE(hasSolvedPose(job)) << "a station without scans has nothing to show";
}

TEST(SolvedPoses, MoveThePointsAndTheStationsOfACloud) {
  Cloud cloud;
  cloud.header = header(0);
  cloud.shift_m = {500000, 5600000, 0};
  cloud.points = hundred();  // the first 30 are of S1
  const auto other = moved(cloud, {poseAt({0.5, 0, 0}, 0), Pose()});
  EXPECT_FLOAT_EQ(other.points[0].position_m[0], 2.0F);
  EXPECT_FLOAT_EQ(other.points[29].position_m[0], 2.0F);
  EXPECT_EQ(other.points[30].position_m, cloud.points[30].position_m);
  EXPECT_NEAR(other.header.stations[0].file_from_scanner.translation.x(), 500002, 1e-6);
  EXPECT_NEAR(other.header.stations[1].file_from_scanner.translation.x(), 500001.5, 1e-6);
}

constexpr std::uint32_t kAll = 63;

TEST(PointColour, SaysWhyAFileCannotBeColoured) {
  EXPECT_THAT(whyNotColoured(ColourBy::rgb, header(0)), HasSubstr("no colours"));
  EXPECT_THAT(whyNotColoured(ColourBy::residual, header(cloud_channel::kColour)), HasSubstr("no truth"));
  EXPECT_EQ(whyNotColoured(ColourBy::range, header(0)), "");
  auto nowhere = header(kAll);
  for (auto& s : nowhere.stations) s.file_from_scanner.translation = {500000, 5600000, 0};
  EXPECT_THAT(whyNotColoured(ColourBy::range, nowhere), HasSubstr("where the scanner stood"));
  for (const auto& row : coloursBy()) EXPECT_EQ(whyNotColoured(row.colour, header(kAll)), "") << row.id;
}

TEST(PointColour, HasALegendAndAColourForEachPointInEveryMode) {
  const auto points = hundred();
  const auto h = header(kAll);
  const std::vector<float> deviations(points.size(), 0.002F);
  for (const auto& row : coloursBy()) {
    const auto legend = legendOf(points, h, row.colour, deviations);
    const auto colours = paintPoints(points, h, row.colour, legend, deviations);
    EXPECT_EQ(colours.size(), points.size()) << row.id;
    EXPECT_EQ(legend.title, row.name);
    for (const auto& c : colours) EXPECT_EQ(c[3], 255) << row.id;
  }
}

TEST(PointColour, MeasuresRangeFromTheStationAndHeightInTheFrameOfTheFile) {
  const auto points = hundred();
  const auto range = legendOf(points, header(kAll), ColourBy::range);
  EXPECT_NEAR(range.low, 0.2, 0.02);
  EXPECT_NEAR(range.high, 9.7, 0.02);
  EXPECT_EQ(range.unit, "m");
  EXPECT_EQ(range.below, 2u);
  EXPECT_EQ(range.above, 2u);
  const auto height = legendOf(points, header(kAll), ColourBy::height);
  EXPECT_NEAR((height.low + height.high) / 2, 1.5, 1e-3);
}

TEST(PointColour, CentresSignedFiguresOnNothing) {
  const auto points = hundred();
  const auto legend = legendOf(points, header(kAll), ColourBy::residual);
  EXPECT_TRUE(legend.is_diverging);
  EXPECT_DOUBLE_EQ(legend.low, -2);
  EXPECT_DOUBLE_EQ(legend.high, 2);
  const auto colours = paintPoints(points, header(kAll), ColourBy::residual, legend);
  EXPECT_GT(colours[0][2], colours[0][0]);    // blue: too short
  EXPECT_GT(colours[99][0], colours[99][2]);  // orange: too long
}

TEST(PointColour, CountsWhatHasNoFigure) {
  const auto points = hundred();
  const auto legend = legendOf(points, header(kAll), ColourBy::incidence);
  EXPECT_EQ(legend.low, 0);
  EXPECT_EQ(legend.high, 90);
  EXPECT_EQ(legend.no_data, 10u);
  EXPECT_EQ(paintPoints(points, header(kAll), ColourBy::incidence, legend)[99], kNoDataColour);
}

TEST(PointColour, NamesTheClassesWithMostPointsFirst) {
  const auto points = hundred();
  const auto material = legendOf(points, header(kAll), ColourBy::material);
  ASSERT_EQ(material.classes.size(), 2u);
  EXPECT_EQ(material.classes[0].name, "concrete");
  EXPECT_EQ(material.classes[0].points, 70u);
  const auto station = legendOf(points, header(kAll), ColourBy::station);
  EXPECT_EQ(station.classes[0].name, "S2");
  EXPECT_EQ(legendOf(points, header(kAll), ColourBy::product).classes[1].name, "IfcDoor #2");
}

TEST(PointColour, ShowsTheWorstFlagOfAPointInAColourThatStaysTheSame) {
  auto points = hundred();
  points[0].flags = point_flag::kMixed | point_flag::kMirrored;
  points[1].flags = point_flag::kMixed;
  const auto legend = legendOf(points, header(kAll), ColourBy::flags);
  const auto colours = paintPoints(points, header(kAll), ColourBy::flags, legend);
  EXPECT_EQ(colours[0], classColour(2));
  EXPECT_EQ(colours[1], classColour(3));
  EXPECT_EQ(colours[2], kOtherColour);
  EXPECT_EQ(legend.classes[0].name, "one surface, seen directly");
}

TEST(PointColour, PaintsAPartOfACloudByTheLegendOfTheWhole) {
  const auto points = hundred();
  const auto legend = legendOf(points, header(kAll), ColourBy::intensity);
  const auto all = paintPoints(points, header(kAll), ColourBy::intensity, legend);
  const auto part = paintPoints(std::span(points).subspan(40, 20), header(kAll), ColourBy::intensity, legend);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), all.begin() + 40));
}

TEST(ModelDeviation, IsTheSignedDistanceToTheSurfaceThatFacesTheScanner) {
  const Document d = twoStoreyDocument();
  auto h = header(kAll);
  std::vector<CloudPoint> points(4);
  points[0].position_m = {3, 0.01F, 1.5F};   // 1 cm before the south wall, inside of the room
  points[1].position_m = {3, -0.02F, 1.5F};  // 2 cm in the wall
  points[2].position_m = {3, 2, -40};        // nowhere near
  points[3].position_m = {3, -0.15F, 1.5F};  // near the wall's other side, which the scanner did not see
  Progress progress;
  const auto off = ModelDeviation(*d.imported, d.georeference->shift_m).of(points, h, progress);
  ASSERT_TRUE(off);
  EXPECT_NEAR((*off)[0], 0.01, 1e-5);
  EXPECT_NEAR((*off)[1], -0.02, 1e-5);
  EXPECT_TRUE(std::isnan((*off)[2]));
  EXPECT_NEAR((*off)[3], -0.15, 1e-5);
}

TEST(PointPicking, TakesTheFirstPointInTheConeAndNothingThatIsCutAway) {
  const std::vector<float> xyz = {5, 0, 0, 3, 0.02F, 0, 2, 1, 0, -1, 0, 0};
  const PointPlaces places{xyz.data(), 4, 3};
  SightCone cone;
  cone.per_metre = 0.01;
  EXPECT_EQ(firstPoint(places, cone), 1u);
  EXPECT_EQ(firstPoint(places, cone, [](const Eigen::Vector3d& p) { return p.x() > 4; }), 0u);
  cone.per_metre = 0.001;
  EXPECT_EQ(firstPoint(places, cone), 0u);
  cone.direction = Eigen::Vector3d::UnitZ();
  EXPECT_FALSE(firstPoint(places, cone));
  EXPECT_FALSE(firstPoint({}, cone));
}

TEST(ClipBox, KeepsWhatLiesInsideAlsoWhenTurned) {
  ClipBox box{{1, 2, 3}, {2, 1, 1}, 0};
  EXPECT_TRUE(box.contains({2.9, 2.9, 3.9}));
  EXPECT_FALSE(box.contains({3.1, 2, 3}));
  box.yaw_rad = M_PI / 2;
  EXPECT_TRUE(box.contains({1, 3.9, 3}));
  EXPECT_FALSE(box.contains({2.5, 2, 3}));
  for (int face = 0; face < kClipFaces; ++face) {
    const auto plane = planeOf(box, face);
    EXPECT_GT(plane.inward.dot(box.centre - plane.point), 0.9);
  }
}

TEST(ClipBox, MovesOneFaceAndNeverTurnsInsideOut) {
  const ClipBox box{{0, 0, 0}, {1, 1, 1}, 0.3};
  for (int face = 0; face < kClipFaces; ++face) {
    const int opposite = face ^ 1;
    const auto moved = withFaceMoved(box, face, face % 2 == 1 ? 0.5 : -0.5);
    EXPECT_NEAR(moved.half[face / 2], 1.25, 1e-12);
    EXPECT_LT((planeOf(moved, opposite).point - planeOf(box, opposite).point).norm(), 1e-9);
    const auto shut = withFaceMoved(box, face, face % 2 == 1 ? -9 : 9);
    EXPECT_NEAR(2 * shut.half[face / 2], kThinnestClip_m, 1e-12);
  }
}

TEST(ClipBox, OfASectionLiesThroughThePlaceAndReachesOverEverything) {
  Bounds bounds;
  bounds.extend(Eigen::Vector3d(0, 0, 0));
  bounds.extend(Eigen::Vector3d(10, 6, 3));
  const Eigen::Vector3d place(2, 5, 1), normal = Eigen::Vector3d(1, 1, 0).normalized();
  const auto slab = slabThrough(place, normal, 0.2, bounds);
  EXPECT_TRUE(slab.contains(place));
  EXPECT_EQ(thinAxis(slab), 0);
  EXPECT_FALSE(slab.contains(place + 0.11 * normal));
  // Along the wall as far as the building is.
  EXPECT_TRUE(slab.contains({7, 0, 2}));
  EXPECT_TRUE(slab.contains({1, 6, 0}));
  const auto level = slabThrough(place, {0.1, 0, 1}, 0.2, bounds);
  EXPECT_EQ(thinAxis(level), 2);
  EXPECT_TRUE(level.contains({10, 0, 1}));
  EXPECT_FALSE(level.contains({2, 5, 1.2}));
}

TEST(ClipBox, IsLoweredByACut) {
  const ClipBox box{{0, 0, 1}, {1, 1, 1}, 0};
  EXPECT_EQ(combined(box, {})->half.z(), 1);
  const auto lower = combined(box, 0.5);
  EXPECT_NEAR(lower->centre.z() + lower->half.z(), 0.5, 1e-12);
  EXPECT_NEAR(lower->centre.z() - lower->half.z(), 0, 1e-12);
  EXPECT_EQ(combined(box, 7), box);
  EXPECT_FALSE(combined({}, 1.0));
}

TEST(Measuring, LeadsFromPointToPoint) {
  Measuring m{MeasurementKind::area, {}, {}};
  EXPECT_THAT(hintOf(m), HasSubstr("Click the corners"));
  m.points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(isEnough(m));
  EXPECT_FALSE(measuredSoFar(m, {}));
  EXPECT_TRUE(measuredSoFar(m, Eigen::Vector3d(1, 1, 0)));
  m.points.emplace_back(1, 1, 0);
  EXPECT_TRUE(isEnough(m));
  EXPECT_FALSE(isFull(m));
  EXPECT_THAT(hintOf(m), HasSubstr("Enter to finish"));
  EXPECT_TRUE(isFull({MeasurementKind::angle, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {}}));
}

MeasurablePlace onFace(const Eigen::Vector3d& at, const Eigen::Vector3d& normal, Snap snap = Snap::none) {
  return {at, {}, {normal}, snap};
}

TEST(Measuring, IsSquareBetweenParallelFacesAndNowhereElse) {
  using V = Eigen::Vector3d;
  const auto begun = with(Measuring{}, onFace({1, 0, 1}, V::UnitY()));
  const auto across = squared(begun, onFace({2.5, 4, 1.7}, -V::UnitY()));
  EXPECT_TRUE(across.square);
  EXPECT_EQ(across.position, V(1, 4, 1));
  EXPECT_TRUE(with(begun, across).square);
  EXPECT_FALSE(squared(begun, onFace({2.5, 4, 1.7}, V::UnitX())).square) << "not parallel";
  EXPECT_FALSE(squared(begun, onFace({2.5, 0, 1.7}, V::UnitY())).square) << "along the same face";
  EXPECT_EQ(squared(begun, onFace({2.5, 4, 1.7}, -V::UnitY(), Snap::corner)).position, V(2.5, 4, 1.7));
  const auto height = with(Measuring{MeasurementKind::height, {}, {}}, onFace({1, 0, 1}, V::UnitY()));
  EXPECT_FALSE(squared(height, onFace({2.5, 4, 1.7}, -V::UnitY())).square);
}

TEST(Measuring, OffersWhatIsOppositeOfOneFaceOnly) {
  using V = Eigen::Vector3d;
  EXPECT_FALSE(towardsOpposite({}));
  const auto begun = with(Measuring{}, onFace({1, 0, 1}, V::UnitY()));
  EXPECT_EQ(towardsOpposite(begun), V(V::UnitY()));
  EXPECT_THAT(hintOf(begun), HasSubstr("Enter for the face opposite"));
  const auto corner = with(Measuring{}, {{1, 0, 1}, {}, {V::UnitY(), V::UnitX()}, Snap::corner});
  EXPECT_FALSE(towardsOpposite(corner));
  EXPECT_THAT(hintOf(corner), Not(HasSubstr("Enter")));
}

TEST(PointPicking, FindsThePlaneAroundAPoint) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) {
      const float u = 0.02F * static_cast<float>(i), v = 0.02F * static_cast<float>(k);
      points.emplace_back(0.001F * static_cast<float>((i * 7 + k * 3) % 5 - 2), u, v);  // a wall, ±2 mm
      points.emplace_back(1 + u, 5, v * 0);                                             // a wire
    }
  const PointPlaces places{points.front().data(), points.size(), 3};
  const auto wall = normalAround(places, {0, 0.2, 0.2}, 0.1);
  ASSERT_TRUE(wall);
  EXPECT_GT(std::abs(wall->x()), 0.999);
  EXPECT_FALSE(normalAround(places, {1.2, 5, 0}, 0.1)) << "points along a line";
  EXPECT_FALSE(normalAround(places, {0, 3, 3}, 0.1)) << "no points";
}

// A room of 4 × 3 × 2.5 m within walls of 0.3 m, as one box in another, looked into from above.
struct SnappedRoom {
  SnappedRoom() {
    const auto box = [this](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
      Mesh mesh;
      for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(static_cast<float>((i & 1 ? high : low).x()),
                                    static_cast<float>((i & 2 ? high : low).y()),
                                    static_cast<float>((i & 4 ? high : low).z()));
      mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
      mesh.surface_of_triangle.assign(12, 0);
      const auto index = static_cast<std::uint32_t>(environment->meshes.size());
      environment->meshes.push_back(std::make_shared<const Mesh>(std::move(mesh)));
      environment->products.emplace_back();
      environment->instances.push_back({index, index, Eigen::Affine3d::Identity()});
    };
    environment->surfaces.emplace_back();
    box({-0.3, -0.3, 0}, {0, 3.3, 2.5});  // west
    box({4, -0.3, 0}, {4.3, 3.3, 2.5});   // east
    box({-0.3, -0.3, -0.2}, {4.3, 3.3, 0});
    snapping.follow(environment);
    look(camera, StandardView::top);
    camera.orthographic = true;
    camera.target = {2, 1.5, 0};
    camera.distance_m = 10;
  }
  std::optional<SnapPlace> at(const Eigen::Vector3d& floor) const {
    const Eigen::Vector2d size(800, 600);
    const SnapView view{camera, size, *project(camera, floor, size), 10,
                        [](std::uint32_t, const Eigen::Vector3d&) { return true; }};
    return snapping.nearest(std::array{floor}, view);
  }
  std::shared_ptr<Environment> environment = std::make_shared<Environment>();
  Snapping snapping;
  Camera camera;
};

TEST(Snapping, HoldsOnToTheFaceOfAWallInAPlan) {
  const SnappedRoom room;
  const auto west = room.at({0.05, 1.2, 0});
  ASSERT_TRUE(west);
  EXPECT_EQ(west->snap, Snap::face);
  EXPECT_NEAR((west->position - Eigen::Vector3d(0, 1.2, 0)).norm(), 0, 1e-6);
  ASSERT_EQ(west->normals.size(), 1u);
  EXPECT_NEAR(west->normals[0].x(), 1, 1e-6) << "out of the wall";
  EXPECT_FALSE(room.at({2, 1.5, 0})) << "nothing in reach";
}

TEST(Snapping, HoldsOnToCornersBeforeEdges) {
  const SnappedRoom room;
  const auto corner = room.at({4.04, -0.26, 0});
  ASSERT_TRUE(corner);
  EXPECT_EQ(corner->snap, Snap::corner);
  EXPECT_NEAR((corner->position - Eigen::Vector3d(4, -0.3, 0)).head<2>().norm(), 0, 1e-6);
}

TEST(Snapping, HoldsOnToAnEdgeSeenFromTheSide) {
  SnappedRoom room;
  look(room.camera, StandardView::corner);
  room.camera.orthographic = false;
  room.camera.target = {4.15, 1.5, 2.5};
  const auto edge = room.at({4.03, 1.5, 2.5});  // on the top of the wall, beside its rim
  ASSERT_TRUE(edge);
  EXPECT_EQ(edge->snap, Snap::edge);
  EXPECT_NEAR(edge->position.x(), 4, 1e-6);
  EXPECT_NEAR(edge->position.z(), 2.5, 1e-6);
  EXPECT_EQ(edge->normals.size(), 2u);
}

TEST(InspectedClouds, AreTheScansNewestFirstThenTheUnderlays) {
  Document d = twoStoreyDocument();
  Job job;
  job.stations.push_back({"S1", 1.7, {}, {}, {}});
  job.stations[0].scans.resize(2);
  job.stations[0].scans[0].file = "/tmp/old.e57";
  job.stations[0].scans[1].file = "/tmp/new.e57";
  d.job = std::make_shared<const Job>(job);
  Underlay underlay;
  underlay.name = "measured";
  underlay.file = "/tmp/measured.las";
  underlay.file_from_cloud.translation = {500000, 5600000, 1};
  d.underlays.push_back(std::make_shared<const Underlay>(underlay));
  const auto clouds = inspectedClouds(d);
  ASSERT_EQ(clouds.size(), 3u);
  EXPECT_EQ(clouds[0].file, "/tmp/new.e57");
  EXPECT_EQ(clouds[0].local_from_cloud * Eigen::Vector3d(500001, 5600002, 3), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(clouds[2].local_from_cloud * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 4));
  EXPECT_EQ(cloudOf(clouds, "/tmp/measured.las"), &clouds[2]);
  EXPECT_EQ(cloudOf(clouds, "/tmp/gone.las"), nullptr);
  const Pose& pose = clouds[2].local_from_cloud;
  EXPECT_LT((inverse(pose) * (pose * Eigen::Vector3d(4, 5, 6)) - Eigen::Vector3d(4, 5, 6)).norm(), 1e-9);
}

TEST(PanoramaWindow, OfAWideWidgetShowsTheWholeRingOnceAndPartOfItsHeight) {
  const auto wide = fillingWidth({}, 6);
  EXPECT_DOUBLE_EQ(wide.zoom, 3);
  EXPECT_NEAR(panoramaAt(wide, 0.999, 0.5, 6).first - panoramaAt(wide, 0.001, 0.5, 6).first, 0.998, 1e-9);
  EXPECT_NEAR(panoramaAt(wide, 0.5, 0, 6).second, 1 / 3.0, 1e-9) << "around the horizon";
  EXPECT_DOUBLE_EQ(zoomed(wide, 0.5, 0.5, 0.5, 6).zoom, 3) << "not twice around";
  EXPECT_DOUBLE_EQ(zoomed(wide, 2, 0.5, 0.5, 6).zoom, 6);
  EXPECT_DOUBLE_EQ(fillingWidth({}, 1.5).zoom, 1) << "of a narrow one all of the height";
}

TEST(PanoramaWindow, KeepsWhatIsUnderThePointerWhileZoomingAndWrapsAroundTheRing) {
  const PanoramaWindow window{0.5, 0.5, 2};
  const auto before = panoramaAt(window, 0.8, 0.3, 2);
  const auto nearer = zoomed(window, 1.5, 0.8, 0.3, 2);
  const auto after = panoramaAt(nearer, 0.8, 0.3, 2);
  EXPECT_NEAR(before.first, after.first, 1e-9);
  EXPECT_NEAR(before.second, after.second, 1e-9);
  const auto round = panned(window, 2.0, 0, 2);
  EXPECT_NEAR(round.x, 0.5, 1e-9);
  EXPECT_GE(panned(window, 0, -9, 2).y, 0.25);
  EXPECT_LE(panned(window, 0, -9, 2).y, 0.75);
}

}  // namespace
}  // namespace standpoint
