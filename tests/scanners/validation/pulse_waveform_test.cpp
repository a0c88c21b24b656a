// SPDX-License-Identifier: GPL-3.0-or-later
// The waveform of a pulse: P(r) = Σ x_k exp(-(r - r_k)² / 2s²), s = c τ / 2 / 2.355.
#include "scanners/engine/pulse_waveform.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

constexpr double kLight = 299792458.0;

Result<PulseWaveform> waveformOf(const SceneBuilder& scene, const Instrument& instrument, WaveformRequest request = {},
                                 Effects effects = Effects::none().with(Effect::footprint)) {
  ScanOptions options;
  options.effects = effects;
  return pulseWaveform(*scene.build(), allOf(*scene.environment(), 0.5), instrument,
                       window(instrument, -1, 1, -1, 1, 4, 4), {}, options, request);
}

double rangeOf(const PulseWaveform& waveform, std::size_t bin) {
  return waveform.first_m + static_cast<double>(bin) * waveform.bin_m;
}

TEST(PulseWaveform, OfAWallIsThePulseAtItsRangeAndPower) {
  SceneBuilder scene;
  scene.quad({10, 2, -2}, {0, -4, 0}, {0, 0, 4});
  const auto rtc = testing::instrument("leica-rtc360");
  const auto waveform = waveformOf(scene, rtc, {.bin_m = 0.002});
  ASSERT_TRUE(waveform) << describe(waveform.error());
  const double sigma = kLight * rtc.waveform.pulse_width_s / 2 / 2.354820045;
  for (std::size_t i = 0; i < waveform->power.size(); ++i) {
    const double off = (rangeOf(*waveform, i) - 10) / sigma;
    if (std::abs(off) < 4) {
      EXPECT_NEAR(waveform->power[i] / (0.5 / 100 * std::exp(-off * off / 2)), 1, 0.01) << rangeOf(*waveform, i);
    }
  }
  ASSERT_EQ(waveform->echoes.size(), 1U);
  EXPECT_NEAR(waveform->echoes[0].range_m, 10, 1e-4);
  // Its area is x √(2π) s.
  const double area = std::accumulate(waveform->power.begin(), waveform->power.end(), 0.0) * waveform->bin_m;
  EXPECT_NEAR(area / (0.005 * std::sqrt(2 * std::numbers::pi) * sigma), 1, 0.005);
}

// Half of the beam passes an edge: two maxima, of half of the powers of their walls.
TEST(PulseWaveform, OfAnEdgeHasTwoMaxima) {
  SceneBuilder scene;
  scene.quad({10, 2, -2}, {0, -2, 0}, {0, 0, 4});
  scene.quad({12, 2, -2}, {0, -4, 0}, {0, 0, 4});
  const auto waveform = waveformOf(scene, testing::instrument("leica-rtc360"));
  ASSERT_TRUE(waveform) << describe(waveform.error());
  const auto peak = [&](double low, double high) {
    std::size_t best = 0;
    for (std::size_t i = 0; i < waveform->power.size(); ++i)
      if (rangeOf(*waveform, i) > low && rangeOf(*waveform, i) < high && waveform->power[i] > waveform->power[best])
        best = i;
    return std::pair(rangeOf(*waveform, best), waveform->power[best]);
  };
  const auto near = peak(9, 11), far = peak(11, 13);
  EXPECT_NEAR(near.first, 10, waveform->bin_m);
  EXPECT_NEAR(far.first, 12, waveform->bin_m);
  EXPECT_NEAR(near.second / (0.5 / 100) + far.second / (0.5 / 144), 1, 0.02);  // the shares of the beam
  EXPECT_NEAR(near.second / (0.5 / 100), 0.5, 0.06);                           // 64 rays: σ ≤ 0.02
}

TEST(PulseWaveform, IsEmptyInTheOpenAndRefusesWhatHasNone) {
  SceneBuilder scene;
  scene.quad({10, 2, -2}, {0, -4, 0}, {0, 0, 4});
  const auto rtc = testing::instrument("leica-rtc360");
  const auto open = waveformOf(scene, rtc, {.azimuth_rad = 3});
  ASSERT_TRUE(open);
  EXPECT_TRUE(open->power.empty());
  EXPECT_TRUE(open->echoes.empty());
  const auto phase = waveformOf(scene, testing::instrument("faro-focus-s350"));
  ASSERT_FALSE(phase);
  EXPECT_NE(phase.error().message.find("time-of-flight"), std::string::npos);
  EXPECT_FALSE(waveformOf(scene, rtc, {.bin_m = 1e-9}));
}

}  // namespace
}  // namespace standpoint
