// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/patterns/scan_pattern.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

ScanPattern patternOf(const char* id, const SettingValues& values = {}) {
  const Instrument instrument = testing::instrument(id);
  const auto settings = resolveMovingSettings(instrument, values);
  EXPECT_TRUE(settings) << id;
  return {*instrument.moving, *settings};
}

double elevation_deg(const Pulse& pulse) { return std::asin(pulse.direction.z()) / kRadPerDeg; }
double azimuth_deg(const Pulse& pulse) { return std::atan2(pulse.direction.y(), pulse.direction.x()) / kRadPerDeg; }

// Timing tables of the makers' open drivers (docs/explanation/mobile.md).
TEST(ScanPattern, SendsEachPulseAtItsTime) {
  const auto vlp = patternOf("velodyne-vlp-16").pulse(1808, 5);
  EXPECT_NEAR(vlp.time_s, 99.986688e-3, 1e-12);
  EXPECT_NEAR(elevation_deg(vlp), 5, 1e-9);
  EXPECT_NEAR(patternOf("hesai-xt32").pulse(3, 31).time_s, 197.24e-6, 1e-12);
  EXPECT_NEAR(elevation_deg(patternOf("hesai-xt32").pulse(3, 31)), -16, 1e-9);
  EXPECT_NEAR(patternOf("ouster-os1-128").pulse(512, 0).time_s, 50e-3, 1e-12);
  EXPECT_NEAR(patternOf("ouster-os1-128", {{"mode", "2048x10"}}).pulse(512, 0).time_s, 25e-3, 1e-12);
  EXPECT_NEAR(patternOf("riegl-vux-1uav", {{"pulse_rate", "50"}}).pulse(7, 0).time_s, 140e-6, 1e-12);
}

TEST(ScanPattern, TurnsClockwiseWhileTheChannelsFire) {
  const auto vlp = patternOf("velodyne-vlp-16");
  EXPECT_NEAR(azimuth_deg(vlp.pulse(0, 0)), 0, 1e-9);
  EXPECT_NEAR(azimuth_deg(vlp.pulse(1, 0)), -0.199, 1e-3);
  EXPECT_NEAR(azimuth_deg(vlp.pulse(0, 15)), -0.124, 1e-3);
  EXPECT_NEAR(azimuth_deg(patternOf("velodyne-vlp-16", {{"rotation", "20"}}).pulse(1, 0)), -0.398, 1e-3);
  EXPECT_NEAR(azimuth_deg(patternOf("hesai-xt32").pulse(0, 31)) - azimuth_deg(patternOf("hesai-xt32").pulse(0, 0)),
              -0.169, 1e-3);
}

// p = (r - n) d + n e, of which the first part is r d from n (e - d); x and y turned half round, 36.18 mm up.
TEST(ScanPattern, OfABeamBesideTheAxisMeasuresFromWhereItBegins) {
  const auto pattern = patternOf("ouster-os1-128");
  const double n = 0.015806;
  for (const std::uint64_t column : {0, 100, 777}) {
    const Pulse pulse = pattern.pulse(column, 2);
    const double turn = 2 * std::numbers::pi * (1 - column / 1024.0), off = -1.39 * kRadPerDeg;
    const double up = 20.532 * kRadPerDeg;
    const Eigen::Vector3d d(-std::cos(turn - off) * std::cos(up), -std::sin(turn - off) * std::cos(up), std::sin(up));
    EXPECT_LT((pulse.direction - d).norm(), 1e-12);
    const Eigen::Vector3d e(-std::cos(turn), -std::sin(turn), 0);
    EXPECT_LT((pulse.origin - n * (e - d) - Eigen::Vector3d(0, 0, 0.03618)).norm(), 1e-12);
  }
}

TEST(ScanPattern, OfAHandHeldHeadLeavesOutWhereTheHandleIs) {
  for (const char* id : {"leica-blk2go", "geoslam-zeb-horizon", "faro-orbis"}) {
    const auto pattern = patternOf(id);
    const auto firings = static_cast<std::uint64_t>(2 / pattern.firing_s());
    std::uint64_t measured = 0, all = 0;
    double lowest = 90, highest = -90;
    for (std::uint64_t f = 0; f < firings; f += 7)
      for (std::uint32_t c = 0; c < pattern.channels(); ++c) {
        const Pulse pulse = pattern.pulse(f, c);
        EXPECT_NEAR(pulse.direction.norm(), 1, 1e-12);
        ++all;
        if (!pulse.measured) continue;
        ++measured;
        lowest = std::min(lowest, elevation_deg(pulse)), highest = std::max(highest, elevation_deg(pulse));
      }
    EXPECT_NEAR(static_cast<double>(measured) / static_cast<double>(all), 0.75, 0.01) << id;
    EXPECT_LT(lowest, -43) << id;
    EXPECT_GT(lowest, -45.01) << id;
    EXPECT_GT(highest, 88.9) << id;
  }
}

// 550 kHz · 330/360 = 504 000 points per second; the sheet says 500 000.
TEST(ScanPattern, OfALineScannerLooksAcrossAndDown) {
  const auto pattern = patternOf("riegl-vux-1uav");
  std::uint64_t measured = 0;
  for (std::uint64_t f = 0; f < 55000; ++f) {
    const Pulse pulse = pattern.pulse(f, 0);
    EXPECT_NEAR(pulse.direction.x(), 0, 1e-12);
    measured += pulse.measured ? 1 : 0;
    EXPECT_TRUE(pulse.measured || pulse.direction.z() > 0.96);
  }
  EXPECT_NEAR(static_cast<double>(measured) * 10, 504167, 100);
  EXPECT_NEAR(pattern.pulse(0, 0).direction.z(), -1, 1e-12);
}

TEST(ScanPattern, OfEachInstrumentHasTheRateOfItsSheet) {
  for (const auto& instrument : testing::everyInstrument()) {
    if (!instrument.moving) continue;
    const auto settings = resolveMovingSettings(instrument, {});
    ASSERT_TRUE(settings) << instrument.id;
    const ScanPattern pattern(*instrument.moving, *settings);
    const double rate = pattern.channels() / pattern.firing_s() * instrument.moving->turn_rad / (2 * std::numbers::pi);
    double factor = 1;
    if (instrument.id == "ouster-os1-128") factor = 0.5;                                         // half of the columns
    if (instrument.id == "geoslam-zeb-horizon" || instrument.id == "faro-orbis") factor = 0.75;  // of the head's
    EXPECT_NEAR(rate / instrument.moving->points_per_s, factor, 0.04 * factor) << instrument.id;
  }
}

TEST(ScanPattern, KnowsItsBlocks) {
  const auto pattern = patternOf("velodyne-vlp-16");
  EXPECT_EQ(pattern.pulsesPerBlock(), 1024U);
  EXPECT_EQ(pattern.firingOf(3, 70), 3U * 64 + 6);
  EXPECT_EQ(pattern.channelOf(70), 1U);
  EXPECT_EQ(pattern.blocksUntil(0), 0U);
  EXPECT_EQ(pattern.blocksUntil(1e-9), 1U);
  EXPECT_EQ(pattern.blocksUntil(64 * 55.296e-6 * 10 + 1e-9), 11U);
}

TEST(MovingSettings, AreThoseOfWhatIsCarried) {
  const auto refused = resolveMovingSettings(testing::instrument("leica-rtc360"), {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("stands on a tripod"), std::string::npos);
  EXPECT_EQ(resolveMovingSettings(testing::instrument("velodyne-vlp-16"), {{"rotation", "7"}}).error().source,
            "rotation");
}

}  // namespace
}  // namespace standpoint
