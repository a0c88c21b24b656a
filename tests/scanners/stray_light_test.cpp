// SPDX-License-Identifier: GPL-3.0-or-later
// Light that is not the beam's own way there and back: daylight, another instrument's, the beam's wings, dim mirrors.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"
#include "scanners/engine/daylight.h"
#include "scanners/engine/footprint.h"
#include "scanners/engine/reflector_halo.h"
#include "scanners/radiometry/radiometry.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

constexpr Effects kStrayLaw = Effects::none().with(Effect::detection);

PointBlock lit(const SceneBuilder& scene, const MaterialAssignment& assignment, const Instrument& instrument,
               const ScanSettings& settings, ScanOptions options) {
  options.channels.truth = true;
  return scanned(*scene.build(), assignment, instrument, settings, options).points;
}

TEST(Sun, IsReadAsAnglesAndIrradiance) {
  const auto sun = sunFrom("135,40,600");
  ASSERT_TRUE(sun);
  EXPECT_NEAR(sun->azimuth_rad, 135 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(sun->elevation_rad, 40 * kRadPerDeg, 1e-12);
  EXPECT_EQ(sun->irradiance_W_m2, 600);
  EXPECT_EQ(sunFrom("0,90")->irradiance_W_m2, 1000);
  EXPECT_NEAR(sunFrom("0,90,60000lux")->irradiance_W_m2, 500, 1e-9);
  for (const char* text : {"", "135", "135,", "135,0", "135,91", "135,40,2000", "135,40,-1", "a,b", "135,40,600,1",
                           "135,40,lux", "nan,40", "135,nan"}) {
    const auto bad = sunFrom(text);
    ASSERT_FALSE(bad) << text;
    EXPECT_EQ(bad.error().source, "--sun");
  }
}

// A wall of ρ = 0.34 that faces a sun of 45° takes the threshold up by √(1 + β), β = s ρ cos 45°, and so the range down
// by the fourth root; in the shade of a roof it does not.
TEST(Sun, TakesRangeFromWhatItLights) {
  auto instrument = testing::instrument("leica-p40");
  instrument.near_range_m = 0;
  const double beta = instrument.sun_noise * 0.34 * std::sqrt(0.5);
  const double limit = 270 / std::pow(1 + beta, 0.25);
  for (const bool shaded : {false, true})
    for (const double fraction : {0.99, 1.01}) {
      SceneBuilder scene;
      scene.quad({fraction * limit, -5, -5}, {0, 10, 0}, {0, 0, 10});
      if (shaded) scene.quad({fraction * limit - 40, -20, 30}, {0, 40, 0}, {30, 0, 0});
      ScanOptions options{1, kStrayLaw.with(Effect::sun)};
      options.sun = Sun{-90 * kRadPerDeg, 45 * kRadPerDeg, 1000};  // from -X
      const auto settings = window(instrument, -0.02, 0.02, -0.02, 0.02, 8, 8);
      const auto assignment = allOf(*scene.environment(), 0.34);
      EXPECT_EQ(lit(scene, assignment, instrument, settings, options).size(), shaded || fraction < 1 ? 64U : 0U)
          << shaded << fraction;
      options.effects = options.effects.without(Effect::sun);
      EXPECT_EQ(lit(scene, assignment, instrument, settings, options).size(), 64U);
    }
}

// σ² = σ0² + (k/x)² (1 + β): the X7's sheet has one figure, of which half is σ0².
TEST(Sun, AddsToTheRangeNoiseThatFallsWithPower) {
  auto instrument = withoutBias(testing::instrument("trimble-x7"));
  const auto figure = instrument.range_noise.front();
  instrument.sun_noise = 6;
  SceneBuilder scene;
  scene.quad({figure.range_m, -5, -5}, {0, 10, 0}, {0, 0, 10});
  ScanOptions options{1, Effects::none().with(Effect::range_noise).with(Effect::sun).with(Effect::near_range)};
  options.sun = Sun{-90 * kRadPerDeg, 30 * kRadPerDeg, 500};
  const auto points = lit(scene, allOf(*scene.environment(), figure.reflectivity), instrument,
                          window(instrument, -1, 1, -1, 1, 200, 100), options);
  ASSERT_EQ(points.size(), 20000U);
  double squares = 0;
  for (const float x : points.x_m) squares += std::pow(static_cast<double>(x) - figure.range_m, 2) / 20000;
  const double beta = 6 * 0.5 * figure.reflectivity * std::cos(30 * kRadPerDeg);
  EXPECT_NEAR(std::sqrt(squares) / (figure.sigma_m * std::sqrt(0.5 + 0.5 * (1 + beta))), 1, 0.02);
}

// The disc of the sun is 46 000 times as bright as a white surface under it; beside it a thousandth of that comes in at
// 1°. A mast before it, half as far as the sheet's range goes (4 x_min), is lost where √(1 + β) is above 4.
TEST(Sun, InTheFieldOfViewBlindsTheReceiver) {
  auto instrument = testing::instrument("leica-p40");
  instrument.near_range_m = 0;
  instrument.sun_noise = 1;
  SceneBuilder scene;
  scene.quad({135, -40, -40}, {0, 80, 0}, {0, 0, 79.9});  // ends below the sun
  ScanOptions options{1, kStrayLaw.with(Effect::sun)};
  options.sun = Sun{90 * kRadPerDeg, 17 * kRadPerDeg, 1000};  // towards +X
  const auto settings = window(instrument, -5, 5, 6, 16.4, 40, 200);
  const auto assignment = allOf(*scene.environment(), 0.34);
  const auto points = lit(scene, assignment, instrument, settings, options);
  // β = 46 250 · 10⁻³ / ψ² = 15 / (the cosine's part): ψ where 1 + β = 16 · cos² of the incidence and the longer way.
  std::size_t lost = settings.columns * settings.rows - points.size();
  EXPECT_GT(lost, 100U);
  double nearest = 10;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d way(points.x_m[i], points.y_m[i], points.z_m[i]);
    const double cosine = 135 / way.norm(), margin = 4 * cosine * std::pow(135 / way.norm(), 2);
    const double angle =
        std::acos(
            std::clamp(way.normalized().dot(Eigen::Vector3d(std::cos(17 * kRadPerDeg), 0, std::sin(17 * kRadPerDeg))),
                       -1.0, 1.0)) /
        kRadPerDeg;
    nearest = std::min(nearest, angle - std::sqrt(1e-3 / std::pow(0.00465, 2) / (margin * margin - 1)));
  }
  EXPECT_NEAR(nearest, 0, 0.06);  // a step of the grid
}

TEST(Interference, LeavesPointsAtRandomRangesInTheAir) {
  const auto instrument = testing::instrument("leica-p40");
  SceneBuilder scene;
  scene.quad({-5, -1, -1}, {0, 2, 0}, {0, 0, 2});  // elsewhere
  ScanOptions options{1, kStrayLaw.with(Effect::interference)};
  options.interference = 0.05;
  const auto settings = window(instrument, -20, 20, -20, 20, 200, 200);
  const auto points = lit(scene, allOf(*scene.environment(), 0.5), instrument, settings, options);
  EXPECT_NEAR(static_cast<double>(points.size()), 2000, 5 * std::sqrt(2000 * 0.95));
  double mean = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points.truth.flags[i], point_flag::kNoise);
    EXPECT_EQ(points.product[i], 1U);  // "Nothing"
    mean += static_cast<double>(points.truth.range_m[i]) / static_cast<double>(points.size());
  }
  EXPECT_NEAR(mean, (0.4 + 270) / 2, 5 * 270 / std::sqrt(12.0 * 2000));
  options.effects = kStrayLaw;
  EXPECT_EQ(lit(scene, allOf(*scene.environment(), 0.5), instrument, settings, options).size(), 0U);
}

// A reflector of 4 cm before the sky at 20 m: pedestal · G / R² is above the threshold as far as the wings reach, 8 w.
TEST(Halo, StandsAroundAReflectorAsFarAsTheWingsOfTheBeam) {
  auto instrument = testing::instrument("leica-p40");
  instrument.near_range_m = 0;
  SceneBuilder scene;
  scene.quad({20, -0.02, -0.02}, {0, 0.04, 0}, {0, 0, 0.04});
  auto reflector = lambert(0.5);
  reflector.retro_gain = 2000;
  const auto assignment = allOf(*scene.environment(), reflector);
  const auto settings = window(instrument, -0.5, 0.5, -0.5, 0.5, 200, 200);
  const Effects effects = kStrayLaw.with(Effect::footprint);
  const auto plain = lit(scene, assignment, instrument, settings, {1, effects});
  const auto haloed = lit(scene, assignment, instrument, settings, {1, effects.with(Effect::halo)});
  const double radius = beamRadius(instrument, 20);
  const auto farthest = [](const PointBlock& points) {
    double most = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      most = std::max({most, std::abs(static_cast<double>(points.y_m[i])) - 0.02,
                       std::abs(static_cast<double>(points.z_m[i])) - 0.02});
    return most;
  };
  EXPECT_GT(plain.size(), 100U);
  EXPECT_LT(farthest(plain), (kBeamEdge + 0.1) * radius);
  EXPECT_GT(haloed.size(), 2 * plain.size());
  EXPECT_NEAR(farthest(haloed) / radius, 7, 0.5);  // the outermost ring of rays
  std::size_t outside = 0;
  for (std::size_t i = 0; i < haloed.size(); ++i) {
    ASSERT_NEAR(haloed.x_m[i], 20, 0.01);
    const bool beside = std::max(std::abs(haloed.y_m[i]), std::abs(haloed.z_m[i])) > 0.02 + (kBeamEdge + 0.1) * radius;
    EXPECT_TRUE(!beside || (haloed.truth.flags[i] & point_flag::kMirrored) != 0);
    outside += beside ? 1 : 0;
  }
  EXPECT_GT(outside, 200U);
  auto dim = reflector;
  dim.retro_gain = 1;  // 0.0003 / 400 is below the threshold of 0.34 / 270²
  EXPECT_EQ(lit(scene, allOf(*scene.environment(), dim), instrument, settings, {1, effects.with(Effect::halo)}).size(),
            lit(scene, allOf(*scene.environment(), dim), instrument, settings, {1, effects}).size());
}

TEST(Halo, HasTheWholePedestalInItsRays) {
  float sum = 0;
  for (const auto& ray : wingRays()) sum += ray.weight;
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(RoughMirror, IsTheMirrorWhereItsLobeIsNarrowerThanTheBeam) {
  EXPECT_EQ(roughMirrorFraction(1e-4, 3e-3, 5, 5), 1);
  // A (R1 + R2)² / (R1² R2² 8π m²) with A = π w².
  EXPECT_NEAR(roughMirrorFraction(0.05, 3e-3, 5, 0.5),
              std::numbers::pi * 9e-6 * 5.5 * 5.5 / (25 * 0.25 * 8 * std::numbers::pi * 0.0025), 1e-9);
}

// A post on wet ground is seen again below the ground, as high as the image is bright enough; on dry ground not.
TEST(RoughMirror, ShowsWhatIsNearItBelowTheGround) {
  auto instrument = testing::instrument("leica-p40");
  SceneBuilder scene;
  const auto ground = scene.quad({-20, -20, -1.5}, {40, 0, 0}, {0, 40, 0});
  const auto post = scene.quad({6, -0.5, -1.5}, {0, 1, 0}, {0, 0, 2});
  auto wet = lambert(0.001);
  wet.gloss_slope = 0.05;
  wet.index_of_refraction = 1.33;
  MaterialAssignment assignment;
  assignment.materials = {wet, lambert(0.9)};
  assignment.surfaces = {{ground, 0, 0, "test", 1}, {post, 0, 1, "test", 1}};
  const auto settings = window(instrument, -3, 3, -20, -10, 30, 400);
  const auto below = [&](Effects effects) {
    const auto points = lit(scene, assignment, instrument, settings, {1, effects});
    std::vector<double> depths;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((points.truth.flags[i] & point_flag::kMirrored) != 0) {
        EXPECT_EQ(points.product[i], post);
        depths.push_back(-1.5 - static_cast<double>(points.z_m[i]));
      }
    std::sort(depths.begin(), depths.end());
    return depths;
  };
  EXPECT_TRUE(below(kStrayLaw.with(Effect::mirrors)).empty());
  const auto depths = below(kStrayLaw.with(Effect::rough_mirrors));
  ASSERT_GT(depths.size(), 10U);
  EXPECT_GT(depths.back(), 0.02);
  EXPECT_LT(depths.back(), 0.3);
}

// With all of it at once, whatever the number of threads and the parts of the grid.
TEST(StrayLight, IsTheSameForAnyNumberOfThreads) {
  const auto instrument = testing::instrument("leica-p40");
  SceneBuilder scene;
  scene.box({-6, -5, -1.5}, {6, 5, 3}, true);
  const auto post = scene.quad({4, -0.05, -0.05}, {0, 0.1, 0}, {0, 0, 0.1});
  auto assignment = allOf(*scene.environment(), 0.5);
  auto reflector = lambert(0.5);
  reflector.retro_gain = 800;
  assignment.materials.push_back(reflector);
  for (auto& surface : assignment.surfaces)
    if (surface.product == post) surface.material = static_cast<std::int32_t>(assignment.materials.size() - 1);
  ScanOptions options{7};
  options.sun = Sun{1, 0.6, 900};
  options.interference = 0.01;
  options.channels.truth = true;
  const auto settings = window(instrument, -40, 40, -40, 40, 120, 200);
  const auto rays = scene.build();
  options.threads = 1;
  const auto one = scanned(*rays, assignment, instrument, settings, options).points;
  options.threads = 5;
  const auto five = scanned(*rays, assignment, instrument, settings, options).points;
  EXPECT_EQ(one.x_m, five.x_m);
  EXPECT_EQ(one.intensity, five.intensity);
  EXPECT_EQ(one.truth.flags, five.truth.flags);
  PointsKept parts;
  Progress progress;
  for (std::uint32_t from = 0; from < settings.columns; ++from) {
    options.first_column = from, options.end_column = from + 1;
    ASSERT_TRUE(scan(*rays, assignment, instrument, settings, Pose{}, options, parts, progress));
  }
  EXPECT_EQ(one.x_m, parts.all.x_m);
  EXPECT_EQ(one.truth.flags, parts.all.truth.flags);
}

}  // namespace
}  // namespace standpoint
