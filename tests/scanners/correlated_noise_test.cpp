// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/correlated_noise.h"

#include <cmath>
#include <numbers>
#include <span>

#include <gtest/gtest.h>

#include "scanners/noise/pulse_noise.h"
#include "tests/scanners/scenes.h"

namespace standpoint {
namespace {

std::vector<double> smallDome(std::uint32_t rows) {
  std::vector<double> elevation_rad;
  for (std::uint32_t i = 0; i < rows; ++i) elevation_rad.push_back(-1.0 + 2.5 * (i + 0.5) / rows);
  return elevation_rad;
}

Instrument withHurst(double hurst) {
  auto instrument = testing::instrument("leica-rtc360");
  instrument.correlated.hurst = hurst;
  return instrument;
}

std::vector<float> alongOf(const ColumnNoise& noise, std::uint32_t column) {
  std::vector<float> rows(noise.paddedRows());
  noise.along(column, rows.data());
  return rows;
}

double meanSquare(std::span<const float> values) {
  double sum = 0;
  for (const float v : values) sum += static_cast<double>(v) * static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}

// Of the means over m values that follow one another, about zero.
double varianceOfMeans(const std::vector<float>& values, std::size_t m) {
  double sum = 0;
  const std::size_t n = values.size() / m;
  for (std::size_t i = 0; i < n; ++i) {
    double mean = 0;
    for (std::size_t k = 0; k < m; ++k) mean += static_cast<double>(values[i * m + k]) / static_cast<double>(m);
    sum += mean * mean;
  }
  return sum / static_cast<double>(n);
}

TEST(NoiseAlongAColumn, HasUnitVarianceAtEveryRow) {
  const ColumnNoise noise(withHurst(0.75), 10, smallDome(500), {1, 1});
  std::vector<double> square(noise.paddedRows());
  constexpr int kColumns = 4000;
  for (std::uint32_t j = 0; j < kColumns; ++j) {
    const auto rows = alongOf(noise, j);
    for (std::size_t i = 0; i < rows.size(); ++i) square[i] += std::pow(static_cast<double>(rows[i]), 2) / kColumns;
  }
  for (const double s : square) EXPECT_NEAR(s, 1, 5 * std::sqrt(2.0 / kColumns));
}

// What a sheet's variance makes along a column when none of it is common to the column: its white part as well.
std::vector<float> withWhite(const ColumnNoise& noise, std::uint32_t column) {
  auto rows = alongOf(noise, column);
  for (std::uint32_t i = 0; i < rows.size(); i += 16) {
    PulseNoise own;
    pulseNoise({1, 1}, column, i, NoiseChannel::pulse, own);
    for (std::uint32_t k = 0; k < 16; ++k) rows[i + k] = noise.along() * rows[i + k] + noise.white() * own.range[k];
  }
  return rows;
}

TEST(NoiseAlongAColumn, HasItsHurstExponentByTheVarianceOfMeans) {
  for (const double hurst : {0.5, 0.6, 0.75, 0.9}) {
    auto instrument = withHurst(hurst);
    instrument.correlated.column_fraction = 0;
    instrument.correlated.along_fraction = 1;
    const ColumnNoise noise(instrument, 10, smallDome(8333), {1, 1});
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t m = 1; m <= 1024; m *= 4) {
      double variance = 0;
      for (std::uint32_t j = 0; j < 150; ++j) variance += varianceOfMeans(withWhite(noise, j), m) / 150;
      const double x = std::log(static_cast<double>(m)), y = std::log(variance);
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    EXPECT_NEAR(1 + (n * sxy - sx * sy) / (n * sxx - sx * sx) / 2, hurst, 0.05);
  }
}

TEST(NoiseAlongAColumn, BelongsToItsColumnAndScan) {
  const auto instrument = withHurst(0.75);
  const ColumnNoise noise(instrument, 10, smallDome(1000), {1, 1}), again(instrument, 20, smallDome(1000), {1, 1});
  const ColumnNoise other(instrument, 10, smallDome(1000), {1, 2});
  EXPECT_EQ(alongOf(noise, 3), alongOf(again, 3));
  EXPECT_NE(alongOf(noise, 3), alongOf(noise, 4));
  EXPECT_NE(alongOf(noise, 3), alongOf(other, 3));
  for (const double hurst : {0.5, 0.75})  // few rows, many rows
    for (const std::uint32_t rows : {1U, 15U, 17U, 70000U})
      for (const float a : alongOf(ColumnNoise(withHurst(hurst), 1, smallDome(rows), {1, 1}), 0))
        ASSERT_LT(std::abs(a), 12);
}

TEST(NoiseOfColumns, IsAutoregressive) {
  auto instrument = testing::instrument("leica-rtc360");
  instrument.correlated.column_correlation = 0.9;
  constexpr std::uint32_t kColumns = 200000;
  const ColumnNoise noise(instrument, kColumns, smallDome(1), {1, 1});
  double variance = 0, next = 0, fifth = 0, cross = 0, flicker = 0;
  for (std::uint32_t j = 0; j + 5 < kColumns; ++j) {
    const auto c = [&](std::uint32_t at) { return static_cast<double>(noise.column(at).common); };
    variance += c(j) * c(j) / kColumns;
    next += c(j) * c(j + 1) / kColumns;
    fifth += c(j) * c(j + 5) / kColumns;
    cross += c(j) * static_cast<double>(noise.column(j).extra) / kColumns;
    flicker += std::pow(static_cast<double>(noise.column(j).azimuth_rad), 2) / kColumns;
  }
  EXPECT_NEAR(variance, 1, 0.03);  // 190 000 values make 10 000 independent ones
  EXPECT_NEAR(next / variance, 0.9, 0.01);
  EXPECT_NEAR(fifth / variance, std::pow(0.9, 5), 0.03);
  EXPECT_NEAR(cross, 0, 0.05);
  EXPECT_NEAR(std::sqrt(flicker) / instrument.correlated.azimuth_flicker_rad, 1, 0.01);
}

TEST(NoiseOfColumns, HasOneWobbleForATurnOfTheMirror) {
  const auto instrument = testing::instrument("trimble-x7");  // k = 2
  const auto elevation_rad = smallDome(64);
  constexpr std::uint32_t kColumns = 2000;
  const ColumnNoise noise(instrument, kColumns, elevation_rad, {1, 1});
  double variance = 0;
  for (std::uint32_t j = 0; j < kColumns / 2; ++j) {
    const auto& front = noise.column(j);
    const double phase = std::atan2(static_cast<double>(front.wobble_sine), static_cast<double>(front.wobble_cosine));
    for (const std::uint32_t column : {j, j + kColumns / 2})
      for (std::uint32_t first = 0; first < 64; first += 16) {
        float sixteen[16];
        noise.wobble(column, first, sixteen);
        variance += meanSquare(sixteen) / (kColumns * 4);
        for (std::uint32_t k = 0; k < 16; ++k) {
          const double upwards = std::numbers::pi / 2 + elevation_rad[first + k];
          const double v = column == j ? upwards : 2 * std::numbers::pi - upwards;
          ASSERT_NEAR(sixteen[k], std::sin(2 * v + phase), 3e-6);
        }
      }
  }
  EXPECT_NEAR(variance, 0.5, 0.01);
}

// A whole grid of range errors on a plane, as a scan adds them up.
struct Grid {
  double variance = 0, variance_of_columns = 0, mean = 0;
};

Grid gridOf(const Instrument& instrument, double sigma_m, std::uint32_t columns, std::uint32_t rows) {
  const ColumnNoise noise(instrument, columns, smallDome(rows), {3, 9});
  Grid grid;
  std::vector<float> along(noise.paddedRows());
  for (std::uint32_t j = 0; j < columns; ++j) {
    noise.along(j, along.data());
    double mean = 0;
    for (std::uint32_t i = 0; i < rows; i += 16) {
      PulseNoise own;
      float wobble[16];
      pulseNoise({3, 9}, j, i, NoiseChannel::pulse, own);
      noise.wobble(j, i, wobble);
      for (std::uint32_t k = 0; k < 16; ++k) {
        const float unit =
            noise.white() * own.range[k] + noise.along() * along[i + k] + noise.common() * noise.column(j).common;
        const double error = sigma_m * static_cast<double>(unit) +
                             instrument.correlated.column_extra_m * static_cast<double>(noise.column(j).extra) +
                             instrument.correlated.wobble_m * static_cast<double>(wobble[k]);
        mean += error / rows;
        grid.variance += error * error / rows / columns;
      }
    }
    grid.mean += mean / columns;
    grid.variance_of_columns += mean * mean / columns;
  }
  return grid;
}

TEST(NoiseOfColumns, ShowsInTheMeansOfColumnsWhatTheSharesSay) {
  auto instrument = testing::instrument("faro-focus-s350");
  auto& noise = instrument.correlated;
  noise.wobble_m = 0;
  for (const double fraction : {0.0, 0.1, 0.4}) {
    noise.column_fraction = fraction;
    const auto grid = gridOf(instrument, 1, 4000, 1024);
    EXPECT_NEAR(grid.variance, 1, 0.03);
    const double from_along = noise.along_fraction * std::pow(1024, 2 * noise.hurst - 2);
    const double from_white = (1 - fraction - noise.along_fraction) / 1024;
    EXPECT_NEAR(grid.variance_of_columns, fraction + from_along + from_white, 0.1 * (fraction + from_along));
  }
}

// V20 of physics.md §7 and finding 3 of its §0.
TEST(Blk360, V20_HasThePlaneNoiseOfTheMeasuredFacade) {
  const auto instrument = testing::instrument("leica-blk360-g1");
  const auto grid = gridOf(instrument, instrument.range_noise[0].sigma_m, 4000, 1024);
  EXPECT_GT(std::sqrt(grid.variance), 0.0020);
  EXPECT_LT(std::sqrt(grid.variance), 0.0023);
  EXPECT_NEAR(std::sqrt(grid.variance), 0.00229, 0.00003);
  EXPECT_NEAR(grid.mean, 0,
              5 * 0.00106 * std::sqrt(3.0 / 4000));  // AR(1) with 0.5 has a third as many independent values
  auto calm = instrument;
  calm.correlated.column_extra_m = calm.correlated.wobble_m = 0;
  EXPECT_NEAR(std::sqrt(gridOf(calm, 0.00203, 4000, 1024).variance), 0.00203, 0.00002);
}

}  // namespace
}  // namespace standpoint
