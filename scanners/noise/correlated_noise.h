// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// The noise that pulses share (physics.md §3.5), of unit variance each; built once for a scan, immutable. A range is
//   r + σ (white() n + along() a_i + common() c_j) + column_extra_m e_j + wobble_m s_ij
// with σ of the sheet, n a pulse's own normal number, c_j and e_j of the column, a_i along it and s_ij of the mirror.
class ColumnNoise {
 public:
  // One elevation for each row.
  ColumnNoise(const Instrument& instrument, std::uint32_t columns, const std::vector<double>& elevation_rad,
              const RandomKey& key);

  // Square roots of shares of the sheet's variance; their squares add up to 1. What of the noise with long memory
  // differs from row to row is white and counted there.
  float white() const { return white_; }
  float along() const { return along_; }
  float common() const { return common_; }

  struct Column {
    float common = 0, extra = 0;               // c_j and e_j: AR(1) from column to column, independent of each other
    float azimuth_rad = 0;                     // flicker of the head
    float wobble_sine = 0, wobble_cosine = 1;  // of φ_j; a column in front and its opposite behind are one turn
  };
  const Column& column(std::uint32_t column) const { return columns_[column]; }

  // The buffer that a column takes: all rows, in full sixteens.
  std::size_t paddedRows() const { return wobble_sine_.size(); }
  // a_i of all rows of a column. With its share of the white noise it has the instrument's Hurst exponent: the variance
  // of a mean over m rows falls as m^(2H-2).
  void along(std::uint32_t column, float* rows) const;
  // s_ij = sin(2πk v_i + φ_j) of sixteen rows from a multiple of sixteen on; v is the turn of the mirror.
  void wobble(std::uint32_t column, std::uint32_t first_row, float* sixteen) const;

 private:
  // Normal numbers a power of four rows apart, with √(1-t) and √t between them, so that the variance is the same at
  // every row; the tables are times the octave's weight.
  struct Octave {
    std::uint32_t length = 4;
    std::vector<float> falling, rising;
  };
  struct OctaveNodes;
  void drawColumns(const RandomKey& key, std::uint32_t columns, double correlation, double flicker_rad);
  void buildOctaves(const CorrelatedNoise& noise);
  static Octave octaveOf(std::uint32_t length, double variance);
  static void addOctaves(float* rows, std::uint32_t count, const OctaveNodes* octaves, int octave_count);

  RandomKey key_;
  float white_ = 1, along_ = 0, common_ = 0;
  std::uint32_t rows_ = 0, half_ = 1;
  std::vector<Column> columns_;
  std::vector<float> wobble_sine_, wobble_cosine_;  // of 2πk v_i in front
  std::vector<Octave> octaves_;
};

}  // namespace standpoint
