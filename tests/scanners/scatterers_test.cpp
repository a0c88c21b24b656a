// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/scatterers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "scanners/radiometry/radiometry.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

constexpr double kLeast = 1e-5, kFar_m = 20;
constexpr int kPulses = 40000;

Weather rain(double mm_h) { return {23, mm_h, 0, 0, 0}; }

double beam(const Instrument& instrument, double r) {
  return std::hypot(instrument.exit_diameter_m, instrument.divergence_rad * r);
}

double power(const Instrument& instrument, double alpha, double r, double diameter) {
  const double near = 1 / (1 + std::pow(instrument.near_range_m / r, instrument.near_range_power));
  return 0.02 * near * std::exp(-2 * alpha * r) * std::min(1.0, std::pow(diameter / beam(instrument, r), 2)) / (r * r);
}

// The moments that two ways of making drops are compared by.
struct Seen {
  double fraction = 0, range_m = 0, log_x = 0, log_x_deviation = 0;
};

Seen summary(const std::vector<Scatterer>& found) {
  Seen seen;
  const auto n = static_cast<double>(found.size());
  for (const auto& s : found) seen.range_m += s.range_m / n, seen.log_x += std::log(s.x) / n;
  for (const auto& s : found) seen.log_x_deviation += std::pow(std::log(s.x) - seen.log_x, 2) / n;
  seen.log_x_deviation = std::sqrt(seen.log_x_deviation);
  seen.fraction = n / kPulses;
  return seen;
}

Seen drawn(const Instrument& instrument, const Weather& weather, double far_m, double min_x) {
  const Scatterers air(instrument, weather, kLeast, 100, {7, 3});
  std::vector<Scatterer> found;
  for (std::uint32_t p = 0; p < kPulses; ++p)
    if (const auto s = air.strongest(p / 200, p % 200, far_m, min_x)) found.push_back(*s);
  return summary(found);
}

// As physics.md §2.6 says it: every drop above 0.05 mm in the beam, wherever and however small; the strongest counts.
Seen simulated(const Instrument& instrument, double mm_h, double far_m, double min_x) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0, 1);
  const double lambda = 4.1 * std::pow(mm_h, -0.21);
  const double alpha = extinction_per_m(rain(mm_h), instrument.wavelength_nm);
  const double widest = beam(instrument, far_m);
  const double cylinder = std::numbers::pi / 4 * widest * widest * (far_m - instrument.min_range_m);
  std::poisson_distribution<int> number(8000 / lambda * std::exp(-lambda * 0.05) * cylinder);
  std::exponential_distribution<double> larger(lambda);
  std::vector<Scatterer> found;
  for (int p = 0; p < kPulses; ++p) {
    Scatterer best;
    for (int k = number(generator); k > 0; --k) {
      const double r = instrument.min_range_m + unit(generator) * (far_m - instrument.min_range_m);
      const double diameter = 1e-3 * (0.05 + larger(generator));
      if (unit(generator) * widest * widest > std::pow(beam(instrument, r), 2)) continue;  // beside the beam
      const double x = power(instrument, alpha, r, diameter);
      if (x > best.x) best = {ScattererKind::drop, r, x};
    }
    if (best.x >= min_x) found.push_back(best);
  }
  return summary(found);
}

void expectAlike(const Seen& a, const Seen& b) {
  const double n = kPulses * b.fraction;
  EXPECT_NEAR(a.fraction, b.fraction, 5 * std::sqrt(2 * b.fraction / kPulses));
  EXPECT_NEAR(a.log_x, b.log_x, 5 * b.log_x_deviation * std::sqrt(2 / n));
  EXPECT_NEAR(a.log_x_deviation / b.log_x_deviation, 1, 5 / std::sqrt(n));
  EXPECT_NEAR(a.range_m / b.range_m, 1, 0.03);
}

TEST(Drops, AreThoseOfAnExhaustiveSimulation) {
  const auto instrument = testing::instrument("leica-rtc360");
  expectAlike(drawn(instrument, rain(25), kFar_m, kLeast), simulated(instrument, 25, kFar_m, kLeast));
  expectAlike(drawn(instrument, rain(100), 5, 4 * kLeast), simulated(instrument, 100, 5, 4 * kLeast));
}

// The share of pulses that see one is 1 - e^(-M); M from the formulas by another integration.
TEST(Drops, AreAsManyAsTheirDistributionSays) {
  const auto instrument = testing::instrument("trimble-x7");
  const double alpha = extinction_per_m(rain(50), instrument.wavelength_nm);
  const double lambda = 4.1 * std::pow(50, -0.21);
  double number = 0;
  for (double r = instrument.min_range_m + 5e-4; r < kFar_m; r += 1e-3) {
    const double fraction = kLeast / power(instrument, alpha, r, 1);  // of a drop as wide as the beam
    if (fraction > 1) continue;
    const double diameter_mm = std::max(1e3 * beam(instrument, r) * std::sqrt(fraction), 0.05);
    const double cross_section = std::numbers::pi / 4 * std::pow(beam(instrument, r), 2);
    number += 8000 / lambda * std::exp(-lambda * diameter_mm) * cross_section * 1e-3;
  }
  const Scatterers air(instrument, rain(50), kLeast, 100, {1, 1});
  EXPECT_NEAR(air.expected(kFar_m) / number, 1, 2e-3);
  const double fraction = 1 - std::exp(-number);
  EXPECT_NEAR(drawn(instrument, rain(50), kFar_m, kLeast).fraction, fraction, 5 * std::sqrt(fraction / kPulses));
}

TEST(Drops, LieBeforeTheTargetAndAboveTheThreshold) {
  const auto instrument = testing::instrument("leica-p50");
  const Scatterers air(instrument, {23, 100, 10, 0, 0}, 1e-7, 200, {5, 5});
  int found = 0, flakes = 0;
  for (std::uint32_t p = 0; p < 5000; ++p) {
    const double far = 0.2 + 0.01 * p;
    const auto s = air.strongest(0, p, far, 2e-7);
    if (!s) continue;
    ++found;
    flakes += s->kind == ScattererKind::flake ? 1 : 0;
    EXPECT_GE(s->range_m, instrument.min_range_m);
    EXPECT_LE(s->range_m, far);
    EXPECT_GE(s->x, 2e-7);
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(flakes, 100);
  EXPECT_LT(flakes, found - 100);
}

TEST(Drops, AreTheSameForTheSamePulseOnly) {
  const auto instrument = testing::instrument("leica-p50");
  const Scatterers air(instrument, rain(100), 1e-6, 50, {5, 5}), again(instrument, rain(100), 1e-6, 50, {5, 5}),
      other(instrument, rain(100), 1e-6, 50, {5, 6});
  int differ = 0;
  for (std::uint32_t row = 0; row < 2000; ++row) {
    const auto a = air.strongest(3, row, 50, 0), b = again.strongest(3, row, 50, 0), c = other.strongest(3, row, 50, 0);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_EQ(a->range_m, b->range_m);
    }
    differ += a.has_value() != c.has_value() || (a && a->range_m != c->range_m) ? 1 : 0;
  }
  EXPECT_GT(differ, 100);
}

TEST(Air, ThatIsClearSendsNothingBack) {
  const auto instrument = testing::instrument("leica-rtc360");
  const Scatterers air(instrument, {}, 1e-12, 100, {1, 1});
  for (std::uint32_t row = 0; row < 100; ++row) EXPECT_FALSE(air.strongest(0, row, 100, 0));
  const Scatterers wet(instrument, rain(50), 1e-9, 100, {1, 1});
  EXPECT_FALSE(wet.strongest(0, 0, instrument.min_range_m, 0));
  EXPECT_FALSE(wet.strongest(0, 0, 0, 0));
  EXPECT_FALSE(wet.strongest(0, 0, std::numeric_limits<double>::quiet_NaN(), 0));
}

// The pulse, a squared sine of the length c τ, over the backscatter of the fog (physics.md §2.6), as fine sums.
double meanOfGate(const Instrument& instrument, double mor_m, double middle_m) {
  const double length_m = 299792458.0 * instrument.waveform.pulse_width_s, alpha = std::log(20) / mor_m;
  constexpr int kSteps = 4000;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double turn = (k + 0.5) / kSteps, r = middle_m - turn * length_m;
    if (r <= 0.01) break;
    const double near = 1 / (1 + std::pow(instrument.near_range_m / r, instrument.near_range_power));
    sum += std::pow(std::sin(std::numbers::pi * turn), 2) * near * std::exp(-2 * alpha * r) / (r * r);
  }
  return std::numbers::pi * 0.046 / mor_m * sum * length_m / kSteps;
}

// Σ of a Poisson distribution from `least` on; what is exactly that counts half.
double poissonFrom(double mean, int least) {
  double below = 0, term = std::exp(-mean);
  for (int n = 0; n < least; ++n, term *= mean / n) below += term;
  return 1 - below - term / 2;
}

// Share of pulses in which one gate before the wall counts enough.
double expectedShare(const Instrument& instrument, double mor_m, double wall_m, double min_x) {
  const double gate_m = 299792458.0 * instrument.waveform.pulse_width_s / 2;
  double none = 1;
  for (double r = std::max(instrument.min_range_m, 0.1); r < wall_m - gate_m; r += gate_m) {
    const double photons = Scatterers::kPhotonsAtThreshold * meanOfGate(instrument, mor_m, r + gate_m / 2) / min_x;
    none *= 1 - poissonFrom(photons, static_cast<int>(Scatterers::kPhotonsAtThreshold));
  }
  return 1 - none;
}

Seen inFog(const Instrument& instrument, double mor_m, double min_x, double far_m = 20) {
  const Scatterers air(instrument, {kNoAir.visibility_km, 0, 0, mor_m, 0}, min_x, 130, {7, 3});
  std::vector<Scatterer> found;
  for (std::uint32_t p = 0; p < kPulses; ++p)
    if (const auto s = air.strongest(p / 200, p % 200, far_m, min_x)) found.push_back(*s);
  return summary(found);
}

// From all of the pulses to none there is a wide band of visibility, in which some see the fog and some the wall.
TEST(Fog, IsSeenByAsManyPulsesAsCountEnoughPhotonsOfIt) {
  for (const char* id : {"leica-rtc360", "trimble-x7"}) {
    const auto instrument = testing::instrument(id);
    const double least = detectionThreshold(*resolveSettings(instrument, {}), 0);
    double last = 1.01;
    int between = 0;
    for (double mor_m = 10; mor_m < 1000; mor_m *= 1.12) {
      const double share = inFog(instrument, mor_m, least).fraction;
      EXPECT_NEAR(share, expectedShare(instrument, mor_m, 20, least), 0.02) << id << " in " << mor_m << " m";
      EXPECT_LE(share, last + 0.01) << id << " in " << mor_m << " m";
      between += share > 0.02 && share < 0.98 ? 1 : 0;
      last = share;
    }
    EXPECT_GE(between, 4) << id << ": a factor of 1.5 of visibility";
    EXPECT_LT(last, 1e-3) << id;
  }
}

TEST(Fog, LiesInADepthAndNotOnAShell) {
  const auto instrument = testing::instrument("leica-rtc360");
  const double least = detectionThreshold(*resolveSettings(instrument, {}), 0);
  const Scatterers air(instrument, {kNoAir.visibility_km, 0, 0, 30, 0}, least, 130, {7, 3});
  constexpr double kBin_m = 0.02;
  std::vector<int> bins(1000);
  int found = 0;
  for (std::uint32_t p = 0; p < kPulses; ++p)
    if (const auto s = air.strongest(p / 200, p % 200, 20, least))
      ++bins[static_cast<std::size_t>(s->range_m / kBin_m)], ++found;
  ASSERT_GT(found, kPulses * 0.9);
  EXPECT_LT(*std::max_element(bins.begin(), bins.end()), 0.1 * found);
  EXPECT_GT(std::count_if(bins.begin(), bins.end(), [](int n) { return n > 0; }), 20);
}

TEST(Fog, IsCountedMoreSurelyInTheMeanOfMorePulses) {
  const auto instrument = testing::instrument("leica-rtc360");
  constexpr double kMean_x = 1e-4;
  const auto deviation = [&](int passes) {
    const Scatterers air(instrument, {kNoAir.visibility_km, 0, 0, 30, 0}, kMean_x, 130, {7, 3}, passes);
    std::vector<Scatterer> found;
    for (std::uint32_t p = 0; p < kPulses; ++p)
      if (const auto s = air.strongest(p / 200, p % 200, 0.75, 0)) found.push_back(*s);
    return summary(found).log_x_deviation;
  };
  EXPECT_NEAR(deviation(1) / deviation(4), 2, 0.1);
}

TEST(Fog, IsSeenFromWhereTheReceiverSeesItUnlessThatIsLeftOut) {
  const auto instrument = testing::instrument("leica-rtc360");
  const auto least = detectionThreshold(*resolveSettings(instrument, {}), 0);
  const auto x = [&](bool near_range) {
    const Scatterers air(instrument, {kNoAir.visibility_km, 0, 0, 30, 0}, least, 130, {7, 3}, 1, near_range);
    double sum = 0;
    for (std::uint32_t row = 0; row < 1000; ++row) sum += air.strongest(0, row, 20, 0)->x;
    return sum;
  };
  EXPECT_GT(x(false), 3 * x(true)) << "0.1 of the light from half a metre comes in";
}

TEST(Fog, AnswersAsDustOfTheSameVisibilityAndHidesAWall) {
  const auto instrument = testing::instrument("leica-rtc360");
  const double least = detectionThreshold(*resolveSettings(instrument, {}), 0);
  const Scatterers thick(instrument, {23, 0, 0, 30, 0}, least, 130, {1, 1});
  const Scatterers dust(instrument, {23, 0, 0, 0, 30}, least, 130, {1, 1});
  const auto soft = thick.strongest(0, 0, 20, least);
  ASSERT_TRUE(soft);
  EXPECT_EQ(soft->kind, ScattererKind::fog);
  EXPECT_LT(soft->range_m, 3);
  EXPECT_EQ(soft->x, dust.strongest(0, 0, 20, least)->x);
  const double wall = 0.5 / 400 / (1 + std::pow(1.5 / 20, 2)) * std::exp(-2 * 20 * std::log(20) / 30);
  EXPECT_LT(wall, soft->x);  // a wall at 20 m is lost in a fog of 30 m
}

}  // namespace
}  // namespace standpoint
