// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/waveform.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/portable_math.h"

namespace standpoint {
namespace {

std::vector<Echo> echoes(const Waveform& waveform, std::vector<Contribution> light) {
  for (std::size_t i = 0; i < light.size(); ++i) light[i].index = static_cast<int>(i);
  std::vector<Echo> result;
  receiveEchoes(waveform, light, result);
  return result;
}

// physics.md V9: F = 0.3 of the light on the nearer of two equal surfaces 5 cm apart.
TEST(PulsedReceiver, V9_MergesSurfacesNearerThanItsPulseAtTheirMeanByPower) {
  const auto found = echoes({.pulse_width_s = 4e-9}, {{10.05, 0.7F}, {10.0, 0.3F}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].range_m, 10.035, 1e-6);
  EXPECT_FLOAT_EQ(found[0].x, 1);
  EXPECT_EQ(found[0].strongest, 0);
  EXPECT_NEAR(found[0].spread_m, 0.05, 1e-6);
}

// §4.4: 0.127, 0.255, 0.509, 0.637 m for pulses of 1, 2, 4, 5 ns.
TEST(PulsedReceiver, TellsSurfacesApartFromTheResolutionOfItsPulseOn) {
  for (const auto& [width_ns, resolution] : {std::pair{1.0, 0.127}, {2.0, 0.255}, {4.0, 0.509}, {5.0, 0.637}}) {
    const Waveform waveform{.pulse_width_s = width_ns * 1e-9, .max_returns = 2};
    EXPECT_EQ(echoes(waveform, {{5, 1}, {5 + resolution - 0.002, 1}}).size(), 1U) << width_ns;
    EXPECT_EQ(echoes(waveform, {{5, 1}, {5 + resolution + 0.002, 1}}).size(), 2U) << width_ns;
  }
}

// By counting maxima of the sum itself, beside de Helguero's bound.
TEST(PulsedReceiver, TellsUnlikeEchoesApartWhereTheirSumHasTwoMaxima) {
  for (const double ratio : {1.0, 3.0, 10.0, 100.0})
    for (const double distance : {0.9, 1.1, 1.3, 1.5, 1.7, 1.9, 2.1, 2.3}) {
      const auto sum = [&](double t) {
        return std::exp(-t * t / 2) + ratio * std::exp(-(t - 2 * distance) * (t - 2 * distance) / 2);
      };
      int maxima = 0;
      constexpr double kStep = 1e-3;
      for (double t = -1; t < 2 * distance + 1; t += kStep)
        maxima += sum(t) > sum(t - kStep) && sum(t) >= sum(t + kStep) ? 1 : 0;
      EXPECT_EQ(standApart(distance, ratio), maxima == 2) << ratio << " " << distance;
      EXPECT_EQ(standApart(distance, ratio), standApart(distance, 1 / ratio));
    }
}

TEST(PulsedReceiver, MergesAWeakEchoOnTheFlankOfAStrongOne) {
  const Waveform waveform{.pulse_width_s = 2e-9, .max_returns = 2};
  EXPECT_EQ(echoes(waveform, {{5, 0.5F}, {5.35, 0.5F}}).size(), 2U);
  const auto merged = echoes(waveform, {{5, 0.9F}, {5.35, 0.1F}});
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_NEAR(merged[0].range_m, 5.035, 1e-6);
  EXPECT_NEAR(merged[0].deviation_m, 0.35 * std::sqrt(0.9 * 0.1), 1e-6);  // of two places with these weights
}

TEST(PulsedReceiver, ReportsTheStrongestOfTooManyInOrderOfRange) {
  const std::vector<Contribution> light = {{9, 0.2F}, {3, 0.1F}, {6, 0.5F}};
  const auto one = echoes({.pulse_width_s = 2e-9, .max_returns = 1}, light);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_DOUBLE_EQ(one[0].range_m, 6);
  const auto two = echoes({.pulse_width_s = 2e-9, .max_returns = 2}, light);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_DOUBLE_EQ(two[0].range_m, 6);
  EXPECT_DOUBLE_EQ(two[1].range_m, 9);
}

// V10, and §4.3: half and half over a step of 0.7 m with L = 1.2 m lies outside of it, 0.25 m in front.
TEST(PhaseReceiver, V10_AddsThePhasorsOfItsFineTone) {
  const auto near = echoes({.fine_wavelength_m = 1.2}, {{10.0, 0.5F}, {10.2, 0.5F}});
  ASSERT_EQ(near.size(), 1U);
  EXPECT_NEAR(near[0].range_m, 10.1, 1e-3);
  EXPECT_NEAR(near[0].x, std::cos(std::numbers::pi * 0.2 / 1.2), 1e-5);
  EXPECT_NEAR(echoes({.fine_wavelength_m = 1.2}, {{10.0, 0.5F}, {10.7, 0.5F}})[0].range_m, 9.75, 1e-3);
  for (const double fraction : {0.2, 0.4, 0.6, 0.9})
    for (const double step : {0.05, 0.2, 0.4}) {
      const double delta = 2 * std::numbers::pi * step / 1.2;
      const double expected = 1.2 / (2 * std::numbers::pi) *
                              std::atan2((1 - fraction) * std::sin(delta), fraction + (1 - fraction) * std::cos(delta));
      const auto found = echoes({.fine_wavelength_m = 1.2},
                                {{7.0, static_cast<float>(fraction)}, {7.0 + step, static_cast<float>(1 - fraction)}});
      EXPECT_NEAR(found[0].range_m - 7, expected, 1e-5) << fraction << " " << step;
    }
}

TEST(Receiver, OfNoLightHasNoEcho) {
  EXPECT_TRUE(echoes({.pulse_width_s = 2e-9}, {}).empty());
  EXPECT_TRUE(echoes({.fine_wavelength_m = 1.2}, {}).empty());
}

TEST(PortableSine, IsTheSine) {
  for (double angle = -20; angle < 20; angle += 0.0137) {
    double sine = 0, cosine = 0;
    portable::sinCos(angle, sine, cosine);
    EXPECT_NEAR(sine, std::sin(angle), 4e-15) << angle;
    EXPECT_NEAR(cosine, std::cos(angle), 4e-15) << angle;
  }
}

TEST(PortableTurn, IsTheArcTangent) {
  for (int k = -1800; k <= 1800; ++k) {
    const double angle = k * std::numbers::pi / 1800;
    if (std::abs(k) == 1800) continue;  // half a turn has two signs
    EXPECT_NEAR(portable::turnOf(3 * std::sin(angle), 3 * std::cos(angle)), angle / (2 * std::numbers::pi), 1e-12) << k;
  }
  EXPECT_NEAR(portable::turnOf(0.0, -2), 0.5, 1e-14);
  EXPECT_NEAR(portable::turnOf(-0.0, -2), -0.5, 1e-14);
}

}  // namespace
}  // namespace standpoint
