// SPDX-License-Identifier: GPL-3.0-or-later
// Light over many mirrors and panes: each mirror takes R of it and each pane 1 - T, on either way, and the return is as
// far off as the way is long.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "core/units.h"
#include "scanners/radiometry/radiometry.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// Silvered, with a little dust on it so that each image is seen.
PhysicalMaterial mirror() {
  PhysicalMaterial material = lambert(0.02);
  material.gloss_slope = 0.005;
  material.complex_index = {{532, 0.14, 3.1}, {1550, 0.52, 10.7}};
  return material;
}

constexpr double kApart = 3;  // m, between two mirrors
const double kSlant = 1 / std::cos(3 * kRadPerDeg);

struct Kaleidoscope {
  SceneBuilder scene;
  Kaleidoscope() {
    scene.quad({1, 5, -5}, {0, -10, 0}, {0, 0, 10});           // in front, 1 m away
    scene.quad({1 - kApart, -5, -5}, {0, 10, 0}, {0, 0, 10});  // behind
  }
  PointBlock scanned(const Instrument& instrument, Effects effects, double max_range_m = 0) const {
    ScanOptions options;
    options.effects = effects;
    options.channels.truth = options.channels.returns = true;
    auto settings = window(instrument, 0, 0.01, 2.999, 3.001, 1, 1);  // one pulse, beside the glints
    if (max_range_m > 0) settings.max_range_m = max_range_m;
    return testing::scanned(*scene.build(), allOf(*scene.environment(), mirror()), instrument, settings, options)
        .points;
  }
};

// A pulse between two mirrors meets them at a, a + d, a + 2d …: the images of each are 2d apart.
TEST(Kaleidoscope, ShowsEachMirrorAgainTwiceTheirDistanceFartherOff) {
  auto vz = testing::instrument("riegl-vz-400i");
  vz.min_range_m = 0.5;
  const auto points = Kaleidoscope().scanned(vz, Effects::none().with(Effect::mirrors));
  ASSERT_EQ(points.size(), 9U);  // by way of none to eight mirrors
  const double reflected = fresnel(0.52, 10.7, 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double range = kSlant * (1 + kApart * static_cast<double>(i));
    EXPECT_NEAR(static_cast<double>(points.truth.range_m[i]), range, 1e-4) << i;
    EXPECT_NEAR(std::hypot(points.x_m[i], points.z_m[i]), range, 1e-4) << i;
    EXPECT_EQ((points.truth.flags[i] & point_flag::kMirrored) != 0, i > 0) << i;
    EXPECT_EQ(points.product[i], i % 2) << i;  // in front, behind, in front …
    // x = ρ_eq R^(2n) / r²
    const double power =
        std::pow(10, static_cast<double>(points.truth.received_db[i] - points.truth.received_db[0]) / 10);
    const double nearest = kSlant;
    EXPECT_NEAR(power / (std::pow(reflected, 2.0 * static_cast<double>(i)) * std::pow(nearest / range, 2)), 1, 0.01)
        << i;
  }
  for (std::size_t i = 2; i < points.size(); ++i)
    EXPECT_NEAR(static_cast<double>(points.truth.range_m[i] - points.truth.range_m[i - 2]), 2 * kApart * kSlant, 1e-4);
}

// With a threshold, images end where they cannot be detected: x = ρ_eq R^(2n) / r² below ρ_ref / R_max².
TEST(Kaleidoscope, EndsWhereNothingCouldBeDetected) {
  auto vz = testing::instrument("riegl-vz-400i");
  vz.min_range_m = 0.5;
  const auto all = Kaleidoscope().scanned(vz, Effects::none().with(Effect::mirrors));
  const double first_db = static_cast<double>(all.truth.received_db[0]), reflected = fresnel(0.52, 10.7, 1);
  for (const double farthest : {30.0, 60.0, 120.0}) {
    std::size_t expected = 0;
    for (std::size_t n = 0; n <= 8; ++n) {
      const double range = 1 + kApart * static_cast<double>(n);
      const double x =
          std::pow(10, first_db / 10) * std::pow(reflected, 2.0 * static_cast<double>(n)) / (range * range);
      expected += x >= vz.reference_reflectivity / (farthest * farthest) ? 1 : 0;
    }
    const auto few =
        Kaleidoscope().scanned(vz, Effects::none().with(Effect::mirrors).with(Effect::detection), farthest);
    EXPECT_EQ(few.size(), expected) << farthest;
    EXPECT_LT(few.size(), all.size()) << farthest;
  }
}

// Through a pane to a mirror and back through it to a wall behind the scanner: (n_g - 1) d late on each passage, T to
// the fourth, R twice.
TEST(PanesAndMirrors, AddUpOnOneWay) {
  SceneBuilder scene;
  scene.quad({2, 3, -3}, {0, -6, 0}, {0, 0, 6});   // a pane
  scene.quad({4, 3, -3}, {0, -6, 0}, {0, 0, 6});   // a mirror
  scene.quad({-3, -3, -3}, {0, 6, 0}, {0, 0, 6});  // a wall
  PhysicalMaterial glass;
  glass.index_of_refraction = 1.5, glass.thickness_m = 0.006, glass.transmittance = {{532, 0.9}, {1550, 0.9}};
  glass.reflectance = {{532, 0}, {1550, 0}};
  MaterialAssignment assignment = allOf(*scene.environment(), 0.5);
  auto silver = mirror();
  silver.reflectance = {{532, 0}, {1550, 0}};
  assignment.materials.push_back(glass), assignment.materials.push_back(silver);
  for (auto& surface : assignment.surfaces) surface.material = surface.product == 0 ? 1 : surface.product == 1 ? 2 : 0;
  auto vz = testing::instrument("riegl-vz-400i");
  vz.min_range_m = 0.5;
  ScanOptions options;
  options.effects = Effects::none().with(Effect::mirrors).with(Effect::panes);
  options.channels.truth = options.channels.returns = true;
  const auto points = scanned(*scene.build(), assignment, vz, window(vz, 0, 0.01, -0.001, 0.001, 1, 1), options).points;
  const double reflected = fresnel(0.52, 10.7, 1);
  bool found = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.product[i] != 2 || std::abs(points.truth.range_m[i] - 11) > 0.05) continue;
    found = true;
    EXPECT_EQ(points.truth.flags[i] & (point_flag::kMirrored | point_flag::kThroughPane),
              point_flag::kMirrored | point_flag::kThroughPane);
    EXPECT_NEAR(points.x_m[i], 11 + 2 * 0.5 * 0.006, 2e-4);
    const double x = std::pow(10, static_cast<double>(points.truth.received_db[i]) / 10);
    EXPECT_NEAR(x / (std::pow(0.9, 4) * reflected * reflected * 0.5 / 121), 1, 0.01);
  }
  EXPECT_TRUE(found);
}

// Two panes and two mirrors, and no threshold that ends anything: the way branches at each pane, and still ends.
TEST(PanesAndMirrors, EndEvenWithoutAThreshold) {
  SceneBuilder scene;
  for (const double x : {1.0, 1.5, -1.0, -1.5, 2.0, 2.5, -2.0, -2.5}) scene.quad({x, 3, -3}, {0, -6, 0}, {0, 0, 6});
  PhysicalMaterial glass;
  glass.index_of_refraction = 1.5, glass.thickness_m = 0.006, glass.transmittance = {{532, 0.9}, {1550, 0.9}};
  glass.reflectance = {{532, 0.01}, {1550, 0.01}};
  const auto rtc = testing::instrument("leica-rtc360");
  ScanOptions options;
  options.effects = Effects::none().with(Effect::mirrors).with(Effect::panes);
  const auto begin = std::chrono::steady_clock::now();
  const auto points =
      scanned(*scene.build(), allOf(*scene.environment(), glass), rtc, window(rtc, -5, 5, -5, 5, 16, 16), options)
          .points;
  EXPECT_EQ(points.size(), 256U);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 5);
}

}  // namespace
}  // namespace standpoint
