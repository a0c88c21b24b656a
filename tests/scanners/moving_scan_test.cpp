// SPDX-License-Identifier: GPL-3.0-or-later
// Scans on the way against what follows from how the device is carried (docs/explanation/mobile.md).
#include <cmath>
#include <cstring>
#include <numbers>

#include <gtest/gtest.h>

#include "core/motion/pose_spline.h"
#include "core/units.h"
#include "scanners/engine/point_placing.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

Pose turnedBy(double yaw_rad, const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), at};
}

// Evenly along and about, for ever.
class Even final : public PoseFunction {
 public:
  Even(const Eigen::Vector3d& speed, double yaw_radps = 0, const Pose& from = {})
      : speed_(speed), yaw_radps_(yaw_radps), from_(from) {}
  Pose pose(double time_s) const override {
    return Pose{turnedBy(yaw_radps_ * time_s).rotation * from_.rotation, from_.translation + time_s * speed_};
  }
  double first_s() const override { return 0; }
  double last_s() const override { return 1e9; }

 private:
  Eigen::Vector3d speed_;
  double yaw_radps_;
  Pose from_;
};

Instrument vlp() { return instrument("velodyne-vlp-16"); }
ScanSettings usual(const Instrument& instrument) { return *resolveMovingSettings(instrument, {}); }

Scanned onTheWay(const SceneBuilder& scene, const Instrument& instrument, const ScanMotion& motion,
                 ScanOptions options = {1, Effects::none()}) {
  PointsKept sink;
  Progress progress;
  options.channels = {.time = true, .returns = true, .truth = true};
  const auto count = scan(*scene.build(), allOf(*scene.environment(), 0.5), instrument, usual(instrument), motion,
                          options, sink, progress);
  EXPECT_TRUE(count);
  return {std::move(sink.all), count.value_or(ScanCount{})};
}

SceneBuilder wallBeside() {
  SceneBuilder scene;
  scene.quad({-60, 5, -60}, {120, 0, 0}, {0, 0, 120});
  return scene;
}

// The lever arm turns with the body: at a yaw of 30° the origin is off by R l, and by 115.7 mm from l.
TEST(MovingScan, TurnsTheLeverArmWithTheBody) {
  const Eigen::Vector3d lever(0.10, 0.20, 0.50);
  const Even pass({1, 0, 0});
  const Mounting mounting{{Eigen::Quaterniond::Identity(), lever}};
  const auto points =
      onTheWay(wallBeside(), vlp(), {.true_pose = pass, .truth = mounting, .assumed = mounting, .to_s = 0.3}).points;
  ASSERT_GT(points.size(), 10000U);
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_NEAR(points.y_m[i], 5, 1e-5);

  const ConstantPose turned(turnedBy(30 * kRadPerDeg));
  const auto forgotten = onTheWay(wallBeside(), vlp(), {.true_pose = turned, .truth = mounting, .to_s = 0.1}).points;
  ASSERT_GT(forgotten.size(), 5000U);
  const double off = (turned.pose(0).rotation * lever).y();  // towards the wall
  for (std::size_t i = 0; i < forgotten.size(); ++i) ASSERT_NEAR(forgotten.y_m[i], 5 - off, 1e-5);
  EXPECT_NEAR((turned.pose(0).rotation * lever - lever).norm(), 0.1157, 1e-4);
}

// 1.4 m/s towards a wall in the middle quarter of a turn of 0.1 s: v · 25 ms = 35 mm, evenly spread.
TEST(MovingScan, LeavesTheSkewOfAFrameThatNobodySetsRight) {
  const Even walk({1.4, 0, 0});
  const Mounting backwards{turnedBy(std::numbers::pi)};
  ScanMotion motion{.true_pose = walk, .truth = backwards, .assumed = backwards, .to_s = 0.1};
  SceneBuilder scene;
  scene.quad({10, -10, -60}, {0, 20, 0}, {0, 0, 120});
  for (const Deskew deskew : {Deskew::pulse, Deskew::turn, Deskew::none}) {
    motion.deskew = deskew;
    const auto points = onTheWay(scene, vlp(), motion).points;
    ASSERT_GT(points.size(), 5000U);
    double least = 1e9, most = -1e9, sum = 0, squares = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double off = static_cast<double>(points.x_m[i]) - 10;
      least = std::min(least, off), most = std::max(most, off);
      sum += off, squares += off * off;
    }
    const auto count = static_cast<double>(points.size());
    const double rms = std::sqrt(squares / count - sum * sum / count / count);
    EXPECT_NEAR(most - least, deskew == Deskew::none ? 0.0350 : 0, deskew == Deskew::none ? 0.03 * 0.035 : 1e-5);
    EXPECT_NEAR(rms, deskew == Deskew::none ? 0.0101 : 0, deskew == Deskew::none ? 0.03 * 0.0101 : 1e-5);
  }
}

// What stands at `place`, seen by a pulse at some time and put where the writer believes it.
Eigen::Vector3d putBack(const ScanMotion& motion, double rotation_hz, double time_s, const Eigen::Vector3d& place) {
  PointPlacing placing(motion, rotation_hz);
  placing.begin(time_s, time_s);
  const Pose local_from_device =
      motion.true_pose.pose(motion.from_s + motion.truth.clock_ahead_s + time_s) * motion.truth.body_from_device;
  return placing.at(time_s, time_s) * (inverse(local_from_device) * place);
}

// 60°/s at 5 m: a frame's first and last column are 2 · 5 · sin 3° = 0.523 m apart.
TEST(MovingScan, BendsAFrameThatTurns) {
  const Even turning({0, 0, 0}, 60 * kRadPerDeg);
  ScanMotion motion{.true_pose = turning, .to_s = 1};
  const Eigen::Vector3d post(5, 0, 0);
  for (const double from : {0.0, 0.3}) {
    motion.deskew = Deskew::none;
    const auto first = putBack(motion, 10, from, post), last = putBack(motion, 10, from + 0.0999999, post);
    EXPECT_NEAR((first - last).norm(), 10 * std::sin(3 * kRadPerDeg), 1e-5);
    for (const Deskew exact : {Deskew::pulse, Deskew::turn}) {  // even motion is what `turn` supposes
      motion.deskew = exact;
      EXPECT_LT((putBack(motion, 10, from + 0.07, post) - post).norm(), 1e-9);
    }
  }
}

// A clock 2 ms ahead: v δt = 20.0 mm, opposite passes differ by 40.0; ω r δt = 20.9 mm.
TEST(MovingScan, ShiftsByWhatItsClockIsAhead) {
  for (const double speed : {10.0, -10.0}) {
    const Even pass({speed, 0, 0});
    const ScanMotion motion{.true_pose = pass, .assumed = {{}, 0.002}, .to_s = 1};
    EXPECT_NEAR((putBack(motion, 10, 0.4, {3, 2, 1}) - Eigen::Vector3d(3, 2, 1)).x(), 0.002 * speed, 1e-9);
  }
  const Even turning({0, 0, 0}, 30 * kRadPerDeg);
  const ScanMotion motion{.true_pose = turning, .assumed = {{}, 0.002}, .to_s = 1};
  EXPECT_NEAR((putBack(motion, 10, 0, {20, 0, 0}) - Eigen::Vector3d(20, 0, 0)).norm(), 0.02094, 1e-5);
}

// 0.05° of roll 80 m up: 69.8 mm across below, 40.3 mm of height at 30° aside; turned round, the other way.
TEST(MovingScan, TiltsByItsBoresight) {
  for (const double heading : {0.0, std::numbers::pi}) {
    const ConstantPose above(turnedBy(heading, {0, 0, 80}));
    const Eigen::Quaterniond roll(Eigen::AngleAxisd(0.05 * kRadPerDeg, Eigen::Vector3d::UnitX()));
    const ScanMotion motion{.true_pose = above, .assumed = {{roll, Eigen::Vector3d::Zero()}}, .to_s = 1};
    const double sign = heading == 0 ? 1 : -1;
    EXPECT_NEAR(putBack(motion, 10, 0, {0, 0, 0}).y(), sign * 0.0698, 0.0001);
    const double aside = 80 * std::tan(30 * kRadPerDeg);
    EXPECT_NEAR(putBack(motion, 10, 0, {0, aside, 0}).z(), sign * 0.0403, 0.0001);
  }
}

// A line scanner along a wall at distance d: rate / (2π v d) points per m² where it is nearest.
TEST(MovingScan, HasTheDensityThatSpeedAndDistanceGive) {
  const Even flight({10, 0, 0});
  SceneBuilder scene;
  scene.quad({-100, 10, -50}, {200, 0, 0}, {0, 0, 100});
  const auto points = onTheWay(scene, instrument("riegl-vux-1uav"), {.true_pose = flight, .to_s = 1}).points;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.x_m[i] > 2 && points.x_m[i] < 8 && std::abs(points.z_m[i]) < 0.7F) ++inside;
  EXPECT_NEAR(static_cast<double>(inside) / (6 * 1.4), 550000 / (2 * std::numbers::pi * 10 * 10), 0.02 * 875);
}

SceneBuilder furnished() {
  SceneBuilder scene;
  scene.box({-4, -3, -1.7}, {5, 6, 2}, true);
  scene.box({2, -1, -1.7}, {2.4, -0.4, 0.1}, false);
  scene.box({1, 3, -1.7}, {1.02, 3.02, 2}, false);
  return scene;
}

bool alikeInAll(const PointBlock& a, const PointBlock& b) {
  const auto alike = [](const auto& one, const auto& other) {
    return one.size() == other.size() && std::memcmp(one.data(), other.data(), one.size() * sizeof one[0]) == 0;
  };
  return alike(a.x_m, b.x_m) && alike(a.y_m, b.y_m) && alike(a.z_m, b.z_m) && alike(a.intensity, b.intensity) &&
         alike(a.time_s, b.time_s) && alike(a.product, b.product) && alike(a.return_number, b.return_number) &&
         alike(a.truth.received_db, b.truth.received_db);
}

TEST(MovingScan, IsTheSameOnAnyThreadsAndInAnyParts) {
  const Even walk({0.9, 0.3, 0}, 0.8);
  const auto scene = furnished();
  for (const char* id : {"leica-blk2go", "velodyne-vlp-16"}) {
    const Instrument device = instrument(id);
    const ScanMotion motion{.true_pose = walk, .to_s = 0.05};
    const auto with = [&](int threads) {
      ScanOptions options{7};
      options.threads = threads;
      return options;
    };
    const auto whole = onTheWay(scene, device, motion, with(1));
    ASSERT_GT(whole.points.size(), 5000U);
    for (const int threads : {2, 64})
      EXPECT_TRUE(alikeInAll(whole.points, onTheWay(scene, device, motion, with(threads)).points)) << id;
    const std::uint32_t blocks = blocksOf(device, usual(device), 0.05);
    PointsKept parts;
    std::vector<Scanned> scanned;
    for (std::uint32_t k = 7; k-- > 0;) {  // the last one first
      ScanOptions options = with(2);
      options.first_column = blocks * k / 7, options.end_column = blocks * (k + 1) / 7;
      scanned.push_back(onTheWay(scene, device, motion, options));
    }
    std::uint64_t pulses = 0;
    for (auto part = scanned.rbegin(); part != scanned.rend(); ++part) {
      ASSERT_TRUE(parts.write(part->points));
      pulses += part->count.pulses;
    }
    EXPECT_TRUE(alikeInAll(whole.points, parts.all)) << id;
    EXPECT_EQ(pulses, whole.count.pulses);
  }
}

TEST(MovingScan, WritesPulsesInTheOrderOfTheirTimes) {
  const Even walk({0.9, 0.3, 0}, 0.8);
  const auto points = onTheWay(furnished(), vlp(), {.true_pose = walk, .to_s = 0.2}, ScanOptions{3}).points;
  ASSERT_GT(points.size(), 10000U);
  for (std::size_t i = 1; i < points.size(); ++i) {
    ASSERT_LE(points.time_s[i - 1], points.time_s[i]);
    ASSERT_LT(points.row[i], 16U);
  }
  EXPECT_LT(points.time_s.back(), 0.2);
}

TEST(MovingScan, StandingStillSeesTheRoomAsItIs) {
  const ConstantPose still(turnedBy(0.3, {0.5, 0.2, 0.1}));
  for (const auto& device : everyInstrument()) {
    if (!device.moving) continue;
    const auto scan = onTheWay(furnished(), device, {.true_pose = still, .to_s = 0.1});
    ASSERT_GT(scan.points.size(), 1000U) << device.id;
    if (device.min_range_m < 1) {  // of a closed room all return
      EXPECT_EQ(scan.points.size(), scan.count.pulses) << device.id;
    }
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const Eigen::Vector3d point(scan.points.x_m[i], scan.points.y_m[i], scan.points.z_m[i]);
      const Eigen::Vector3d truth(scan.points.truth.x_m[i], scan.points.truth.y_m[i], scan.points.truth.z_m[i]);
      ASSERT_LT((point - truth).norm(), 1e-5) << device.id;
    }
  }
}

// The noise of the sheet, on the way as well.
TEST(MovingScan, HasTheNoiseOfItsRange) {
  const Even walk({1, 0, 0});
  const auto points =
      onTheWay(wallBeside(), vlp(), {.true_pose = walk, .to_s = 0.3}, {1, Effects::none().with(Effect::range_noise)})
          .points;
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double incidence = static_cast<double>(points.truth.incidence_rad[i]);
    if (incidence > 0.3) continue;
    squares += std::pow((static_cast<double>(points.y_m[i]) - 5) / std::cos(incidence), 2);
    ++count;
  }
  ASSERT_GT(count, 1000U);
  EXPECT_GT(std::sqrt(squares / static_cast<double>(count)), 0.005);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 0.035);
}

}  // namespace
}  // namespace standpoint
