// SPDX-License-Identifier: GPL-3.0-or-later
// physics.md §3.1: σ² = floor + shot / x + amplifier / x², fitted to all figures of a sheet.
#include <cmath>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "scanners/radiometry/range_noise_law.h"
#include "scanners/radiometry/signal_lanes.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

double ofWhite(const Instrument& instrument, double range_m, double reflectivity) {
  return sigma_m(rangeNoiseParts(instrument), powerOf(instrument, {range_m, reflectivity, 0}));
}

// The root mean square of ln(σ of the fit / σ of the sheet).
double residual(const Instrument& instrument) {
  double sum = 0;
  for (const auto& f : instrument.range_noise) {
    const double log = std::log(ofWhite(instrument, f.range_m, f.reflectivity) / f.sigma_m);
    sum += log * log / static_cast<double>(instrument.range_noise.size());
  }
  return std::sqrt(sum);
}

// Whatever sent it back: of the S350, white at three times the range and 9 times the reflectivity.
TEST(RangeNoiseByPower, IsTheSameForEqualPower) {
  auto s350 = testing::instrument("faro-focus-s350");
  s350.near_range_m = 0;
  for (const double range : {10.0, 33.0, 80.0})
    EXPECT_NEAR(ofWhite(s350, 3 * range, 0.9) / ofWhite(s350, range, 0.1), 1, 1e-12) << range;
}

TEST(RangeNoiseByPower, OnlyEverFallsWithPowerAndRisesAsTheReceiverSays) {
  for (const auto& instrument : testing::everyInstrument()) {
    const auto parts = rangeNoiseParts(instrument);
    EXPECT_GT(parts.floor_m2, 0) << instrument.id;
    for (double x = 1e-7; x < 1; x *= 1.5)
      EXPECT_GE(sigma_m(parts, x), sigma_m(parts, 1.5 * x)) << instrument.id << ' ' << x;
    EXPECT_GT(sigma_m(parts, 1e-7), 3 * std::sqrt(parts.floor_m2)) << instrument.id;  // none is blind to power
    EXPECT_NEAR(sigma_m(parts, 1e9) / std::sqrt(parts.floor_m2), 1, 1e-9) << instrument.id;
  }
}

// Two powers give two parts: exactly. Where a sheet has one figure, that stays.
TEST(RangeNoiseByPower, MeetsTheFiguresOfSheetsOfOneOrTwoPowers) {
  for (const auto& instrument : testing::everyInstrument())
    if (instrument.range_noise.size() <= 2) {
      EXPECT_LT(residual(instrument), 1e-6) << instrument.id;
    }
}

// The sheet of the Z+F IMAGER 5010C as recalled (mm at 10, 25, 50, 100 m): twelve figures, which one law must meet.
TEST(RangeNoiseByPower, FitsTheTwelveFiguresOfAPhaseShiftInstrument) {
  auto imager = testing::instrument("zf-imager-5016");
  imager.range_noise.clear();
  for (const auto& [reflectivity, sigmas] :
       {std::pair{0.14, std::array{0.4, 0.6, 2.2, 10.0}}, {0.37, {0.3, 0.4, 0.8, 3.3}}, {0.80, {0.2, 0.3, 0.5, 1.6}}})
    for (const auto& [k, range] : {std::pair{0, 10.0}, {1, 25.0}, {2, 50.0}, {3, 100.0}})
      imager.range_noise.push_back({range, reflectivity, 1e-3 * sigmas[static_cast<std::size_t>(k)]});
  EXPECT_LT(residual(imager), 0.145);
  EXPECT_NEAR(ofWhite(imager, 50, 0.8) / 0.0005, 1, 0.06);
  EXPECT_NEAR(ofWhite(imager, 100, 0.8) / 0.0016, 1, 0.06);
  EXPECT_NEAR(ofWhite(imager, 50, 0.14) / 0.0022, 1, 0.03);
}

// The law that Ouster states for all ranges, 0.5 mm + 0.444 mm/m (OpenPLX 0.19), of which the file has two figures.
TEST(RangeNoiseByPower, OfTimeOfFlightGrowsWithTheRangeAsAPublishedLawDoes) {
  const auto ouster = testing::instrument("ouster-os1-128");
  for (const double range : {20.0, 80.0, 100.0, 150.0})
    EXPECT_NEAR(ofWhite(ouster, range, 0.5) / (0.0005 + 0.000444 * range), 1, 0.03) << range;
}

// One figure and the class: σ = σ0 √(1 + (x_knee / x)²), x_knee = 1 / knee². Its sister's sheet has 0.5 and 1.6 mm at
// 50 and 100 m (it was 4.29 and 17.2 mm while half of the variance at 10 m fell with power).
TEST(RangeNoiseByPower, OfAnImagerWithOneFigureRisesAsItsClassDoes) {
  const auto imager = testing::instrument("zf-imager-5016");
  ASSERT_EQ(imager.range_noise.size(), 1U);
  const auto expected = [&](double range) {
    const double x = powerOf(imager, {range, 0.8, 0}), knee = 1 / (46.0 * 46.0), x10 = powerOf(imager, {10, 0.8, 0});
    return 0.00025 * std::sqrt((1 + knee * knee / (x * x)) / (1 + knee * knee / (x10 * x10)));
  };
  for (const double range : {20.0, 50.0, 100.0})
    EXPECT_NEAR(ofWhite(imager, range, 0.8) / expected(range), 1, 1e-6) << range;
  EXPECT_NEAR(ofWhite(imager, 50, 0.8), 0.0005, 0.0001);
  EXPECT_NEAR(ofWhite(imager, 100, 0.8), 0.0016, 0.0002);
}

// Of a figure at so little power that it is beyond the knee no more than half of the variance falls.
TEST(RangeNoiseByPower, OfOneFigureInTheDarkKeepsHalfOfItsVariance) {
  const auto tx8 = testing::instrument("trimble-tx8");
  const auto parts = rangeNoiseParts(tx8);
  EXPECT_NEAR(parts.floor_m2, 2e-6, 1e-12);
  EXPECT_NEAR(ofWhite(tx8, 100, 0.18), 0.002, 1e-9);
}

TEST(RangeNoiseByPower, IsTheSameInTheLanesOfAScan) {
  for (const auto& instrument : testing::everyInstrument()) {
    SignalLanes lanes{};
    for (int k = 0; k < kSignalLanes; ++k) {
      lanes.range_m[k] = 2 * std::pow(1.3F, static_cast<float>(k));
      lanes.diffuse[k] = 0.05F + 0.05F * static_cast<float>(k), lanes.cosine[k] = 1;
      lanes.gain[k] = 1, lanes.variation[k] = 1, lanes.known_x[k] = -1;
    }
    receive(lanes, receiverOf(instrument, Effects(), 0));
    for (int k = 0; k < kSignalLanes; ++k)
      EXPECT_NEAR(
          static_cast<double>(lanes.sigma_m[k]) / sigma_m(rangeNoiseParts(instrument), static_cast<double>(lanes.x[k])),
          1, 1e-4)
          << instrument.id << ' ' << k;
  }
}

// docs/reference/instruments.md states the fit of each instrument: as it is.
TEST(RangeNoiseByPower, IsAsTheDocsStateIt) {
  std::ifstream stream(SOURCE_DIR "/docs/reference/instruments.md");
  std::stringstream text;
  text << stream.rdbuf();
  for (const auto& instrument : testing::everyInstrument()) {
    const auto parts = rangeNoiseParts(instrument);
    double worst = 0;
    for (const auto& f : instrument.range_noise) {
      const double off = ofWhite(instrument, f.range_m, f.reflectivity) / f.sigma_m - 1;
      if (std::abs(off) > std::abs(worst)) worst = off;
    }
    const auto row = fmt::format(
        "| `{}` | {} | {:.2f} | {:.2g} | {:.2g} | {:.0f} % | {:+.0f} % | {:.2f}, {:.2f}, {:.2f} |", instrument.id,
        instrument.range_noise.size() == 1 ? "1, class" : fmt::format("{}", instrument.range_noise.size()),
        1e3 * std::sqrt(parts.floor_m2), 1e3 * std::sqrt(parts.shot_m2), 1e3 * std::sqrt(parts.amplifier_m2),
        100 * residual(instrument) + 1e-6, 100 * worst + 1e-6, 1e3 * ofWhite(instrument, 10, 0.9),
        1e3 * ofWhite(instrument, 50, 0.9), 1e3 * ofWhite(instrument, 100, 0.9));
    EXPECT_NE(text.str().find(row), std::string::npos) << "missing row: " << row;
  }
}

}  // namespace
}  // namespace standpoint
