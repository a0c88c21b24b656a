// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"
#include "scanners/radiometry/radiometry.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// Standard deviation of the measured amplitude over its mean, on a wall of the same reflectance everywhere.
double contrast(const Instrument& instrument, double distance, double reflectance, Effects effects, int passes = 1) {
  SceneBuilder scene;
  scene.quad({distance, -0.2 * distance, -0.2 * distance}, {0, 0.4 * distance, 0}, {0, 0, 0.4 * distance});
  auto settings = window(instrument, -1, 1, -1, 1, 200, 100);
  settings.passes = passes;
  const auto points =
      scanned(*scene.build(), allOf(*scene.environment(), reflectance), instrument, settings, {1, effects}).points;
  double n = 0, sum = 0, squares = 0;
  for (const float stored : points.intensity) {
    const double db = instrument.intensity_low_db +
                      static_cast<double>(stored) * (instrument.intensity_high_db - instrument.intensity_low_db);
    const double x = std::pow(10, db / 10);
    n += 1, sum += x, squares += x * x;
  }
  EXPECT_EQ(n, 20000);
  return std::sqrt(squares / n - sum * sum / n / n) / (sum / n);
}

constexpr Effects kAmplitude = Effects::none().with(Effect::amplitude_noise);

Instrument p40() {
  auto instrument = testing::instrument("leica-p40");
  instrument.intensity_levels = 65536;
  instrument.amplitude.jitter = 0;
  instrument.detection_softness = 0;
  return instrument;
}

// Grains of speckle on the receiver have the area (λR)² / A_spot; M of them and two polarisations leave 1 / √(2M).
TEST(AmplitudeNoise, IsTheSpeckleThatTheReceiversOpeningAverages) {
  const auto instrument = p40();
  for (const double distance : {3.0, 10.0, 40.0}) {
    const double beam = std::hypot(5.95e-3, 0.39e-3 * distance);
    const double spot = std::numbers::pi / 4 * beam * beam, opening = std::numbers::pi / 4 * 0.05 * 0.05;
    const double grain = std::pow(1550e-9 * distance, 2) / spot;
    const double expected = 1 / std::sqrt(2 * (1 + opening / grain));
    EXPECT_NEAR(contrast(instrument, distance, 0.5, kAmplitude) / expected, 1, 0.03) << distance;
    EXPECT_NEAR(contrast(instrument, distance, 0.5, kAmplitude, 4) / expected, 0.5, 0.02) << distance;
  }
}

TEST(AmplitudeNoise, HasTheJitterOfThePulse) {
  auto instrument = p40();
  instrument.amplitude = {.aperture_m = 1000, .jitter = 0.04};  // no speckle is left
  EXPECT_NEAR(contrast(instrument, 10, 0.5, kAmplitude) / 0.04, 1, 0.03);
}

// Without light there is the noise that softens the threshold, here a tenth of x_min, so that a return of k x_min has
// it as 0.1 / k.
TEST(AmplitudeNoise, GrowsTowardsTheThreshold) {
  auto instrument = p40();
  instrument.amplitude.aperture_m = 1000;
  instrument.detection_softness = 0.1;
  instrument.near_range_m = 0;
  for (const double k : {2.0, 4.0}) {
    const double distance = 270 * std::sqrt(0.17 / 0.34 / k);
    EXPECT_NEAR(contrast(instrument, distance, 0.17, kAmplitude) / (0.1 / k), 1, 0.03) << k;
  }
}

TEST(AmplitudeNoise, IsNoneWhenItIsSwitchedOff) {
  EXPECT_LT(contrast(testing::instrument("leica-p40"), 10, 0.5, Effects::none()),
            1e-3);  // the window's own fall-off: cos 1.4°
}

}  // namespace
}  // namespace standpoint
