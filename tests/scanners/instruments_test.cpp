// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <iterator>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.h"
#include "tests/scanners/scenes.h"
#include "tests/temporary_folder.h"

namespace standpoint {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

ScanSettings resolved(const std::string& id, const SettingValues& values) {
  auto settings = resolveSettings(testing::instrument(id), values);
  if (!settings) throw std::runtime_error(describe(settings.error()));
  return *settings;
}

Error refused(const std::string& id, const SettingValues& values) {
  auto settings = resolveSettings(testing::instrument(id), values);
  if (settings) throw std::runtime_error("was not refused");
  return settings.error();
}

TEST(Rtc360, HasTheGridsAndTimesOfItsMenu) {
  for (const auto& [resolution, columns, rows, seconds] :
       {std::tuple{"12mm", 5084U, 2083U, 26.0}, std::tuple{"6mm", 10167U, 4166U, 51.0},
        std::tuple{"3mm", 20334U, 8333U, 102.0}})
    for (const bool twice : {false, true}) {
      const auto settings =
          resolved("leica-rtc360", {{"resolution", resolution}, {"double_scan", twice ? "on" : "off"}});
      EXPECT_EQ(settings.columns, columns);
      EXPECT_EQ(settings.rows, rows);
      EXPECT_DOUBLE_EQ(settings.scan_seconds, twice ? 2 * seconds : seconds);
      EXPECT_DOUBLE_EQ(settings.imaging_seconds, 60);
      EXPECT_EQ(settings.passes, twice ? 2 : 1);
    }
}

TEST(Rtc360, ScansATargetAreaOnlyWhenThatFieldOfViewIsChosen) {
  const auto area = resolved("leica-rtc360", {{"field_of_view", "target_area"},
                                              {"horizontal_from", "350"},
                                              {"horizontal_to", "10"},
                                              {"vertical_from", "-15"},
                                              {"vertical_to", "15"},
                                              {"resolution", "6mm"}});
  EXPECT_EQ(area.columns, 565U);  // 10167 · 20/360
  EXPECT_EQ(area.rows, 833U);     // 4166 · 30/150
  EXPECT_NEAR(area.scan_seconds, 51.0 / 18, 1e-9);
  EXPECT_THAT(refused("leica-rtc360", {{"horizontal_to", "90"}}).message, HasSubstr("field of view"));
}

// instrument-facts.md §1.4: seconds by resolution and quality, 0 = greyed out, because the mirror would exceed 97 Hz.
TEST(FocusS350, ReproducesTheTableOfItsDisplayWithinASecond) {
  struct Row {
    const char* resolution;
    std::uint32_t columns, rows;
    int seconds[4];
  };
  const Row table[] = {{"1/1", 40960, 17067, {923, 1788, 3519, 6981}},
                       {"1/2", 20480, 8533, {274, 490, 923, 1788}},
                       {"1/4", 10240, 4267, {112, 166, 274, 490}},
                       {"1/5", 8192, 3413, {0, 127, 196, 335}},
                       {"1/8", 5120, 2133, {0, 85, 112, 166}},
                       {"1/10", 4096, 1707, {0, 0, 92, 127}},
                       {"1/16", 2560, 1067, {0, 0, 71, 85}},
                       {"1/20", 2048, 853, {0, 0, 0, 75}},
                       {"1/32", 1280, 533, {0, 0, 0, 64}}};
  for (const auto& row : table)
    for (int q = 0; q < 4; ++q) {
      const SettingValues values = {{"resolution", row.resolution}, {"quality", std::to_string(q + 1) + "x"}};
      if (row.seconds[q] == 0) {
        const Error error = refused("faro-focus-s350", values);
        EXPECT_EQ(error.kind, ErrorKind::usage);
        EXPECT_THAT(error.message, HasSubstr("4x"));
        continue;
      }
      const auto settings = resolved("faro-focus-s350", values);
      EXPECT_EQ(settings.columns, row.columns);
      EXPECT_EQ(settings.rows, row.rows);
      EXPECT_NEAR(settings.scan_seconds, row.seconds[q], 1) << row.resolution << " " << q + 1 << "x";
    }
}

// Instrument facts, section 2.1: noise compression of 2 and 4, from 1/2 and from 1/4 down.
TEST(FocusS350, CompressesNoiseOnlyWhereAFinerGridIsLeft) {
  const auto with = [](const char* resolution, const char* quality) {
    return SettingValues{{"resolution", resolution}, {"quality", quality}};
  };
  EXPECT_THAT(refused("faro-focus-s350", with("1/1", "6x")).message, EndsWith("allowed here: 1x, 2x, 3x, 4x"));
  EXPECT_THAT(refused("faro-focus-s350", with("1/2", "8x")).message, EndsWith("1x, 2x, 3x, 4x, 6x"));
  EXPECT_THAT(refused("faro-focus-s350", with("1/20", "3x")).message, EndsWith("4x, 6x, 8x"));
  const auto four = resolved("faro-focus-s350", with("1/4", "4x"));
  const auto eight = resolved("faro-focus-s350", with("1/4", "8x"));
  EXPECT_EQ(eight.columns, four.columns);
  EXPECT_DOUBLE_EQ(four.noise_factor / eight.noise_factor, 4);
  EXPECT_GT(eight.scan_seconds, four.scan_seconds);
}

TEST(Modes, RefuseWhatBelongsToAnother) {
  const auto with = [](const char* mode, const char* duration) {
    return SettingValues{{"mode", mode}, {"duration", duration}};
  };
  EXPECT_THAT(refused("trimble-x7", with("high_sensitivity", "2min")).message,
              EndsWith("4min_high, 7min_high, 15min_high"));
  EXPECT_THAT(refused("trimble-x7", with("standard", "4min_high")).message, EndsWith("2min, 4min, 7min, 15min"));
  const auto high = resolved("trimble-x7", with("high_sensitivity", "4min_high"));
  const auto default_value = resolved("trimble-x7", with("standard", "2min"));
  EXPECT_EQ(high.columns, default_value.columns);
  EXPECT_DOUBLE_EQ(high.scan_seconds / default_value.scan_seconds, 2);
}

TEST(FocusS350, FallsInNoiseByTheRootOfTwoWithEachQuality) {
  for (int q = 1; q < 4; ++q) {
    const auto low = resolved("faro-focus-s350", {{"quality", std::to_string(q) + "x"}});
    const auto high = resolved("faro-focus-s350", {{"quality", std::to_string(q + 1) + "x"}});
    EXPECT_NEAR(low.noise_factor / high.noise_factor, std::sqrt(2.0), 1e-12);
  }
}

TEST(TrimbleX7, HasTheDurationsAndPointsOfItsModes) {
  for (const auto& [duration, seconds, million] : {std::tuple{"2min", 120.0, 12.8}, std::tuple{"4min", 240.0, 19.1},
                                                   std::tuple{"7min", 420.0, 43.0}, std::tuple{"15min", 900.0, 96.6}}) {
    const auto settings = resolved("trimble-x7", {{"mode", "standard"}, {"duration", duration}, {"images", "quality"}});
    EXPECT_NEAR(1e-6 * settings.columns * settings.rows, million, 0.06);
    EXPECT_DOUBLE_EQ(settings.scan_seconds, seconds);
    EXPECT_DOUBLE_EQ(settings.imaging_seconds, 120);
  }
}

// Time, and points in millions: those of the BLK360 and the VZ-400i as printed, the others from spacing and field.
TEST(OtherInstruments, HaveTheGridsAndTimesOfTheirSheets) {
  struct Row {
    const char *id, *key, *value;
    double million, seconds;
  };
  const Row table[] = {
      {"leica-blk360-g1", "resolution", "low", 4.1, 14},      {"leica-blk360-g1", "resolution", "high", 65.8, 219},
      {"leica-p40", "resolution", "6.3mm", 40.1, 109},        {"leica-p40", "resolution", "0.8mm", 2485, 3247},
      {"trimble-tx8", "level", "level1", 30.6, 120},          {"trimble-tx8", "level", "level3", 481.5, 600},
      {"riegl-vz-400i", "pattern", "panorama_50", 14.4, 120}, {"riegl-vz-400i", "pattern", "panorama_30", 40, 300}};
  for (const auto& row : table) {
    const auto settings = resolved(row.id, {{row.key, row.value}});
    EXPECT_NEAR(1e-6 * settings.columns * settings.rows, row.million, 0.01 * row.million) << row.id << " " << row.value;
    EXPECT_NEAR(settings.scan_seconds, row.seconds, 1e-9) << row.id << " " << row.value;
  }
}

TEST(Vz400i, TakesAPatternOfSixNumbers) {
  const auto custom = resolved("riegl-vz-400i", {{"pattern", "custom"},
                                                 {"line_step", "0.05"},
                                                 {"frame_step", "0.02"},
                                                 {"horizontal_from", "90"},
                                                 {"horizontal_to", "180"},
                                                 {"vertical_from", "-20"},
                                                 {"vertical_to", "30"}});
  EXPECT_EQ(custom.columns, 4500U);           // 90 / 0.02
  EXPECT_EQ(custom.rows, 1000U);              // 50 / 0.05
  EXPECT_DOUBLE_EQ(custom.scan_seconds, 75);  // 18000 · 2000 / 120000, a quarter of the turn
  EXPECT_THAT(refused("riegl-vz-400i", {{"line_step", "0.1"}}).message, HasSubstr("require the custom pattern"));
}

TEST(Vz400i, TakesItsTimeWhenTheLaserIsSlow) {
  EXPECT_DOUBLE_EQ(resolved("riegl-vz-400i", {{"pattern", "panorama_50"}, {"programme", "300khz"}}).scan_seconds,
                   120);  // 14.4 M / 125000 is less
  EXPECT_NEAR(resolved("riegl-vz-400i", {{"pattern", "panorama_50"}, {"programme", "100khz"}}).scan_seconds,
              14.4e6 / 42000, 1e-9);
}

TEST(Vz400i, PhotographsDuringTheScanOrLongerWithMoreOverlap) {
  EXPECT_DOUBLE_EQ(resolved("riegl-vz-400i", {{"images", "on"}, {"image_overlap", "50"}}).imaging_seconds, 90);
  const auto during = resolved("riegl-vz-400i", {{"images", "on"}, {"image_mode", "during_scan"}});
  EXPECT_TRUE(during.imaging);
  EXPECT_EQ(during.imaging_seconds, 0);
}

TEST(TrimbleX7, ScansAnAreaAndPhotographsTwiceAsLongInHdr) {
  const auto area = resolved("trimble-x7", {{"field_of_view", "area"},
                                            {"horizontal_from", "350"},
                                            {"horizontal_to", "10"},
                                            {"images", "quality"},
                                            {"hdr", "on"}});
  EXPECT_EQ(area.columns, 317U);  // 5712 · 20 / 360
  EXPECT_NEAR(area.scan_seconds, 120.0 / 18, 1e-9);
  EXPECT_DOUBLE_EQ(area.imaging_seconds, 240);
  EXPECT_THAT(refused("trimble-x7", {{"horizontal_to", "90"}}).message, HasSubstr("field of view"));
}

TEST(RangeModes, ReachAsFarAsTheChosenOneSays) {
  const auto near = resolved("leica-p50", {{"range", "120m"}});
  const auto far = resolved("leica-p50", {{"range", "1000m"}});
  EXPECT_EQ(near.max_range_m, 120);
  EXPECT_EQ(near.reference_reflectivity, 0.08);
  EXPECT_EQ(far.max_range_m, 1000);
  EXPECT_EQ(resolved("leica-rtc360", {}).max_range_m, testing::instrument("leica-rtc360").max_range_m);
}

TEST(Pictures, HaveTheCameraAndTheTimeThatTheSettingsChoose) {
  const auto plain = resolved("leica-p40", {});
  EXPECT_EQ(plain.camera.columns, 8192U);
  EXPECT_TRUE(plain.camera.metered);
  EXPECT_DOUBLE_EQ(plain.imaging_seconds, 440);
  const auto chosen = resolved(
      "leica-p40", {{"image_resolution", "640"}, {"hdr", "on"}, {"exposure", "manual-2"}, {"white_balance", "cold"}});
  EXPECT_EQ(chosen.camera.columns, 2730U);
  EXPECT_TRUE(chosen.camera.hdr);
  EXPECT_FALSE(chosen.camera.metered);
  EXPECT_DOUBLE_EQ(chosen.camera.stops, -2);
  EXPECT_DOUBLE_EQ(chosen.camera.warmth, 0.8);
  EXPECT_NEAR(chosen.imaging_seconds, 440 * 0.65 * 2, 1e-9);
  const auto only = resolved("leica-p40", {{"images", "only"}});
  EXPECT_FALSE(only.laser);
  EXPECT_EQ(only.scan_seconds, 0);
}

TEST(Pictures, OfHdrAreTakenWithoutFlash) {
  EXPECT_EQ(resolved("leica-blk360-g1", {{"images", "ldr"}, {"flash", "on"}}).camera.flash, 1);
  EXPECT_EQ(resolved("leica-blk360-g1", {{"images", "hdr"}, {"flash", "on"}}).camera.flash, 0);
}

// Twice the time of the turn, not of spin-up: 8 s + 2 x 101 s.
TEST(Sensitivity, OfHighTakesTwiceTheTimeForLessNoise) {
  const auto high = resolved("leica-p40", {{"sensitivity", "high"}});
  EXPECT_DOUBLE_EQ(high.scan_seconds, 210);
  EXPECT_NEAR(high.noise_factor * high.noise_factor, 0.5, 1e-6);
}

TEST(Settings, AreRefusedWithWhatIsAllowed) {
  EXPECT_THAT(refused("leica-rtc360", {{"resolution", "1mm"}}).message, HasSubstr("12mm, 6mm, 3mm"));
  EXPECT_THAT(refused("leica-rtc360", {{"quality", "3x"}}).message, HasSubstr("resolution, scan, double_scan"));
  EXPECT_THAT(refused("leica-rtc360", {{"images", "on"}, {"images", "off"}}).message, HasSubstr("twice"));
  EXPECT_THAT(refused("faro-focus-s350", {{"vertical_from", "-75"}}).message, HasSubstr("from -60 to 90"));
  EXPECT_THAT(refused("faro-focus-s350", {{"vertical_from", "nan"}}).message, HasSubstr("not allowed"));
  EXPECT_EQ(refused("faro-focus-s350", {{"vertical_from", "30"}, {"vertical_to", "10"}}).source, "vertical_to");
}

TEST(Settings, AreCompletedInTheOrderOfTheInstrument) {
  const auto settings = resolved("leica-rtc360", {{"double_scan", "on"}, {"resolution", "3mm"}});
  EXPECT_EQ(settings.values.front(), (std::pair<std::string, std::string>{"resolution", "3mm"}));
  EXPECT_EQ(settings.values.size(), testing::instrument("leica-rtc360").settings.size());
}

TEST(Instruments, EachHaveASourceForEveryFigure) {
  const auto all = testing::everyInstrument();
  ASSERT_EQ(all.size(), 27U);
  for (const auto& instrument : all) {
    EXPECT_GT(instrument.evidence.size(), 25U) << instrument.id;
    for (const auto& [pointer, evidence] : instrument.evidence) {
      EXPECT_FALSE(evidence.mark.empty()) << instrument.id << " " << pointer;
      EXPECT_FALSE(evidence.source.empty()) << instrument.id << " " << pointer;
    }
  }
  EXPECT_EQ(testing::instrument("leica-rtc360").evidence.at("/range/min_m").mark, "S59");
  EXPECT_EQ(testing::instrument("leica-rtc360").evidence.at("/beam/wavelength_nm").mark, "unsourced");
}

TEST(Instruments, SpreadTheirNoiseWithoutAddingToTheSheet) {
  for (const auto& instrument : testing::instruments()) {
    const auto& noise = instrument.correlated;
    EXPECT_LE(noise.column_fraction + noise.along_fraction, 1) << instrument.id;
    EXPECT_GT(noise.column_fraction + noise.column_extra_m, 0) << instrument.id << " has no stripes";
    for (const auto& figure : instrument.range_noise)
      EXPECT_LT(noise.wobble_m * noise.wobble_m / 2, 0.02 * figure.sigma_m * figure.sigma_m) << instrument.id;
  }
}

TEST(Instruments, TellTwoSurfacesApartByPulseOrByTone) {
  for (const auto& instrument : testing::instruments()) {
    EXPECT_EQ(instrument.waveform.pulse_width_s > 0, instrument.technology == "time_of_flight") << instrument.id;
    EXPECT_EQ(instrument.waveform.fine_wavelength_m > 0, instrument.technology == "phase_shift") << instrument.id;
    EXPECT_EQ(instrument.waveform.max_returns, instrument.id == "riegl-vz-400i" ? 15 : 1);
  }
}

TEST(MovingInstruments, HaveTheFiguresOfTheirSheets) {
  const auto moving = [](const char* id) { return testing::instrument(id).moving.value(); };
  const auto vlp = moving("velodyne-vlp-16");
  EXPECT_EQ(vlp.channel_elevations_rad.size(), 16U);
  EXPECT_NEAR(vlp.channel_elevations_rad[1], 1 * kRadPerDeg, 1e-12);  // the second that fires
  EXPECT_EQ(vlp.points_per_s, 300000);
  EXPECT_EQ(vlp.min_rotation_hz, 5);
  EXPECT_EQ(vlp.max_rotation_hz, 20);
  EXPECT_EQ(testing::instrument("velodyne-vlp-16").waveform.max_returns, 2);
  EXPECT_NEAR(testing::instrument("velodyne-vlp-16").min_elevation_rad, -15 * kRadPerDeg, 1e-12);
  EXPECT_EQ(moving("ouster-os1-128").channel_elevations_rad.size(), 128U);
  EXPECT_EQ(moving("hesai-xt32").channel_elevations_rad.size(), 32U);
  EXPECT_EQ(moving("navvis-vlx2").heads, 2);
  EXPECT_EQ(moving("navvis-vlx3").points_per_s, 1280000);
  EXPECT_EQ(moving("riegl-vux-1uav").mount, "aircraft");
  EXPECT_NEAR(moving("riegl-vux-1uav").turn_rad, 330 * kRadPerDeg, 1e-12);
  EXPECT_EQ(testing::instrument("leica-blk2go").max_range_m, 25);
  EXPECT_EQ(testing::instrument("geoslam-zeb-horizon").evidence.at("/moving/points_per_s").mark, "S42");
  EXPECT_EQ(testing::instrument("faro-orbis").evidence.at("/moving/mount").mark, "unsourced");
  EXPECT_NEAR(moving("leica-blk2go").most_turn_radps, 69 * kRadPerDeg, 1e-12);
  EXPECT_EQ(moving("navvis-vlx3").most_speed_mps, 1.2);
  EXPECT_EQ(vlp.most_speed_mps, 0) << "nobody carries it";
  EXPECT_EQ(moving("range-meter").max_rotation_hz, 0) << "1D";
  EXPECT_EQ(moving("profile-scanner").second_rotation_hz, 0) << "2D";
}

TEST(MovingInstruments, ThatAreAskedToScanFromAStationSayWhatTheyNeed) {
  int refused_ones = 0;
  for (const auto& instrument : testing::everyInstrument()) {
    if (!instrument.moving) continue;
    ++refused_ones;
    const auto settings = resolveSettings(instrument, {});
    ASSERT_FALSE(settings) << instrument.id;
    EXPECT_EQ(settings.error().kind, ErrorKind::usage);
    EXPECT_THAT(settings.error().message, HasSubstr("requires a trajectory"));
    EXPECT_EQ(settings.error().source, instrument.id);
  }
  EXPECT_EQ(refused_ones, 11);
}

// physics.md §0, finding 3; the accuracy of its sheet is 4 mm at 10 m and 7 mm at 20 m.
TEST(Blk360, HasTheNoiseThatWasSimulatedAndTheStripesThatWereMissing) {
  const auto instrument = testing::instrument("leica-blk360-g1");
  const auto& noise = instrument.correlated;
  EXPECT_EQ(noise.column_fraction, 0);
  EXPECT_NEAR(std::hypot(instrument.range_noise[0].sigma_m, noise.column_extra_m), 0.00229, 5e-6);
  const double accuracy_mm[] = {4, 7};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& figure = instrument.range_noise[i];
    const double bias = std::hypot(instrument.range_bias_m, 1e-6 * instrument.range_bias_ppm * figure.range_m);
    EXPECT_NEAR(1e3 * std::hypot(bias, figure.sigma_m, noise.column_extra_m), accuracy_mm[i], 0.05);
  }
}

// Reads the RTC360 with one piece of its text exchanged.
class ChangedInstrument : public ::testing::Test {
 protected:
  Error errorOf(const std::string& from, const std::string& to, const std::string& id = "leica-rtc360") {
    std::ifstream stream(SOURCE_DIR "/scanners/instruments/" + id + ".json");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    text.replace(place, from.size(), to);
    const TemporaryFolder folder;
    folder.write(id + ".json", text);
    const auto read = readInstruments(folder.path());
    return read ? Error{ErrorKind::internal, "accepted", ""} : read.error();
  }
};

TEST_F(ChangedInstrument, WithAnUnknownKeyIsRefusedWithItsPlace) {
  EXPECT_EQ(errorOf("\"min_m\"", "\"colour\": 1, \"min_m\"").source, "leica-rtc360.json /range/colour");
  EXPECT_EQ(errorOf("\"scan_seconds\": 26", "\"scan_second\": 26").source,
            "leica-rtc360.json /settings/0/choices/0/scan_second");
}

TEST_F(ChangedInstrument, WithAMissingFigureOrSourceIsRefusedWithItsPlace) {
  EXPECT_EQ(errorOf("\"divergence_mrad\": 0.5,", "").source, "leica-rtc360.json /beam/divergence_mrad");
  EXPECT_EQ(errorOf("{ \"value\": 0.5, \"source\": \"S59\" }", "{ \"value\": 0.5 }").source,
            "leica-rtc360.json /range/min_m");
  EXPECT_EQ(errorOf("{ \"value\": 0.5, \"source\": \"S59\" }", "0.5").source, "leica-rtc360.json /range/min_m");
  EXPECT_THAT(errorOf("{ \"value\": 0.5, \"source\": \"S59\" }", "{ \"value\": 0.5, \"source\": \"S99\" }").message,
              HasSubstr("S99"));
}

TEST_F(ChangedInstrument, WithAValueOutOfRangeIsRefusedWithItsPlace) {
  EXPECT_EQ(errorOf("\"wavelength_nm\": 1550", "\"wavelength_nm\": 15500").source,
            "leica-rtc360.json /beam/wavelength_nm");
  EXPECT_EQ(errorOf("\"wavelength_nm\": 1550", "\"wavelength_nm\": \"1550\"").source,
            "leica-rtc360.json /beam/wavelength_nm");
  EXPECT_EQ(errorOf("\"columns\": 5084", "\"columns\": 5e9").source, "leica-rtc360.json /settings/0/choices/0/columns");
  EXPECT_EQ(errorOf("\"standard\": \"6mm\"", "\"standard\": \"7mm\"").source, "leica-rtc360.json /settings/0/standard");
  EXPECT_EQ(errorOf("\"id\": \"leica-rtc360\"", "\"id\": \"leica\"").source, "leica-rtc360.json /id");
}

TEST_F(ChangedInstrument, WithAKneeForFiguresThatSayItThemselvesIsRefused) {
  const auto error =
      errorOf("\"range_noise\"", "\"noise_knee_m\": { \"value\": 23, \"source\": \"unsourced\" }, \"range_noise\"");
  EXPECT_EQ(error.source, "leica-rtc360.json /noise_knee_m");
  EXPECT_THAT(error.message, HasSubstr("single figure"));
  EXPECT_EQ(errorOf("\"noise_knee_m\": { \"value\": 23", "\"noise_knee_m\": { \"value\": -1", "trimble-x7").source,
            "trimble-x7.json /noise_knee_m/value");
}

TEST_F(ChangedInstrument, WhoseCompensatorCannotBeIsRefusedWithItsPlace) {
  EXPECT_EQ(errorOf("\"value\": \"imu\"", "\"value\": \"spirit\"").source, "leica-rtc360.json /compensator/kind/value");
  EXPECT_EQ(errorOf("\"range_deg\": { \"value\": 5", "\"range_deg\": { \"value\": 95").source,
            "leica-rtc360.json /compensator/range_deg/value");
  EXPECT_EQ(errorOf("\"accuracy_arcsec\": { \"value\": 180", "\"accuracy\": { \"value\": 180").source,
            "leica-rtc360.json /compensator/accuracy_arcsec");
}

TEST_F(ChangedInstrument, WhosePartsAreMoreThanTheWholeIsRefusedWithItsPlace) {
  EXPECT_EQ(errorOf("\"along_share\": 0.3", "\"along_share\": 0.95").source,
            "leica-rtc360.json /correlated_noise/along_share");
  EXPECT_EQ(errorOf("\"azimuth_flicker_arcsec\": { \"value\": 3", "\"azimuth_flicker_arcsec\": { \"value\": 18").source,
            "leica-rtc360.json /correlated_noise/azimuth_flicker_arcsec");
  EXPECT_EQ(
      errorOf("\"elevation_wobble_arcsec\": { \"value\": 3", "\"elevation_wobble_arcsec\": { \"value\": 26").source,
      "leica-rtc360.json /correlated_noise/elevation_wobble_arcsec");
}

TEST_F(ChangedInstrument, WithNoiseThatCannotBeIsRefusedWithItsPlace) {
  EXPECT_EQ(errorOf("\"hurst\": 0.75", "\"hurst\": 1").source, "leica-rtc360.json /correlated_noise/hurst");
  EXPECT_EQ(errorOf("\"column_correlation\": 0.5", "\"column_correlation\": 1").source,
            "leica-rtc360.json /correlated_noise/column_correlation");
  EXPECT_EQ(errorOf("\"column_share\": 0.1", "\"column_share\": -0.1").source,
            "leica-rtc360.json /correlated_noise/column_share");
  EXPECT_EQ(errorOf("\"pedestal\": 0.0003", "\"pedestal\": 0.5").source, "leica-rtc360.json /saturation/pedestal");
  EXPECT_THAT(errorOf("\"wobble_order\": 2", "\"wobble_order\": 2.5").message, HasSubstr("whole number"));
  EXPECT_EQ(errorOf("\"most_returns\": { \"value\": 1", "\"most_returns\": { \"value\": 0").source,
            "leica-rtc360.json /waveform/most_returns/value");
}

TEST_F(ChangedInstrument, WithTheFigureOfTheOtherTechnologyIsRefusedWithItsPlace) {
  EXPECT_EQ(
      errorOf("\"technology\": { \"value\": \"time_of_flight\"", "\"technology\": { \"value\": \"phase_shift\"").source,
      "leica-rtc360.json /waveform/fine_wavelength_m");
  EXPECT_EQ(errorOf("\"most_returns\":", "\"fine_wavelength_m\": 1.2, \"most_returns\":").source,
            "leica-rtc360.json /waveform/fine_wavelength_m");
}

TEST_F(ChangedInstrument, ThatMovesIsRefusedWithItsPlaceWhenItCannotBe) {
  const auto vlp = [this](const char* from, const char* to) { return errorOf(from, to, "velodyne-vlp-16").source; };
  EXPECT_EQ(vlp("[-15, 1,", "[-95, 1,"), "velodyne-vlp-16.json /moving/channel_elevations_deg/value/0");
  EXPECT_EQ(vlp("[-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15]", "[]"),
            "velodyne-vlp-16.json /moving/channel_elevations_deg/value");
  EXPECT_EQ(vlp("\"most_rotation_hz\": { \"value\": 20", "\"most_rotation_hz\": { \"value\": 2"),
            "velodyne-vlp-16.json /moving/most_rotation_hz");
  EXPECT_EQ(vlp("\"rotation_hz\": 5.0", "\"rotation_hz\": 50"), "velodyne-vlp-16.json /settings");
  EXPECT_EQ(
      errorOf("\"most_speed_mps\": { \"value\": 1.05", "\"most_speed_mps\": { \"value\": 0.01", "leica-blk2go").source,
      "leica-blk2go.json /moving/most_speed_mps/value");
  EXPECT_EQ(vlp("\"value\": \"any\"", "\"value\": \"mast\""), "velodyne-vlp-16.json /moving/mount/value");
  EXPECT_EQ(vlp("\"moving\"", "\"stand\": {}, \"moving\""), "velodyne-vlp-16.json /stand");
  EXPECT_EQ(vlp("\"moving\"", "\"moves\""), "velodyne-vlp-16.json /mirror");
}

TEST_F(ChangedInstrument, WithAValueFarOutOrNestedDeeplyIsRefusedAndNoMore) {
  EXPECT_EQ(errorOf("\"wobble_order\": 2", "\"wobble_order\": 1e300").source,
            "leica-rtc360.json /correlated_noise/wobble_order");
  EXPECT_EQ(errorOf("\"near_range_power\": 2", "\"near_range_power\": -1e300").source,
            "leica-rtc360.json /signal/near_range_power");
  const std::string open(500000, '['), close(500000, ']');
  EXPECT_EQ(describe(errorOf("\"wobble_order\": 2", "\"wobble_order\": " + open + close)),
            "leica-rtc360.json: is nested deeper than 32 levels");
  EXPECT_EQ(describe(errorOf("\"wobble_order\": 2", "\"wobble_order\": " + open)),
            "leica-rtc360.json: is nested deeper than 32 levels");
  EXPECT_NE(errorOf("\"wobble_order\": 2", "\"wobble_order\": 2, \"wobble_order\": 3").message.find("more than once"),
            std::string::npos);
}

TEST_F(ChangedInstrument, CutAnywhereIsAnError) {
  std::ifstream stream(SOURCE_DIR "/scanners/instruments/leica-rtc360.json");
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t from = 0; from < text.size() - 10; from += 97)
    EXPECT_NE(errorOf(text.substr(from), "").message, "accepted") << from;
}

}  // namespace
}  // namespace standpoint
