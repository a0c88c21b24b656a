// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "core/motion/pose_spline.h"
#include "core/units.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

const Eigen::Vector3d kLow(-4, -3, -1.7), kHigh(5, 6, 1.6);

SceneBuilder room() {
  SceneBuilder scene;
  scene.box(kLow, kHigh, true);
  scene.box({2, 1, -1.7}, {2.5, 1.5, 0.4}, false, scene.surface(0.3F));
  return scene;
}

ScanSettings dome(const Instrument& instrument, std::uint32_t columns, std::uint32_t rows) {
  return window(instrument, 0, 360, instrument.min_elevation_rad / kRadPerDeg,
                instrument.max_elevation_rad / kRadPerDeg, columns, rows);
}

bool same(const PointBlock& a, const PointBlock& b) {
  return a.x_m == b.x_m && a.y_m == b.y_m && a.z_m == b.z_m && a.intensity == b.intensity && a.row == b.row &&
         a.column == b.column && a.red == b.red && a.product == b.product && a.material == b.material;
}

// Distance from the origin to the walls of the room along a direction.
double distanceInside(const Eigen::Vector3d& direction) {
  double nearest = 1e9;
  for (int axis = 0; axis < 3; ++axis)
    if (direction[axis] != 0)
      nearest = std::min(nearest, (direction[axis] > 0 ? kHigh[axis] : kLow[axis]) / direction[axis]);
  return nearest;
}

TEST(IdealScan, OfABoxRoomHasItsDistances) {
  SceneBuilder scene;
  scene.box(kLow, kHigh, true);
  const auto rays = scene.build();
  for (const auto& instrument : instruments()) {
    const auto settings = dome(instrument, 360, 150);
    const auto result = scanned(*rays, allOf(*scene.environment(), 0.5), instrument, settings, {1, Effects::none()});
    EXPECT_EQ(result.count.pulses, 360U * 150U);
    ASSERT_EQ(result.points.size(), 360U * 150U) << instrument.id;
    double worst = 0;
    for (std::size_t i = 0; i < result.points.size(); ++i) {
      const double azimuth = result.points.column[i] * 2 * std::numbers::pi / 360;
      const double span = instrument.max_elevation_rad - instrument.min_elevation_rad;
      const double elevation = instrument.min_elevation_rad + (result.points.row[i] + 0.5) * span / 150;
      // Clockwise from +X, rows rising with elevation.
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      const Eigen::Vector3d point(result.points.x_m[i], result.points.y_m[i], result.points.z_m[i]);
      worst = std::max(worst, (point - distanceInside(direction) * direction).norm());
    }
    EXPECT_LT(worst, 1e-6) << instrument.id;  // the points are floats
  }
}

TEST(Scan, LeavesTheConeBelowBlind) {
  SceneBuilder scene;
  scene.quad({-50, -50, -1.7}, {100, 0, 0}, {0, 100, 0});
  const auto rays = scene.build();
  for (const auto& instrument : instruments()) {
    const auto result =
        scanned(*rays, allOf(*scene.environment(), 0.8), instrument, dome(instrument, 200, 1500), {1, Effects::none()});
    double nearest = 1e9;
    for (std::size_t i = 0; i < result.points.size(); ++i)
      nearest = std::min(nearest, std::hypot(double(result.points.x_m[i]), double(result.points.y_m[i])));
    EXPECT_NEAR(nearest, 1.7 / std::tan(-instrument.min_elevation_rad), 0.003) << instrument.id;
  }
}

TEST(Scan, IsTheSameOnOneTwoAndSevenThreads) {
  const auto scene = room();
  const auto rays = scene.build();
  for (const auto& instrument : instruments()) {
    auto settings = dome(instrument, 700, 500);
    settings.imaging = true;
    const auto assignment = allOf(*scene.environment(), 0.5);
    const auto one = scanned(*rays, assignment, instrument, settings, {7, {}, 1, 3});
    EXPECT_GT(one.points.size(), 300000U);
    for (const int threads : {2, 7})
      EXPECT_TRUE(same(one.points, scanned(*rays, assignment, instrument, settings, {7, {}, threads, 3}).points));
    EXPECT_FALSE(same(one.points, scanned(*rays, assignment, instrument, settings, {8, {}, 2, 3}).points));
    EXPECT_FALSE(same(one.points, scanned(*rays, assignment, instrument, settings, {7, {}, 2, 4}).points));
  }
}

// Bodies that share faces, cut each other and lie in each other's edges, in whose seams and planes beams strike: which
// one is met does not depend on how a processor rounds.
TEST(Scan, IsTheSameUnderEveryInstructionSet) {
  SceneBuilder scene;
  scene.box(kLow, kHigh, true);
  scene.box({-4, -3, -1.7}, {5, 6, 1.6}, false, scene.surface(0.3F));  // the room again, from outside
  scene.box({2, 1, -1.7}, {2.5, 1.5, 1.6}, false, scene.surface(0.5F));
  scene.box({2.1, 1.2, -1}, {3, 1.4, 0}, false, scene.surface(0.6F));  // through it
  scene.box({2.5, 1, -1.7}, {2.9, 1.5, 0.2}, false, scene.surface(0.7F));
  scene.box({2, 0, -1.7}, {4, 0.3, -1}, false, scene.surface(0.4F));
  const auto ball = scene.sphere({-2, 2, 0}, 0.5, 24);
  Eigen::Affine3d moved = Eigen::Affine3d::Identity();
  moved.translate(Eigen::Vector3d(0.37, -3.1, 0.2)).rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.6, 0, 0.8)));
  scene.again(ball, moved * Eigen::Scaling(1.0, 0.7, 1.3));
  const auto assignment = allOf(*scene.environment(), 0.5);
  int compared = 0;
  for (const char* id : {"leica-rtc360", "zf-imager-5016", "riegl-vz-400i"}) {
    const auto instrument = testing::instrument(id);
    for (const Effects effects : {Effects(), Effects::none()}) {
      const auto settings = dome(instrument, 720, 480);  // beams along the axes, too
      const auto known = scanned(*scene.build(), assignment, instrument, settings, {3, effects});
      for (const char* isa : {"isa=sse2", "isa=sse4.2", "isa=avx", "isa=avx2", "isa=avx512"}) {
        Progress progress;
        const auto rays = RayScene::build(scene.environment(), progress, {}, isa);
        if (!rays) continue;  // this processor does not have it
        ++compared;
        EXPECT_TRUE(same(known.points, scanned(**rays, assignment, instrument, settings, {3, effects}).points))
            << id << " " << isa;
      }
    }
  }
  if (compared == 0) GTEST_SKIP() << "Embree has one instruction set here";
}

// Edges, chance and weather included: what a column sees of its neighbours is traced anew for each part.
TEST(Scan, ColumnByColumnIsTheSameAsTheWhole) {
  const auto scene = room();
  const auto rays = scene.build();
  const auto instrument = testing::instrument("riegl-vz-400i");
  auto settings = window(instrument, -50, -20, -20, 20, 60, 300);
  const auto assignment = allOf(*scene.environment(), 0.5);
  ScanOptions options{7};
  options.weather.rain_mm_h = 20;
  options.channels = {.time = true, .returns = true, .truth = true};
  const auto whole = scanned(*rays, assignment, instrument, settings, options);
  EXPECT_GT(std::count(whole.points.return_count.begin(), whole.points.return_count.end(), 2), 20);
  for (const std::uint32_t width : {1U, 7U}) {
    PointsKept sink;
    Progress progress;
    for (std::uint32_t from = 0; from < settings.columns; from += width) {
      options.first_column = from;
      options.end_column = from + width;
      ASSERT_TRUE(scan(*rays, assignment, instrument, settings, Pose{}, options, sink, progress));
    }
    EXPECT_TRUE(same(whole.points, sink.all)) << width;
    EXPECT_EQ(whole.points.truth.flags, sink.all.truth.flags);
    EXPECT_EQ(whole.points.truth.received_db, sink.all.truth.received_db);
  }
}

TEST(Scan, OfARebuiltSceneIsTheSame) {
  const auto scene = room();
  const auto instrument = testing::instrument("trimble-x7");
  const auto assignment = allOf(*scene.environment(), 0.5);
  const auto first = scanned(*scene.build(), assignment, instrument, dome(instrument, 300, 200), {});
  EXPECT_TRUE(
      same(first.points, scanned(*scene.build(), assignment, instrument, dome(instrument, 300, 200), {}).points));
}

// A pulse owns its random numbers: what happens to its neighbours does not change it.
TEST(Scan, OfOnePulseDoesNotDependOnTheOthers) {
  const auto full = room();
  SceneBuilder empty;
  empty.box(kLow, kHigh, true);
  const auto instrument = testing::instrument("leica-rtc360");
  const auto settings = dome(instrument, 120, 83);
  const auto effects = Effects().without(Effect::footprint);  // a beam beside the body meets that, too
  const auto with = scanned(*full.build(), allOf(*full.environment(), 0.5), instrument, settings, {1, effects});
  const auto without = scanned(*empty.build(), allOf(*empty.environment(), 0.5), instrument, settings, {1, effects});
  std::map<std::pair<std::uint32_t, std::uint32_t>, float> x;
  for (std::size_t i = 0; i < without.points.size(); ++i)
    x[{without.points.column[i], without.points.row[i]}] = without.points.x_m[i];
  std::size_t walls = 0;
  for (std::size_t i = 0; i < with.points.size(); ++i)
    if (with.points.product[i] == 0) {
      ++walls;
      ASSERT_EQ(with.points.x_m[i], (x[{with.points.column[i], with.points.row[i]}]));
    }
  EXPECT_GT(walls, 8000U);
}

TEST(Scan, LabelsProductMaterialAndColour) {
  const auto scene = room();
  const auto instrument = testing::instrument("leica-rtc360");
  auto settings = dome(instrument, 200, 150);
  settings.imaging = true;
  MaterialAssignment assignment = allOf(*scene.environment(), 0.5);
  std::erase_if(assignment.surfaces, [](const auto& s) { return s.product == 1; });
  const auto result = scanned(*scene.build(), assignment, instrument, settings, {});
  std::size_t posts = 0;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const bool post = result.points.product[i] == 1;
    posts += post ? 1 : 0;
    ASSERT_EQ(result.points.material[i], post ? 1U : 0U);  // 1 = the number of materials: not assigned
    ASSERT_EQ(result.points.red[i], post ? 77 : 204);
  }
  EXPECT_GT(posts, 100U);
  settings.imaging = false;
  EXPECT_TRUE(scanned(*scene.build(), assignment, instrument, settings, {}).points.red.empty());
}

TEST(Scan, OfATiltedScannerIsInItsOwnFrame) {
  SceneBuilder scene;
  scene.box(kLow, kHigh, true);
  const auto instrument = testing::instrument("faro-focus-s350");
  const Pose pose{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized())), {0.5, 1, 0.2}};
  const auto result = scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument, dome(instrument, 90, 70),
                              {1, Effects::none()}, pose);
  ASSERT_EQ(result.points.size(), 90U * 70U);
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const Eigen::Vector3d p = pose * Eigen::Vector3d(result.points.x_m[i], result.points.y_m[i], result.points.z_m[i]);
    const double off = std::min((p - kLow).cwiseAbs().minCoeff(), (kHigh - p).cwiseAbs().minCoeff());
    ASSERT_LT(off, 2e-6);
  }
}

// A scanner that rolls along a hall still sees its walls flat: the pose belongs to the time of the pulse.
TEST(Scan, OfAMovingScannerIsSetRightByItsTrajectory) {
  SceneBuilder scene;
  scene.box(kLow, kHigh, true);
  const auto instrument = testing::instrument("leica-rtc360");
  const auto settings = dome(instrument, 300, 150);
  const Pose end{Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ())), {1.5, -0.5, 0.1}};
  const auto path = PoseChords::through({{0, settings.scan_seconds}, {Pose{}, end}});
  ASSERT_TRUE(path);
  const ScanMotion motion{.true_pose = *path, .to_s = settings.scan_seconds};
  PointsKept sink;
  Progress progress;
  ASSERT_TRUE(scan(*scene.build(), allOf(*scene.environment(), 0.5), instrument, settings, motion, {1, Effects::none()},
                   sink, progress));
  ASSERT_EQ(sink.all.size(), 300U * 150U);
  double differs = 0;
  const auto still =
      scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument, settings, {1, Effects::none()});
  for (std::size_t i = 0; i < sink.all.size(); ++i) {
    const Eigen::Vector3d p(sink.all.x_m[i], sink.all.y_m[i], sink.all.z_m[i]);
    ASSERT_LT(std::min((p - kLow).cwiseAbs().minCoeff(), (kHigh - p).cwiseAbs().minCoeff()), 2e-6);
    differs = std::max(differs, std::abs(double(sink.all.x_m[i]) - double(still.points.x_m[i])));
  }
  EXPECT_GT(differs, 1);
}

TEST(Scan, HandsOnBoundedBlocksInOrderOfColumns) {
  const auto scene = room();
  const auto instrument = testing::instrument("leica-rtc360");
  PointsKept sink;
  Progress progress;
  const auto settings = dome(instrument, 2000, 400);
  ASSERT_TRUE(scan(*scene.build(), {}, instrument, settings, Pose{}, {}, sink, progress));
  EXPECT_LE(sink.largest_block, 1U << 17U);
  for (std::size_t i = 1; i < sink.all.size(); ++i)
    ASSERT_TRUE(std::pair(sink.all.column[i - 1], sink.all.row[i - 1]) <
                std::pair(sink.all.column[i], sink.all.row[i]));
  EXPECT_DOUBLE_EQ(progress.fraction(), 1);
}

class FullDisk final : public PointSink {
 public:
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock&) override {
    return ++blocks < 3 ? Result<void>{} : failure(ErrorKind::file_system, "disk full", "x.e57");
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  int blocks = 0;
};

TEST(Scan, StopsAtTheFirstErrorOfItsSink) {
  const auto scene = room();
  const auto instrument = testing::instrument("leica-rtc360");
  FullDisk sink;
  Progress progress;
  const auto count = scan(*scene.build(), {}, instrument, dome(instrument, 4000, 400), Pose{}, {}, sink, progress);
  ASSERT_FALSE(count);
  EXPECT_EQ(count.error().kind, ErrorKind::file_system);
  EXPECT_EQ(sink.blocks, 3);
}

// Cancels when it gets its third block, as somebody who watches the points come would.
class Impatient : public PointSink {
 public:
  explicit Impatient(Progress& progress) : progress_(progress) {}
  Result<void> begin(const ScanHeader&) override { return {}; }
  Result<void> write(const PointBlock&) override {
    if (++blocks == 3) progress_.cancel();
    return {};
  }
  Result<void> end() override { return {}; }
  Result<void> close() override { return {}; }
  int blocks = 0;

 private:
  Progress& progress_;
};

TEST(Scan, StopsSoonWhenCancelled) {
  const auto scene = room();
  const auto instrument = testing::instrument("leica-rtc360");
  const auto settings = *resolveSettings(instrument, {{"resolution", "3mm"}});
  Progress progress;
  Impatient sink(progress);
  const auto count = scan(*scene.build(), {}, instrument, settings, Pose{}, {}, sink, progress);
  ASSERT_FALSE(count);
  EXPECT_EQ(count.error().kind, ErrorKind::cancelled);
  EXPECT_LT(sink.blocks, 40) << "of what was under way then; there are hundreds";
}

TEST(Scan, RefusesAWayThatIsNone) {
  const auto scene = room();
  const auto rays = scene.build();
  const auto instrument = testing::instrument("leica-rtc360");
  const auto settings = dome(instrument, 10, 10);
  Pose nowhere;
  nowhere.translation.x() = std::nan("");
  const ConstantPose somewhere{Pose{}}, lost{nowhere};
  PointsKept sink;
  Progress progress;
  EXPECT_EQ(scan(*rays, {}, instrument, settings, nowhere, {}, sink, progress).error().kind, ErrorKind::usage);
  for (const ScanMotion& motion :
       {ScanMotion{.true_pose = somewhere}, ScanMotion{.true_pose = somewhere, .from_s = 2, .to_s = 1},
        ScanMotion{.true_pose = somewhere, .to_s = std::nan("")}, ScanMotion{.true_pose = lost, .to_s = 1},
        ScanMotion{.true_pose = somewhere, .solved_pose = &lost, .to_s = 1},
        ScanMotion{.true_pose = somewhere, .assumed = {nowhere}, .to_s = 1}})
    EXPECT_EQ(scan(*rays, {}, instrument, settings, motion, {}, sink, progress).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace standpoint
