// SPDX-License-Identifier: GPL-3.0-or-later
// physics.md §4.6, §4.7: panes and mirrors, by their formulas.
#include <cmath>

#include <gtest/gtest.h>

#include "core/units.h"
#include "scanners/radiometry/radiometry.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// At Brewster's angle, tan θ = n, no light of one polarisation comes back: R = ½ ((n² - 1) / (n² + 1))².
TEST(FresnelReflectance, OfADielectricIsExact) {
  for (const double n : {1.32, 1.5, 1.8}) {
    const double brewster = std::cos(std::atan(n)), one = (n * n - 1) / (n * n + 1);
    EXPECT_NEAR(fresnel(n, 0, 1), std::pow((n - 1) / (n + 1), 2), 1e-12) << n;
    EXPECT_NEAR(fresnel(n, 0, brewster), one * one / 2, 1e-12) << n;
    EXPECT_NEAR(fresnel(n, 0, 1e-9), 1, 1e-7) << n;
    for (int degrees = 0; degrees < 90; ++degrees) {  // amplitudes by Snell's law
      const double cosine = std::cos(degrees * kRadPerDeg);
      const double inside = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
      const double across = (cosine - n * inside) / (cosine + n * inside);
      const double along = (n * cosine - inside) / (n * cosine + inside);
      EXPECT_NEAR(fresnel(n, 0, cosine), (across * across + along * along) / 2, 1e-12) << n << ' ' << degrees;
    }
  }
  // Schlick's approximation is 1.05 dB off at 60° on n = 1.5: 2.1 dB for a mirror image, which is reflected twice.
  const double schlick = 0.04 + 0.96 * std::pow(0.5, 5);
  EXPECT_NEAR(20 * std::log10(fresnel(1.5, 0, 0.5) / schlick), 2.10, 0.01);
  for (const auto& [degrees, reflectance] : {std::pair{60, 0.06}, {70, 0.13}, {80, 0.35}, {85, 0.58}})  // water
    EXPECT_NEAR(fresnel(1.33, 0, std::cos(degrees * kRadPerDeg)), reflectance, 0.006) << degrees;
}

TEST(FresnelReflectance, IsThatOfMirrorsOfADielectricAndOfAMetal) {
  PhysicalMaterial water = lambert(0);
  water.index_of_refraction = 1.32, water.gloss_slope = 0.005;
  EXPECT_NEAR(mirrorReflectance(opticsOf(water, 905), std::cos(80 * kRadPerDeg)),
              fresnel(1.32, 0, std::cos(80 * kRadPerDeg)), 1e-12);
  PhysicalMaterial copper = lambert(0);
  copper.complex_index = {{532, 1.1159, 2.6}, {905, 0.3028, 5.86}}, copper.gloss_slope = 0.005;
  EXPECT_NEAR(mirrorReflectance(opticsOf(copper, 905), 1), 0.966, 1e-3);  // Johnson and Christy
  // A metal of n² + k² ≫ 1 absorbs 4n cos θ / ((n + cos θ)² + k²) across and 4n cos θ / ((n cos θ + 1)² + k² cos² θ)
  // along (Born and Wolf §14.2), but for sin² θ / (n² + k²): 2 % here.
  const double n = 0.3028, k = 5.86, c = 0.5;
  const double across = 4 * n * c / ((n + c) * (n + c) + k * k);
  const double along = 4 * n * c / ((n * c + 1) * (n * c + 1) + k * k * c * c);
  EXPECT_NEAR((1 - fresnel(n, k, c)) / ((across + along) / 2), 1, 0.03);
}

// A pane of thickness d: one way the range is longer by d / cos θt (n_g - cos(θ - θt)), and the light goes on
// d sin(θ - θt) / cos θt aside. A wall behind that leans as the beam does turns the second into range as well.
TEST(PaneOfGlass, DelaysByItsGroupIndexAndShiftsTheBeamAside) {
  constexpr double kIndex = 1.507, kGroup = 1.5256, kThick_m = 0.02;
  PhysicalMaterial glass = lambert(0.001);
  glass.id = "glass";
  glass.index_of_refraction = kIndex, glass.gloss_slope = 0.005, glass.thickness_m = kThick_m;
  glass.transmittance = {{1550, 0.81}};
  glass.group_index = {{532, 1.5559}, {1550, kGroup}};
  auto rtc = testing::instrument("leica-rtc360");
  ScanOptions options;
  options.effects = Effects::none().with(Effect::panes);
  for (const double degrees : {5.0, 30.0, 60.0})  // head-on the pane glints
    for (const double lean : {0.0, 0.5}) {        // of the wall: x rises by so much for each metre of y
      const double theta = degrees * kRadPerDeg, inside = std::asin(std::sin(theta) / kIndex);
      SceneBuilder scene;
      // Its normal is (cos θ, -sin θ, 0) away from the scanner: the light leaves it on the side of -y.
      const Eigen::Vector3d across(std::sin(theta), std::cos(theta), 0);
      const auto pane = scene.quad(Eigen::Vector3d(5, 0, -2) - 4 * across, 8 * across, {0, 0, 4});
      const auto wall = scene.quad({8 - 4 * lean, -4, -4}, {8 * lean, 8, 0}, {0, 0, 8});
      MaterialAssignment assignment;
      assignment.materials = {lambert(0.6), glass};
      assignment.surfaces = {{pane, 0, 1, "test"}, {wall, 0, 0, "test"}};
      const auto points =
          scanned(*scene.build(), assignment, rtc, window(rtc, -0.0001, 0.0001, -0.0001, 0.0001, 2, 2), options).points;
      ASSERT_EQ(points.size(), 4U) << degrees;
      const double excess = kThick_m / std::cos(inside) * (kGroup - std::cos(theta - inside));
      const double aside = -kThick_m * std::sin(theta - inside) / std::cos(inside);  // along y
      for (const double x : points.x_m) EXPECT_NEAR(x, 8 + excess + lean * aside, 1e-5) << degrees << ' ' << lean;
    }
}

}  // namespace
}  // namespace standpoint
