// SPDX-License-Identifier: GPL-3.0-or-later
// physics.md §2.3: what was measured of a surface comes back from it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"
#include "scanners/radiometry/radiometry.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// Oren and Nayar's ratio B/A, at a roughness σ.
double ratio(double sigma) {
  const double s2 = sigma * sigma;
  return 0.45 * s2 / (s2 + 0.09) / (1 - 0.5 * s2 / (s2 + 0.33));
}

// What a rough surface of that albedo sends into the whole hemisphere when lit at 10°, over what it sends back head-on:
// 1 + B/A · (1/π) ∫ max(0, cos φ) sin α tan β cos θ dω, α the larger and β the smaller of the two angles, by sums.
double hemisphereOverHeadOn(double sigma) {
  const double lit = 10 * kRadPerDeg;
  constexpr int kSteps = 2000;
  double sum = 0;
  for (int t = 0; t < kSteps; ++t) {
    const double theta = (t + 0.5) * std::numbers::pi / 2 / kSteps;
    const double alpha = std::max(theta, lit), beta = std::min(theta, lit);
    // ∫ max(0, cos φ) dφ = 2
    sum += 2 * std::sin(alpha) * std::tan(beta) * std::cos(theta) * std::sin(theta) * std::numbers::pi / 2 / kSteps;
  }
  return 1 + ratio(sigma) * sum / std::numbers::pi;
}

// Roughness darkens nothing that was measured: A belongs to facets whose albedo nobody measured.
TEST(MeasuredReflectance, ComesBackHeadOnHoweverRough) {
  for (const double sigma : {0.0, 0.17, 0.26, 0.44, 0.8}) {
    PhysicalMaterial rough = lambert(0.4);
    rough.roughness_rad = sigma;
    EXPECT_FLOAT_EQ(lambertEquivalent(opticsOf(rough, 1550), 1), 0.4F) << sigma;
    EXPECT_NEAR(lambertEquivalent(opticsOf(rough, 1550), 0.5F), 0.4 * (0.5 + ratio(sigma) * 0.75), 1e-6) << sigma;
    rough.hemispherical = true;
    EXPECT_NEAR(lambertEquivalent(opticsOf(rough, 1550), 1), 0.4 / hemisphereOverHeadOn(sigma), 2e-5) << sigma;
  }
}

// On the points of a scan: 20 lg R + 10 lg x is 10 lg of the spectrum's figure.
TEST(MeasuredReflectance, IsThatOfThePointsOfAScan) {
  PhysicalMaterial rough = lambert(0.3);
  rough.roughness_rad = 0.44;
  SceneBuilder scene;
  scene.quad({10, -2, -2}, {0, 4, 0}, {0, 0, 4});
  ScanOptions options;
  options.effects = Effects::none();
  options.channels.truth = true;
  const auto rtc = testing::instrument("leica-rtc360");
  const auto points = scanned(*scene.build(), allOf(*scene.environment(), rough), rtc,
                              window(rtc, -0.01, 0.01, -0.01, 0.01, 2, 2), options)
                          .points;
  ASSERT_EQ(points.size(), 4U);
  for (const float received_db : points.truth.received_db)
    EXPECT_NEAR(static_cast<double>(received_db) + 20, 10 * std::log10(0.3), 0.01);
}

}  // namespace
}  // namespace standpoint
