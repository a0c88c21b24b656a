// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"
#include "editor/clouds/growing_cloud.h"
#include "editor/instrument/motion.h"
#include "emulated-ui/menus.h"

namespace standpoint {
namespace {

Device deviceOf(const std::string& id, const std::string& instrument = {}) {
  for (const auto& known : emulatedDevices())
    if (known.id == id) return Device(*loadDevice(known, instrument));
  throw std::runtime_error(id);
}

// In that phase of a scan that has run for so long.
void put(Device& device, const std::string& phase, double elapsed_s, double laser_s) {
  device.change().running = ScanOrder{};
  device.change().phase = phase;
  device.change().elapsed_s = elapsed_s;
  device.change().laser_s = laser_s;
}

TEST(Motion, TheHeadTurnsHalfAroundInTheTimeThatTheSettingTakesAndASecondPassGoesOn) {
  auto device = deviceOf("leica-rtc360");
  MotionOfDevice motion;
  put(device, "scanning_pass_1", 0, 0);
  const double lasts_s = device.number("phase.lasts");
  ASSERT_GT(lasts_s, 10);
  EXPECT_NEAR(motion.of(device, 0, true).head_rad, 0, 1e-9);
  put(device, "scanning_pass_1", lasts_s / 4, lasts_s / 4);
  const auto quarter = motion.of(device, 0, true);
  EXPECT_NEAR(quarter.head_rad, std::numbers::pi / 4, 1e-9);
  EXPECT_TRUE(quarter.mirror_turns);
  EXPECT_NEAR(*motion.turns(), 0.25, 1e-9);
  EXPECT_EQ(motion.shape(device).fans, 2);
  put(device, "scanning_pass_2", lasts_s / 2, 1.5 * lasts_s);
  EXPECT_NEAR(motion.of(device, 0, true).head_rad, 1.5 * std::numbers::pi, 1e-9);
  // Slower at a finer setting: so many degrees a second.
  ASSERT_TRUE(device.setSettings({{"resolution", "3mm"}}));
  EXPECT_GT(device.number("phase.lasts"), 1.5 * lasts_s);
}

TEST(Motion, OneFanGoesAllAroundWhereTheInstrumentHasOneSide) {
  auto device = deviceOf("riegl-vz-i");
  MotionOfDevice motion;
  put(device, "scanning", 0, 0);
  const double lasts_s = device.number("phase.lasts");
  put(device, "scanning", lasts_s / 2, lasts_s / 2);
  const auto shape = motion.shape(device);
  EXPECT_EQ(shape.fans, 1);
  EXPECT_NEAR(shape.turn_rad, 2 * std::numbers::pi, 0.01);
  EXPECT_NEAR(shape.high_rad, 60 * kRadPerDeg, 1e-3);
  EXPECT_NEAR(shape.low_rad, -40 * kRadPerDeg, 1e-3);
  EXPECT_NEAR(motion.of(device, 0, true).head_rad - shape.from_rad, std::numbers::pi, 0.01);
}

TEST(Motion, TheMirrorSpinsUpWithTheHeadAtRestAndAfterwardsTheHeadComesBack) {
  auto device = deviceOf("faro-focus");
  MotionOfDevice motion;
  put(device, "spin_up", 4, 0);
  const auto spins = motion.of(device, 0, true);
  EXPECT_TRUE(spins.mirror_turns);
  EXPECT_EQ(spins.head_rad, 0);
  put(device, "scanning", 0, 0);
  const double lasts_s = device.number("phase.lasts");
  put(device, "scanning", lasts_s, lasts_s);
  EXPECT_NEAR(motion.of(device, 0, true).head_rad, std::numbers::pi, 1e-9);
  put(device, "saving", 0, lasts_s);
  const double saves_s = device.number("phase.lasts");
  put(device, "saving", saves_s / 2, lasts_s);
  EXPECT_NEAR(std::abs(motion.of(device, 0, true).head_rad), std::numbers::pi / 2, 1e-6);
  put(device, "saving", saves_s, lasts_s);
  EXPECT_NEAR(motion.of(device, 0, true).head_rad, 0, 1e-6);
}

TEST(Motion, OfADeviceAtRestNothingMoves) {
  for (const auto& known : emulatedDevices()) {
    Device device(*loadDevice(known, ""));
    MotionOfDevice motion;
    for (const auto& phase : device.type().definition.phases) {
      device.change().phase = phase.id;
      const auto first = motion.of(device, 0.1, false), later = motion.of(device, 7.8, false);
      EXPECT_EQ(first, later) << known.id << ' ' << phase.id;
      EXPECT_FALSE(first.mirror_turns);
    }
  }
}

TEST(Motion, EveryLampOfEveryDeviceHasAColour) {
  for (const auto& known : emulatedDevices()) {
    const auto type = *loadDevice(known, "");
    for (const auto& phase : type->definition.phases) {
      const bool dark = phase.lamp.empty() || phase.lamp == "off";
      EXPECT_EQ(lampAt(phase.lamp, 0, false).has_value(), !dark) << known.id << ' ' << phase.id << ' ' << phase.lamp;
    }
  }
}

TEST(Motion, LightsFlashOnceASecondAndOnlyWhileTheClockRuns) {
  EXPECT_TRUE(lampAt("red flashing", 3.2, true));
  EXPECT_FALSE(lampAt("red flashing", 3.8, true));
  EXPECT_TRUE(lampAt("red flashing", 3.8, false));
  EXPECT_TRUE(lampAt("red", 3.8, true));
  EXPECT_NE(lampAt("yellow pulsating", 3.5, true), lampAt("yellow pulsating", 3.0, true));
}

// A scan of `columns` columns with three points each, at 5 m all around, clockwise from X.
PointBlock columnsOf(std::uint32_t first, std::uint32_t end, std::uint32_t columns) {
  PointBlock block;
  for (std::uint32_t c = first; c < end; ++c)
    for (std::uint32_t row = 0; row < 3; ++row) {
      const double azimuth = 2 * std::numbers::pi * (c + 0.5) / columns;
      block.x_m.push_back(static_cast<float>(5 * std::cos(azimuth)));
      block.y_m.push_back(static_cast<float>(-5 * std::sin(azimuth)));
      block.z_m.push_back(static_cast<float>(row));
      block.intensity.push_back(0.5F);
      block.row.push_back(row);
      block.column.push_back(c);
    }
  return block;
}

std::size_t pointsOf(const std::vector<ShownUnderlay>& shown) {
  std::size_t sum = 0;
  for (const auto& s : shown) sum += s.cloud->points.size();
  return sum;
}

constexpr std::uint32_t kColumns = 960;
constexpr double kOfAPart = 3 * kColumns / 96.0;

// Half around on both sides at once, of a scanner that stands at 7 m of the local frame.
struct HalfTurn {
  GrowingCloud cloud{{0, std::numbers::pi, 2, -1, 1}, {100, 0, 0}};
  HalfTurn() {
    ScanHeader header;
    header.columns = kColumns;
    header.rows = 3;
    header.file_from_scanner.translation = {107, 0, 0};
    EXPECT_TRUE(cloud.begin(header));
  }
};

// How far around, in a half turn, the points of what is shown lie.
double farthestOf(const std::vector<ShownUnderlay>& shown) {
  double farthest = 0;
  for (const auto& part : shown)
    for (const auto& p : part.cloud->points) {
      const Eigen::Vector4d local =
          part.local_from_cloud * Eigen::Vector4d(p.position_m[0], p.position_m[1], p.position_m[2], 1);
      const double azimuth = std::atan2(-local.y(), local.x() - 7);
      farthest = std::max(farthest, std::fmod(azimuth + 2 * std::numbers::pi, std::numbers::pi));
    }
  return farthest;
}

TEST(GrowingCloud, ShowsWhatTheBeamHasPassedOnBothSides) {
  HalfTurn scan;
  EXPECT_TRUE(scan.cloud.shown(0).empty());
  ASSERT_TRUE(scan.cloud.write(columnsOf(0, kColumns, kColumns)));
  const auto quarter = scan.cloud.shown(0.25);
  EXPECT_NEAR(static_cast<double>(pointsOf(quarter)), 3 * kColumns / 4.0, 2 * kOfAPart);
  EXPECT_LE(farthestOf(quarter), 0.25 * std::numbers::pi + 1e-6);
  EXPECT_EQ(scan.cloud.shown(0.5).front().cloud, quarter.front().cloud) << "what is there already stays";
  EXPECT_EQ(pointsOf(scan.cloud.shown(1)), 3 * kColumns);
}

TEST(GrowingCloud, WaitsForTheSimulationAndIsWholeWhenThatIsDone) {
  HalfTurn scan;
  ASSERT_TRUE(scan.cloud.write(columnsOf(0, kColumns / 2, kColumns)));
  EXPECT_NEAR(static_cast<double>(pointsOf(scan.cloud.shown(0.9))), 3 * 0.45 * kColumns, 2 * kOfAPart);
  ASSERT_TRUE(scan.cloud.write(columnsOf(kColumns / 2, kColumns, kColumns)));
  EXPECT_EQ(pointsOf(scan.cloud.shown(std::nullopt)), 3 * kColumns);
}

TEST(GrowingCloud, LiesWhereTheBeamWasWhateverTheSurveyorBelieves) {
  GrowingCloud cloud({0, std::numbers::pi, 2, -1, 1}, {100, 0, 0});
  cloud.foresee(nullptr, {&bodyOf(""), {7, 0, 0}, Eigen::Quaterniond::Identity(), 1.5});
  ScanHeader header;
  header.columns = kColumns;
  header.rows = 3;
  header.file_from_scanner.translation = {600, 20, 0};
  ASSERT_TRUE(cloud.begin(header));
  ASSERT_TRUE(cloud.write(columnsOf(0, kColumns, kColumns)));
  for (const auto& part : cloud.shown(1))
    for (const auto& p : part.cloud->points) {
      const Eigen::Vector4d local =
          part.local_from_cloud * Eigen::Vector4d(p.position_m[0], p.position_m[1], p.position_m[2], 1);
      EXPECT_NEAR(std::hypot(local.x() - 7, local.y()), 5, 1e-3);
    }
}

TEST(GrowingCloud, IsThinnedToWhatIsDrawnSmoothly) {
  constexpr std::uint32_t kMany = 200000;
  GrowingCloud cloud({0, 2 * std::numbers::pi, 1, -1, 1}, Eigen::Vector3d::Zero());
  ScanHeader header;
  header.columns = kMany;
  header.rows = 3;
  ASSERT_TRUE(cloud.begin(header));
  for (std::uint32_t c = 0; c < kMany; c += 1000) ASSERT_TRUE(cloud.write(columnsOf(c, c + 1000, kMany)));
  const auto points = pointsOf(cloud.shown(1));
  EXPECT_LE(points, GrowingCloud::kMostPoints * 4 / 3);
  EXPECT_GT(points, GrowingCloud::kMostPoints / 2);
}

// A box of 4 m by 4 m by 3 m around the instrument.
class BoxScene : public RayScene {
 public:
  explicit BoxScene(const Eigen::Vector3d& middle) : middle_(middle) {}
  std::optional<RayHit> intersect(const Eigen::Vector3d& from, const Eigen::Vector3d& d, double) const override {
    const Eigen::Vector3d o = from - middle_;
    double nearest = 1e9;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double wall = d[k] > 0 ? (k == 2 ? 3.0 : 2.0) : (k == 2 ? 0.0 : -2.0);
      if (std::abs(d[k]) > 1e-12) nearest = std::min(nearest, (wall - o[k]) / d[k]);
    }
    RayHit hit;
    hit.range_m = nearest;
    return hit;
  }
  const Environment& environment() const override { return none_; }

 private:
  Eigen::Vector3d middle_;
  Environment none_;
};

TEST(GrowingCloud, IsForeseenWhereTheBeamIsAheadUntilItIsMeasured) {
  HalfTurn scan;
  const StandingInstrument stands{&bodyOf("leica-rtc360"), {7, 0, 1.5}, Eigen::Quaterniond::Identity(), 1.5};
  scan.cloud.foresee(std::make_shared<BoxScene>(Eigen::Vector3d(7, 0, 0)), stands);
  for (int picture = 0; picture < 24; ++picture) (void)scan.cloud.shown(0.5);  // some more in each
  const auto foreseen = scan.cloud.shown(0.5);
  EXPECT_GT(foreseen.size(), 44U);
  EXPECT_LE(farthestOf(foreseen), 0.5 * std::numbers::pi + 1e-6);
  for (const auto& part : foreseen)
    for (const auto& p : part.cloud->points) {
      const Eigen::Vector4d local =
          part.local_from_cloud * Eigen::Vector4d(p.position_m[0], p.position_m[1], p.position_m[2], 1);
      const double out = std::max(std::abs(local.x() - 7), std::abs(local.y())) - 2;
      EXPECT_LT(std::min({std::abs(out), std::abs(local.z()), std::abs(local.z() - 3)}), 1e-4);
    }
  // It was stopped then: no more comes.
  EXPECT_EQ(scan.cloud.shown(std::nullopt).size(), foreseen.size());
  ASSERT_TRUE(scan.cloud.write(columnsOf(0, kColumns, kColumns)));
  EXPECT_EQ(pointsOf(scan.cloud.shown(std::nullopt)), 3 * kColumns);
}

TEST(SweepFans, AreCutAtWhatTheyHit) {
  const StandingInstrument stands{&bodyOf("leica-rtc360"), {0, 0, 1.5}, Eigen::Quaterniond::Identity(), 1.5};
  const SweepShape shape{0, std::numbers::pi, 2, -60 * kRadPerDeg, 90 * kRadPerDeg};
  const BoxScene box(Eigen::Vector3d::Zero());
  const auto fans = fansOf(shape, 0.5, stands, &box);
  ASSERT_EQ(fans.size(), 2U);
  EXPECT_NEAR(fans[0].azimuth_rad, std::numbers::pi / 2, 1e-9);
  EXPECT_NEAR(fans[1].azimuth_rad, 1.5 * std::numbers::pi, 1e-9);
  for (const auto& fan : fans) {
    EXPECT_NEAR(fan.ranges_m.back(), 1.5, 1e-5);                               // the ceiling
    EXPECT_NEAR(fan.ranges_m.front(), 1.5 / std::sin(60 * kRadPerDeg), 1e-5);  // the floor
    EXPECT_NEAR(*std::min_element(fan.ranges_m.begin(), fan.ranges_m.end()), 1.5, 1e-5);
  }
}

TEST(SweepShapes, OfAWindowHaveOneFan) {
  ScanSettings settings;
  settings.azimuth_from_rad = 0.5;
  settings.azimuth_to_rad = 1.5;
  const auto shape = sweepShapeOf(bodyOf("faro-focus-s70"), settings);
  EXPECT_EQ(shape.fans, 1);
  EXPECT_NEAR(shape.turn_rad, 1, 1e-12);
  EXPECT_NEAR(shareAt(shape, 1.0), 0.5, 1e-12);
}

}  // namespace
}  // namespace standpoint
