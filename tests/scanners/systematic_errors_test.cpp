// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/systematic_errors.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

// Over many scans: Δhz cos v at the horizon and Δv anywhere have the sheet's accuracy less the jitter, Δρ has that of
// the sheet at the horizon.
TEST(SystematicErrors, HaveTheSheetsAccuracyOverManyScans) {
  for (const char* id : {"leica-p40", "faro-focus-s350"}) {
    const auto instrument = testing::instrument(id);
    const double angle = std::sqrt(std::pow(instrument.angle_sigma_rad, 2) - std::pow(instrument.angle_jitter_rad, 2));
    constexpr int kScans = 4000;
    double lateral = 0, level = 0, steep = 0, range = 0;
    for (int seed = 0; seed < kScans; ++seed) {
      const auto errors = SystematicErrors::drawn(instrument, {static_cast<std::uint64_t>(seed), 5});
      lateral += std::pow(errors.faceLateral_rad(1, 0) + errors.azimuthError_rad(0.7), 2) / kScans;
      level += std::pow(errors.elevationError_rad(1, 0, 1), 2) / kScans;
      steep += std::pow(errors.elevationError_rad(-1, std::sin(1.1), std::cos(1.1)), 2) / kScans;
      const double off = errors.range_m(10, 0) - 10 * errors.scale;
      range += off * off / kScans;
    }
    EXPECT_NEAR(std::sqrt(lateral) / angle, 1, 0.04) << id;
    EXPECT_NEAR(std::sqrt(level) / angle, 1, 0.04) << id;
    EXPECT_NEAR(std::sqrt(steep) / angle, 1, 0.04) << id;
    EXPECT_NEAR(std::sqrt(range) / instrument.range_bias_m, 1, 0.04) << id;
  }
}

TEST(SystematicErrors, OfAPhaseShiftInstrumentRepeatWithItsFineTone) {
  const auto errors = SystematicErrors::drawn(testing::instrument("faro-focus-s350"), {3, 5});
  const double cycle = testing::instrument("faro-focus-s350").waveform.fine_wavelength_m;
  const auto off = [&](double range) { return errors.range_m(range, 0) - range * errors.scale - errors.offset_m; };
  EXPECT_NEAR(off(7.1), off(7.1 + 3 * cycle), 1e-8);
  EXPECT_NEAR(off(7.1), -off(7.1 + cycle / 2), 1e-8);
  EXPECT_NEAR(std::hypot(off(7.1), off(7.1 + cycle / 4)), std::hypot(errors.cyclic_sine_m, errors.cyclic_cosine_m),
              1e-8);
  EXPECT_EQ(SystematicErrors::drawn(testing::instrument("leica-p40"), {3, 5}).cycle_m, 0);
}

// The same wall in both faces: grids that start half a turn apart see it with the mirror in front and behind. Across
// the beam they differ by 2 (b1 + b2 sin v), upwards by 2 c0; what does not change sign cancels.
TEST(TwoFaces, DifferByTwiceWhatChangesSign) {
  auto instrument = testing::instrument("trimble-x7");
  instrument.angle_sigma_rad = 200 * kRadPerArcsec;  // to be seen in float coordinates
  SceneBuilder scene;
  scene.quad({10, -6, -6}, {0, 12, 0}, {0, 0, 16});
  const auto errors = SystematicErrors::drawn(instrument, {11, 0});
  ScanOptions options{11, Effects::none().with(Effect::bias)};
  const auto seen = [&](double azimuth_from_deg) {
    // 36 columns of 10°; only those that look at the wall return.
    const auto settings = window(instrument, azimuth_from_deg, azimuth_from_deg + 360, -10, 40, 36, 50);
    return scanned(*scene.build(), allOf(*scene.environment(), 0.5), instrument, settings, options).points;
  };
  const auto front = seen(0), behind = seen(-180);  // +X is column 0 of the one and column 18 of the other
  int compared = 0;
  for (std::size_t i = 0; i < front.size(); ++i)
    for (std::size_t k = 0; k < behind.size(); ++k) {
      if (front.column[i] != 0 || behind.column[k] != 18 || front.row[i] != behind.row[k]) continue;
      const double elevation = (-9.5 + front.row[i]) * kRadPerDeg;
      const auto lateral = [](double x, double y, double z) { return -y / std::sqrt(x * x + y * y + z * z); };
      const auto lift = [](double x, double y, double z) { return std::atan2(z, std::hypot(x, y)); };
      const double across =
          lateral(front.x_m[i], front.y_m[i], front.z_m[i]) - lateral(behind.x_m[k], behind.y_m[k], behind.z_m[k]);
      const double up =
          lift(front.x_m[i], front.y_m[i], front.z_m[i]) - lift(behind.x_m[k], behind.y_m[k], behind.z_m[k]);
      EXPECT_NEAR(across, 2 * (errors.collimation_rad + errors.trunnion_rad * std::sin(elevation)), 1e-6);
      EXPECT_NEAR(up, 2 * errors.index_rad, 1e-6);
      ++compared;
    }
  EXPECT_GT(compared, 40);
  EXPECT_GT(std::abs(errors.index_rad), 1e-5);
}

}  // namespace
}  // namespace standpoint
