// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/radiometry.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/portable_math.h"
#include "core/units.h"
#include "scanners/radiometry/signal_lanes.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

float cosine(double degrees) { return static_cast<float>(std::cos(degrees * kRadPerDeg)); }

SignalLanes received(const Instrument& instrument, float equivalent, float range) {
  SignalLanes lanes{};
  for (int k = 0; k < kSignalLanes; ++k) {
    lanes.diffuse[k] = equivalent, lanes.cosine[k] = 1;
    lanes.range_m[k] = range, lanes.gain[k] = 1, lanes.variation[k] = 1, lanes.known_x[k] = -1;
  }
  receive(lanes, receiverOf(instrument, Effects(), 0));
  return lanes;
}

TEST(ReceivedPower, FollowsTheLambertRangeLaw) {  // physics.md V2
  Instrument instrument = testing::instrument("leica-rtc360");
  instrument.near_range_m = 0;
  const Optics grey = opticsOf(testing::lambert(0.5), 1550);
  const float near = received(instrument, lambertEquivalent(grey, 1), 10).x[0];
  EXPECT_NEAR(near, 0.005, 1e-8);
  EXPECT_NEAR(received(instrument, lambertEquivalent(grey, 1), 20).x[3] / near, 0.25, 1e-6);
  EXPECT_NEAR(received(instrument, lambertEquivalent(grey, cosine(60)), 10).x[15] / near, 0.5, 1e-6);
}

// V6, over its value head-on (A = 0.865): there the measured reflectance comes back.
TEST(OrenNayar, HasThePublishedShapeAtTwentyDegreesAndTheMeasuredReflectanceHeadOn) {
  PhysicalMaterial rough = testing::lambert(1);
  rough.roughness_rad = 20 * kRadPerDeg;
  const Optics optics = opticsOf(rough, 1550);
  EXPECT_EQ(lambertEquivalent(optics, 1), 1);
  for (const auto& [angle, value] :
       {std::pair{0, 0.865}, {30, 0.814}, {45, 0.741}, {60, 0.627}, {75, 0.465}, {80, 0.401}})
    EXPECT_NEAR(lambertEquivalent(optics, cosine(angle)), value / 0.8651, 1e-3) << angle;
}

// physics.md §2.4, F0 = 0.04; of its values at 20° the formula beside them gives 0.94, as if they lacked the cosine.
TEST(Gloss, GlintsAsTheBeckmannLobeSays) {
  for (const auto& [slope, head_on, at_five, at_twenty] : {std::tuple{0.05, 4.0, 0.19, 0.0},
                                                           {0.1, 1.0, 0.48, 0.0},
                                                           {0.2, 0.25, 0.21, 0.0122},
                                                           {0.3, 0.11, 0.10, 0.0348}}) {
    PhysicalMaterial coat = testing::lambert(0);
    coat.index_of_refraction = 1.5;
    coat.gloss_slope = slope;
    const Optics optics = opticsOf(coat, 1550);
    EXPECT_NEAR(lambertEquivalent(optics, 1), head_on, 0.005) << slope;
    EXPECT_NEAR(lambertEquivalent(optics, cosine(5)), at_five, 0.006) << slope;
    EXPECT_NEAR(lambertEquivalent(optics, cosine(20)), at_twenty, 0.002) << slope;
  }
}

TEST(Pane, WithoutLossFollowsFresnel) {  // V7
  EXPECT_NEAR(slab(1.52, 1, 1).reflected, 0.0817, 1e-3);
  EXPECT_NEAR(slab(1.52, 1, 1).transmitted, 0.9183, 1e-3);
  for (const auto& [angle, squared] : {std::pair{0, 0.843}, {60, 0.711}, {80, 0.208}})
    EXPECT_NEAR(std::pow(slab(1.52, 1, cosine(angle)).transmitted, 2), squared, 1e-3) << angle;
}

TEST(Pane, OfClearFloatTransmitsAsRubinMeasured) {  // V8: n 1.5152, k 3.77e-6, 4 mm at 905 nm
  const double inner = std::exp(-4 * std::numbers::pi * 3.77e-6 * 4e-3 / 905e-9);
  const SlabPower power = slab(1.5152, inner, 1);
  EXPECT_NEAR(power.transmitted, 0.745, 2e-3);
  EXPECT_NEAR(power.reflected, 0.067, 2e-3);
  EXPECT_NEAR(innerTransmittance(1.5152, power.transmitted), inner, 1e-9);
}

// physics.md §4.6: a unit of two clear 4 mm panes at 1064 nm lets .285/.166/.016 through and back at 0/60/80°.
TEST(Pane, BehindAnotherLetsThroughWhatTheBuildUpDoes) {
  const double inner = std::exp(-4 * std::numbers::pi * 4.92e-6 * 4e-3 / 1064e-9);
  for (const auto& [angle, squared] : {std::pair{0, 0.285}, {60, 0.166}, {80, 0.016}})
    EXPECT_NEAR(std::pow(stack(slab(1.5129, inner, cosine(angle)), 2).transmitted, 2), squared, 2e-3) << angle;
  const SlabPower one = slab(1.52, 1, cosine(40)), three = stack(one, 3);
  EXPECT_NEAR(three.reflected + three.transmitted, 1, 1e-12);  // nothing is lost in lossless panes
  EXPECT_NEAR(three.transmitted, one.transmitted / (one.transmitted + 3 * one.reflected),
              1e-12);  // Stokes 1862: n equal plates
}

TEST(Metal, GlintsAtEachWavelengthAsItsIndexSays) {  // copper, Johnson and Christy: 0.602 at 532 nm, 0.966 at 905 nm
  PhysicalMaterial copper = testing::lambert(0);
  copper.complex_index = {{532, 1.1159, 2.6}, {905, 0.3028, 5.86}};
  copper.gloss_slope = 0.5;
  for (const auto& [wavelength, reflectance] : {std::pair{532, 0.602}, {905, 0.966}})
    EXPECT_NEAR(opticsOf(copper, wavelength).glint, reflectance / (4 * 0.25), 2e-3) << wavelength;
}

TEST(Pane, NeitherGainsNorLosesPowerWithoutAbsorption) {
  for (int angle = 0; angle < 90; angle += 5) {
    const SlabPower power = slab(1.52, 1, cosine(angle));
    EXPECT_NEAR(power.reflected + power.transmitted, 1, 1e-12) << angle;
  }
}

TEST(UnassignedSurface, ReflectsTheLuminanceOfItsColour) {
  EXPECT_NEAR(opticsOf(Colour{0.5F, 0.5F, 0.5F, 1}).diffuse, 0.214, 1e-3);  // IEC 61966-2-1
  EXPECT_FLOAT_EQ(opticsOf(Colour{0, 0, 0, 1}).diffuse, 0.05F);
  EXPECT_GT(opticsOf(Colour{0, 1, 0, 1}).diffuse, opticsOf(Colour{1, 0, 0, 1}).diffuse);
}

// From where the power falls with range: 1 / (R² + near^p R^(2-p)) is largest at near (p/2 - 1)^(1/p).
TEST(RangeNoise, NeverFallsWithRangeNorRisesWithReflectivity) {
  for (const auto& instrument : testing::instruments()) {
    const double power = instrument.near_range_power;
    double peak = power > 2 ? instrument.near_range_m * std::pow(power / 2 - 1, 1 / power) : 0;
    if (instrument.near_range_curve.below_m > 0) peak = 10.05;  // of the VZ-400i's measured amplitude, physics.md §2.2
    for (float range = std::max(2.0F, static_cast<float>(peak)); range < 60; range *= 1.2F)
      for (float reflectivity = 0.02F; reflectivity < 0.9F; reflectivity *= 1.3F) {
        const float sigma = received(instrument, reflectivity, range).sigma_m[0];
        EXPECT_LE(sigma, received(instrument, reflectivity, range * 1.2F).sigma_m[0] * 1.0001F) << instrument.id;
        EXPECT_GE(sigma * 1.0001F, received(instrument, reflectivity * 1.3F, range).sigma_m[0]) << instrument.id;
      }
  }
}

TEST(PortableMath, AgreesWithTheLibrary) {
  for (float x = 1e-30F; x < 1e30F; x *= 1.37F)
    EXPECT_NEAR(portable::log2(x), std::log2(static_cast<double>(x)),
                3e-7 * std::max(1.0, std::abs(std::log2(static_cast<double>(x)))));
  for (int k = 0; k <= 10000; ++k) {
    const float u = static_cast<float>(k) / 10000;
    float sine, cos;
    portable::sinCosTurn(u, sine, cos);
    EXPECT_NEAR(sine, std::sin(2 * std::numbers::pi * u), 5e-7);
    EXPECT_NEAR(cos, std::cos(2 * std::numbers::pi * u), 5e-7);
  }
  for (float x = 0; x > -100; x -= 0.37F) EXPECT_NEAR(portable::exp2(x) / std::exp2(x), 1, 4e-7);
}

}  // namespace
}  // namespace standpoint
