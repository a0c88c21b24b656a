// SPDX-License-Identifier: GPL-3.0-or-later
// Recipes of physics.md §7 that belong to no other file.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "scanners/engine/footprint.h"
#include "scanners/radiometry/radiometry.h"
#include "scanners/radiometry/range_noise_law.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// A wall across +X, which fills the window of ±1°.
SceneBuilder validationWall(double distance) {
  SceneBuilder scene;
  scene.quad({distance, -0.2 * distance, -0.2 * distance}, {0, 0.4 * distance, 0}, {0, 0, 0.4 * distance});
  return scene;
}

// Mean and RMS of what the points lie behind the wall; its true place is known, so that nothing is fitted away.
struct Residuals {
  double mean_m = 0, rms_m = 0;
};

Residuals residualsAt(double distance, double reflectance, const Instrument& instrument, std::uint32_t columns,
                      Effects effects, int passes = 1) {
  const auto scene = validationWall(distance);
  ScanOptions options;
  options.effects = effects;
  auto settings = window(instrument, -1, 1, -1, 1, columns, 50);
  settings.passes = passes;
  const auto points =
      scanned(*scene.build(), allOf(*scene.environment(), reflectance), instrument, settings, options).points;
  EXPECT_EQ(points.size(), std::size_t{50} * columns);
  Residuals residuals;
  for (const double x : points.x_m) {
    residuals.mean_m += (x - distance) / static_cast<double>(points.size());
    residuals.rms_m += (x - distance) * (x - distance) / static_cast<double>(points.size());
  }
  residuals.rms_m = std::sqrt(residuals.rms_m);
  return residuals;
}

// Xu et al. 2017: amplitude of the VZ-400i in dB.
TEST(NearRange, V5_FollowsTheMeasuredAmplitudesOfTheVz400i) {
  const auto instrument = testing::instrument("riegl-vz-400i");
  const auto amplitude = [&](double r) {
    return 10 * std::log10(static_cast<double>(nearRangeFactor(instrument, static_cast<float>(r))) / (r * r));
  };
  const double far = amplitude(30) - 25.53;
  for (const auto& [range_m, expected_db] : {std::pair{2.0, 28.26}, {10.0, 31.92}, {15.0, 31.01}})
    EXPECT_NEAR(amplitude(range_m) - far, expected_db, 0.05) << range_m;
}

// F = ½ erfc(√2 x/w): what of a Gaussian beam lies beyond a straight edge at a distance x from its axis (§4.2), in the
// mean over pulses; a single pulse strays from it by what its few rays can tell.
TEST(Footprint, V9_SharesItsPowerAtAnEdgeAsAGaussianBeam) {
  for (const auto& [count, single] : {std::pair{kSubRays, 0.057}, std::pair{kReferenceSubRays, 0.02}}) {
    constexpr std::uint32_t kDrawn = 4000;
    for (int step = 0; step < 20; ++step) {
      const double place = -1.425 + 0.15 * step;
      double sum = 0, square = 0;
      for (std::uint32_t pulse = 0; pulse < kDrawn; ++pulse) {
        SubRay rays[kReferenceSubRays];
        drawFootprint(philox({7, 1}, 3, pulse, 9), count, rays);
        double beyond = 0;
        for (int k = 0; k < count; ++k)
          if (rays[k].across > place) beyond += static_cast<double>(rays[k].weight);
        sum += beyond, square += beyond * beyond;
      }
      const double mean = sum / kDrawn, expected = 0.5 * std::erfc(std::numbers::sqrt2 * place);
      EXPECT_NEAR(mean, expected, 0.006) << count << " rays, " << place;
      EXPECT_LT(std::sqrt(square / kDrawn - mean * mean), single) << count << " rays, " << place;
    }
  }
}

// All of a pulse's light is in its rays, none is farther out than the beam's edge, and no two pulses are alike.
TEST(Footprint, OfEachPulseHasAllItsPowerAndItsOwnPattern) {
  SubRay before[kSubRays] = {};
  for (std::uint32_t pulse = 0; pulse < 100; ++pulse) {
    SubRay rays[kSubRays];
    drawFootprint(philox({7, 1}, 3, pulse, 9), kSubRays, rays);
    double power = 0;
    for (int k = 0; k < kSubRays; ++k) {
      power += static_cast<double>(rays[k].weight);
      EXPECT_LE(std::hypot(rays[k].across, rays[k].upward), kBeamEdge + 1e-6);
      EXPECT_NE(rays[k].across, before[k].across);
    }
    EXPECT_NEAR(power, 1, 1e-6);
    std::copy_n(rays, kSubRays, before);
  }
}

TEST(PlaneNoise, V11_IsTheWhiteNoiseThatWasAskedFor) {
  const auto instrument = testing::instrument("leica-blk360-g1");
  const auto residuals = residualsAt(10, 0.78, instrument, 1000, Effects::none().with(Effect::range_noise));
  EXPECT_NEAR(residuals.rms_m / 0.00203, 1, 0.02);
  EXPECT_NEAR(residuals.mean_m, 0, 5 * 0.00203 / std::sqrt(50000.0));
}

// Equal power is equal noise, on the points of a scan: white at 60 m and a ninth of it at 20 m, σ² as physics.md §3.1.
TEST(PlaneNoise, IsThatOfTheReceivedPowerWhateverSentItBack) {
  const auto instrument = testing::instrument("faro-focus-s350");
  const auto effects = Effects::none().with(Effect::range_noise).with(Effect::near_range);
  for (const auto& [range, reflectance] : {std::pair{20.0, 0.1}, {60.0, 0.9}, {120.0, 0.9}}) {
    const double x = powerOf(instrument, {range, reflectance, 0});
    const double sigma = sigma_m(rangeNoiseParts(instrument), x);
    EXPECT_NEAR(residualsAt(range, reflectance, instrument, 400, effects).rms_m / sigma, 1, 0.02) << range;
  }
}

// Averaging takes the white part down by the root, and leaves what all passes share.
TEST(PlaneNoise, V14_FallsByTheRootOfThePassesToWhatTheyShare) {
  auto instrument = testing::instrument("leica-rtc360");
  instrument.correlated = {};
  const auto effects = Effects::none().with(Effect::range_noise).with(Effect::striping);
  EXPECT_NEAR(residualsAt(10, 0.85, instrument, 4000, effects, 1).rms_m / 0.0004, 1, 0.03);
  EXPECT_NEAR(residualsAt(10, 0.85, instrument, 4000, effects, 4).rms_m / 0.0002, 1, 0.03);
  instrument.correlated.column_extra_m = 0.0002;
  EXPECT_NEAR(residualsAt(10, 0.85, instrument, 4000, effects, 4).rms_m / 0.000283, 1, 0.03);
}

// The facade of the paper on VRscan3D: 2.03 mm were simulated without stripes (V11), 2.29 mm measured.
TEST(PlaneNoise, V20_OfTheBlk360IsThatOfTheFacadesWithZeroMean) {
  const auto instrument = testing::instrument("leica-blk360-g1");
  const auto effects = Effects::none().with(Effect::range_noise).with(Effect::striping).with(Effect::angle_noise);
  for (const double distance : {5.0, 8.0, 10.0}) {
    const auto residuals = residualsAt(distance, 0.78, instrument, 8000, effects.with(Effect::near_range));
    const double sheet = sigma_m(rangeNoiseParts(instrument), powerOf(instrument, {distance, 0.78, 0}));
    EXPECT_NEAR(residuals.rms_m / std::hypot(sheet, 0.00106), 1, 0.02) << distance;
    if (distance >= 8) {
      EXPECT_GT(residuals.rms_m, 0.0020) << distance;
    }
    EXPECT_LT(residuals.rms_m, 0.0023) << distance;
    if (distance == 10) {
      EXPECT_NEAR(residuals.rms_m, 0.00229, 0.00002);
    }
    EXPECT_NEAR(residuals.mean_m, 0, 5 * 0.00106 * std::sqrt(3.0 / 8000)) << distance;
  }
}

// Reflectance as RIEGL states it: 10 lg of the power times R², whatever the range.
TEST(ReceivedPower, V18_GivesTheSameReflectanceAtEveryRange) {
  auto instrument = testing::instrument("riegl-vz-400i");
  for (const double range : {20.0, 50.0, 100.0}) {
    const auto scene = validationWall(range);
    ScanOptions options;
    options.effects = Effects::none();
    options.channels.truth = true;
    const auto settings = window(instrument, -0.01, 0.01, -0.01, 0.01, 2, 2);
    const auto points = scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument, settings, options).points;
    ASSERT_EQ(points.size(), 4U);
    for (const float received_db : points.truth.received_db)
      EXPECT_NEAR(static_cast<double>(received_db) + 20 * std::log10(range), -3.01, 0.05) << range;
  }
}

}  // namespace
}  // namespace standpoint
