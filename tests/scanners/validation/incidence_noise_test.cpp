// SPDX-License-Identifier: GPL-3.0-or-later
// physics.md §3.2: speckle moves the centre of a footprint, and on a slanted surface the range.
//   σ = D tan θ / √(32 M),  M = 2 (1 + A_receiver A_spot / (λR)²)
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/random.h"
#include "core/units.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

double grains(const Instrument& instrument, double range_m) {
  const double quarter_pi = std::numbers::pi / 4, wavelength_m = 1e-9 * instrument.wavelength_nm;
  const double spot_m = std::hypot(instrument.exit_diameter_m, instrument.divergence_rad * range_m);
  const double receiver = quarter_pi * instrument.amplitude.aperture_m * instrument.amplitude.aperture_m;
  return 2 * (1 + receiver * quarter_pi * spot_m * spot_m / (wavelength_m * range_m * wavelength_m * range_m));
}

double expected_m(const Instrument& instrument, double range_m, double incidence_rad, int passes) {
  const double spot_m = std::hypot(instrument.exit_diameter_m, instrument.divergence_rad * range_m);
  return spot_m * std::tan(incidence_rad) / std::sqrt(32 * grains(instrument, range_m) * passes);
}

// σ of the ranges on a plane that is turned by the angle, about what they would be without noise.
double measured_m(const Instrument& instrument, double range_m, double incidence_rad, int passes) {
  SceneBuilder scene;
  const Eigen::Vector3d along(std::sin(incidence_rad), std::cos(incidence_rad), 0);
  const Eigen::Vector3d middle(range_m, 0, 0), up = Eigen::Vector3d::UnitZ();
  scene.quad(middle - 0.2 * range_m * (along + up), 0.4 * range_m * along, 0.4 * range_m * up);
  auto settings = window(instrument, -0.5, 0.5, -0.5, 0.5, 64, 64);
  settings.passes = passes;
  ScanOptions options;
  const auto range = [&](const PointBlock& points, std::size_t i) {
    return Eigen::Vector3d(points.x_m[i], points.y_m[i], points.z_m[i]).norm();
  };
  const auto rays = scene.build();
  const auto assignment = allOf(*scene.environment(), 0.5);
  options.effects = Effects::none();
  const auto exact = scanned(*rays, assignment, instrument, settings, options).points;
  options.effects = Effects::none().with(Effect::incidence_noise);
  const auto noisy = scanned(*rays, assignment, instrument, settings, options).points;
  EXPECT_EQ(noisy.size(), exact.size());
  double square = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i)
    square += std::pow(range(noisy, i) - range(exact, i), 2) / static_cast<double>(noisy.size());
  return std::sqrt(square);
}

TEST(IncidenceNoise, IsTheFootprintsTimesTheTangentOverTheRootOfItsGrains) {
  for (const char* id : {"leica-rtc360", "faro-focus-s350", "riegl-vz-400i"})
    for (const double range : {5.0, 20.0})
      for (const double degrees : {30.0, 60.0, 75.0}) {
        const auto instrument = testing::instrument(id);
        const double incidence = degrees * kRadPerDeg;
        EXPECT_NEAR(measured_m(instrument, range, incidence, 1) / expected_m(instrument, range, incidence, 1), 1, 0.05)
            << id << ' ' << range << ' ' << degrees;
      }
  const auto rtc = testing::instrument("leica-rtc360");
  EXPECT_NEAR(measured_m(rtc, 10, 1.0, 2) / expected_m(rtc, 10, 1.0, 2), 1, 0.05);
  EXPECT_LT(measured_m(rtc, 10, 0, 1), 2e-6);
}

// Speckle drawn cell by cell, two polarisations each: its centre strays as the formula says.
TEST(IncidenceNoise, IsThatOfSpeckleDrawnCellByCell) {
  constexpr int kSide = 41, kDraws = 4000;
  constexpr double kRadius = 1, kStep = 3.0 / (kSide - 1);  // out to 1.5 w
  double sum_intensity = 0, sum_square = 0, profile = 0, centre_square = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    double power = 0, moment = 0;
    for (int i = 0; i < kSide; ++i)
      for (int j = 0; j < kSide; ++j) {
        const double x = (i - kSide / 2) * kStep, y = (j - kSide / 2) * kStep;
        const auto block =
            philox({7, 0}, static_cast<std::uint32_t>(draw), static_cast<std::uint32_t>(kSide * i + j), 1);
        const double speckle = -std::log(uniform(block[0])) - std::log(uniform(block[1]));  // mean 2, variance 2
        const double cell = std::exp(-2 * (x * x + y * y) / (kRadius * kRadius)) * speckle / 2;
        power += cell, moment += cell * x;
      }
    sum_intensity += power, sum_square += power * power;
    centre_square += moment * moment / (power * power);
    profile = power;
  }
  ASSERT_GT(profile, 0);
  const double mean = sum_intensity / kDraws;
  const double one_over_grains = sum_square / kDraws / (mean * mean) - 1;  // the contrast of the sum
  EXPECT_NEAR(centre_square / kDraws / (4 * kRadius * kRadius / 32 * one_over_grains), 1, 0.06);
}

TEST(IncidenceNoise, AddsToTheReceiversInSquares) {
  auto s350 = withoutBias(testing::instrument("faro-focus-s350"));
  const double range_m = 10, incidence = 70 * kRadPerDeg;
  SceneBuilder scene;
  const Eigen::Vector3d along(std::sin(incidence), std::cos(incidence), 0), up = Eigen::Vector3d::UnitZ();
  scene.quad(Eigen::Vector3d(range_m, 0, 0) - 3 * (along + up), 6 * along, 6 * up);
  const auto rays = scene.build();
  const auto assignment = allOf(*scene.environment(), 0.5);
  const auto settings = window(s350, -0.5, 0.5, -0.5, 0.5, 80, 80);
  const auto variance = [&](Effects effects) {
    ScanOptions options;
    options.effects = Effects::none();
    const auto exact = scanned(*rays, assignment, s350, settings, options).points;
    options.effects = effects;
    const auto noisy = scanned(*rays, assignment, s350, settings, options).points;
    double square = 0;
    for (std::size_t i = 0; i < noisy.size(); ++i)
      square += std::pow(Eigen::Vector3d(noisy.x_m[i], noisy.y_m[i], noisy.z_m[i]).norm() -
                             Eigen::Vector3d(exact.x_m[i], exact.y_m[i], exact.z_m[i]).norm(),
                         2);
    return square / static_cast<double>(noisy.size());
  };
  const Effects receiver = Effects::none().with(Effect::range_noise);
  const double spread = expected_m(s350, range_m, incidence, 1);
  EXPECT_NEAR(variance(receiver.with(Effect::incidence_noise)) / (variance(receiver) + spread * spread), 1, 0.05);
}

}  // namespace
}  // namespace standpoint
