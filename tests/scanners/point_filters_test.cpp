// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <gtest/gtest.h>

#include "core/units.h"
#include "scanners/radiometry/radiometry.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

using namespace testing;

constexpr Effects kLaw = Effects::none().with(Effect::detection);

struct Counted {
  std::size_t points = 0, filtered = 0, mixed = 0;
};

Counted counted(const SceneBuilder& scene, const MaterialAssignment& assignment, const Instrument& instrument,
                ScanSettings settings, const SettingValues& values, Effects effects) {
  settings.drops = resolveSettings(instrument, values)->drops;
  ScanOptions options{1, effects};
  options.channels.truth = true;
  const auto points = scanned(*scene.build(), assignment, instrument, settings, options).points;
  Counted counted{points.size(), 0, 0};
  for (const auto flags : points.truth.flags) {
    counted.filtered += (flags & point_flag::kFiltered) != 0 ? 1 : 0;
    counted.mixed += (flags & point_flag::kMixed) != 0 ? 1 : 0;
  }
  return counted;
}

// Two surfaces 0.2 m apart, half the light on each: σ = 0.1 m, five times what the filters bear.
TEST(MixedPointFilter, FlagsWhatItWouldTakeAndTakesItWhenItIsSwitchedOn) {
  for (const auto& [id, key] : {std::pair{"faro-focus-s350", "clear_contour"},
                                {"leica-p40", "mixed_pixels"},
                                {"riegl-vz-400i", "deviation"},
                                {"zf-imager-5016", "mixed_pixels"},
                                {"trimble-x7", "mixed_points"}}) {
    const auto instrument = testing::instrument(id);
    SceneBuilder scene;
    scene.quad({10, 0, -2}, {0, 2, 0}, {0, 0, 4});
    scene.quad({10.2, -2, -2}, {0, 4, 0}, {0, 0, 4});
    const auto assignment = allOf(*scene.environment(), 0.8);
    const auto settings = window(instrument, -0.1, 0.1, -0.02, 0.02, 81, 3);
    const Effects effects = kLaw.with(Effect::footprint).with(Effect::filters);
    const std::string on = std::string(id).starts_with("leica") ? "medium" : "on";
    const auto kept = counted(scene, assignment, instrument, settings, {{key, "off"}}, effects);
    const auto dropped = counted(scene, assignment, instrument, settings, {{key, on}}, effects);
    EXPECT_EQ(kept.points, 243U) << id;
    EXPECT_GT(kept.filtered, 10U) << id;
    EXPECT_LE(kept.filtered, kept.mixed) << id;
    EXPECT_EQ(dropped.points, kept.points - kept.filtered) << id;
    EXPECT_EQ(dropped.filtered, 0U) << id;
    EXPECT_EQ(counted(scene, assignment, instrument, settings, {{key, on}}, effects.without(Effect::filters)).points,
              243U)
        << id;
  }
}

// Clear Sky takes what has less than 1.5 times the least power: beyond R_max / √1.5 for the reference surface.
TEST(WeakPointFilter, TakesWhatIsNearTheThreshold) {
  auto instrument = testing::instrument("faro-focus-s350");
  instrument.near_range_m = 0;
  for (const double fraction : {0.8, 0.83}) {  // 1/√1.5 = 0.816
    const double distance = fraction * instrument.max_range_m;
    SceneBuilder scene;
    scene.quad({distance, -10, -10}, {0, 20, 0}, {0, 0, 20});
    const auto assignment = allOf(*scene.environment(), instrument.reference_reflectivity);
    const auto settings = window(instrument, -0.05, 0.05, -0.05, 0.05, 10, 10);
    const Effects effects = kLaw.with(Effect::filters);
    EXPECT_EQ(counted(scene, assignment, instrument, settings, {}, effects).filtered, fraction < 0.816 ? 0U : 100U);
    EXPECT_EQ(counted(scene, assignment, instrument, settings, {{"clear_sky", "on"}}, effects).points,
              fraction < 0.816 ? 100U : 0U);
  }
}

TEST(OverloadFilter, TakesWhatSaturates) {
  const auto instrument = testing::instrument("leica-p40");
  SceneBuilder scene;
  scene.quad({10, -2, -2}, {0, 4, 0}, {0, 0, 4});
  auto reflector = lambert(0.5);
  reflector.retro_gain = 500;  // x = 5 at 10 m
  const auto assignment = allOf(*scene.environment(), reflector);
  const auto settings = window(instrument, -0.5, 0.5, -0.5, 0.5, 10, 10);
  const Effects effects = kLaw.with(Effect::filters).with(Effect::saturation);
  EXPECT_EQ(counted(scene, assignment, instrument, settings, {}, effects).filtered, 100U);
  EXPECT_EQ(counted(scene, assignment, instrument, settings, {{"overloaded_pixels", "on"}}, effects).points, 0U);
}

TEST(RangeGate, KeepsWhatLiesBetweenItsEnds) {
  const auto instrument = testing::instrument("leica-p40");
  SceneBuilder scene;
  scene.quad({10, -2, -2}, {0, 2, 0}, {0, 0, 4});
  scene.quad({20, 0, -4}, {0, 4, 0}, {0, 0, 8});
  const auto assignment = allOf(*scene.environment(), 0.5);
  const auto points = [&](const SettingValues& values) {
    auto settings = window(instrument, -5, 5, -1, 1, 20, 4);
    const auto chosen = *resolveSettings(instrument, values);
    settings.nearest_m = chosen.nearest_m, settings.farthest_m = chosen.farthest_m;
    return scanned(*scene.build(), assignment, instrument, settings, {1, Effects::none()}).points;
  };
  EXPECT_EQ(points({}).size(), 80U);
  for (const float x : points({{"nearest_m", "15"}}).x_m) EXPECT_NEAR(x, 20, 0.01);
  for (const float x : points({{"farthest_m", "15"}}).x_m) EXPECT_NEAR(x, 10, 0.01);
  const auto crossed = resolveSettings(instrument, {{"nearest_m", "15"}, {"farthest_m", "10"}});
  ASSERT_FALSE(crossed);
  EXPECT_EQ(crossed.error().source, "farthest_m");
}

// 307 m at the fastest rate: what stands at 320 m comes out at 13 m.
TEST(RangeAmbiguity, FoldsWhatIsFartherThanThePhaseTells) {
  const auto instrument = testing::instrument("faro-focus-s350");
  SceneBuilder scene;
  scene.quad({320, -10, -10}, {0, 20, 0}, {0, 0, 20});
  const auto assignment = allOf(*scene.environment(), 0.9);
  const auto ranges = [&](const char* quality, Effects effects) {
    auto settings = window(instrument, -0.05, 0.05, -0.05, 0.05, 4, 4);
    settings.unambiguous_m = resolveSettings(instrument, {{"resolution", "1/4"}, {"quality", quality}})->unambiguous_m;
    ScanOptions options{1, effects};
    options.channels.truth = true;
    return scanned(*scene.build(), assignment, instrument, settings, options).points;
  };
  const Effects effects = kLaw.with(Effect::ambiguity);
  const auto folded = ranges("1x", effects);
  ASSERT_EQ(folded.size(), 16U);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_NEAR(folded.x_m[i], 13, 1e-3);
    EXPECT_NEAR(folded.truth.range_m[i], 320, 1e-2);
    EXPECT_EQ(folded.truth.flags[i], point_flag::kMirrored);
  }
  EXPECT_NEAR(ranges("2x", effects).x_m.at(0), 320, 1e-3);
  EXPECT_NEAR(ranges("1x", kLaw).x_m.at(0), 320, 1e-3);
}

// Only a retroreflector is bright enough beyond an interval that is longer than the sheet's range.
TEST(RangeAmbiguity, NeedsLightFromBeyondTheSheetsRange) {
  const auto instrument = testing::instrument("faro-focus-s70");  // 70 m, 614 m
  SceneBuilder scene;
  scene.quad({640, -10, -10}, {0, 20, 0}, {0, 0, 20});
  const auto settings = window(instrument, -0.05, 0.05, -0.05, 0.05, 4, 4);
  const Effects effects = kLaw.with(Effect::ambiguity);
  EXPECT_EQ(scanned(*scene.build(), allOf(*scene.environment(), 0.9), instrument, settings, {1, effects}).points.size(),
            0U);
  auto reflector = lambert(0.5);
  reflector.retro_gain = 1000;
  const auto points =
      scanned(*scene.build(), allOf(*scene.environment(), reflector), instrument, settings, {1, effects}).points;
  ASSERT_EQ(points.size(), 16U);
  EXPECT_NEAR(points.x_m[0], 640 - 614, 1e-3);
}

}  // namespace
}  // namespace standpoint
