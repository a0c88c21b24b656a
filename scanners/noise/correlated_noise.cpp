// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/correlated_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"
#include "scanners/noise/pulse_noise.h"

namespace standpoint {

namespace {

// Philox channels: one for what a column has, one for the phases, and one for each octave along it.
constexpr auto kColumnChannel = static_cast<NoiseChannel>(48);
constexpr std::uint32_t kPhaseChannel = 49;
constexpr std::uint32_t kOctaveChannel = 50;

constexpr std::uint32_t kTabulated = 1024;         // rows of the longest octave with a table of every row
constexpr std::uint32_t kBlock = 4 * kNoiseLanes;  // normal numbers of one call

// Numbers `first`, `first` + 1 … of a column's channel.
void normalNumbers(const RandomKey& key, std::uint32_t column, std::uint32_t channel, std::vector<float>& numbers) {
  const auto count = static_cast<std::uint32_t>(numbers.size());
  PulseNoise noise;
  for (std::uint32_t from = 0; from < count; from += kBlock) {
    pulseNoise(key, column, from / 4, static_cast<NoiseChannel>(channel), noise);
    const float* const parts[] = {noise.range, noise.lateral, noise.elevation, noise.detection};
    for (std::uint32_t k = 0; k < kBlock && from + k < count; ++k)
      numbers[from + k] = parts[k / kNoiseLanes][k % kNoiseLanes];
  }
}

// Sixteen rows in four cells of four.
STANDPOINT_INLINE void addShortCells(float* rows, const float* nodes, const float* falling, const float* rising) {
  for (std::uint32_t cell = 0; cell < 4; ++cell)
    for (std::uint32_t s = 0; s < 4; ++s) rows[4 * cell + s] += nodes[cell] * falling[s] + nodes[cell + 1] * rising[s];
}

STANDPOINT_INLINE void addOneCell(float* rows, const float* nodes, const float* falling, const float* rising) {
  for (std::uint32_t s = 0; s < kNoiseLanes; ++s) rows[s] += nodes[0] * falling[s] + nodes[1] * rising[s];
}

}  // namespace

// Of one octave: its numbers at the nodes, and √(1-t), √t of its steps times its weight.
struct ColumnNoise::OctaveNodes {
  const float *nodes, *falling, *rising;
  std::uint32_t length;
};

ColumnNoise::ColumnNoise(const Instrument& instrument, std::uint32_t columns, const std::vector<double>& elevation_rad,
                         const RandomKey& key)
    : key_(key), rows_(static_cast<std::uint32_t>(elevation_rad.size())), half_((columns + 1) / 2) {
  const auto& noise = instrument.correlated;
  common_ = static_cast<float>(std::sqrt(noise.column_fraction));
  drawColumns(key, columns, noise.column_correlation, noise.azimuth_flicker_rad);
  buildOctaves(noise);
  wobble_sine_.assign((elevation_rad.size() + kNoiseLanes - 1) / kNoiseLanes * kNoiseLanes, 0);
  wobble_cosine_ = wobble_sine_;
  for (std::size_t row = 0; row < elevation_rad.size(); ++row) {
    const double turns = noise.wobble_order * (0.25 + elevation_rad[row] / (2 * std::numbers::pi));
    portable::sinCosTurn(static_cast<float>(turns - std::floor(turns)), wobble_sine_[row], wobble_cosine_[row]);
  }
}

void ColumnNoise::drawColumns(const RandomKey& key, std::uint32_t columns, double correlation, double flicker_rad) {
  const auto kept = static_cast<float>(correlation);
  const auto fresh = static_cast<float>(std::sqrt(1 - correlation * correlation));
  columns_.resize(columns);
  PulseNoise noise{};
  for (std::uint32_t j = 0; j < columns; ++j) {
    const std::uint32_t lane = j % kNoiseLanes;
    if (lane == 0) pulseNoise(key, 0, j, kColumnChannel, noise);
    Column& column = columns_[j];
    column.common = j == 0 ? noise.range[lane] : kept * columns_[j - 1].common + fresh * noise.range[lane];
    column.extra = j == 0 ? noise.detection[lane] : kept * columns_[j - 1].extra + fresh * noise.detection[lane];
    column.azimuth_rad = static_cast<float>(flicker_rad) * noise.lateral[lane];
    const std::uint32_t turn = j >= half_ ? j - half_ : j;
    const auto phase = static_cast<float>(philox(key, 0, turn, kPhaseChannel)[0] >> 8U) * 0x1p-24F;
    portable::sinCosTurn(phase, column.wobble_sine, column.wobble_cosine);
  }
}

// The variance of an octave falls with its length L as L^-γ, γ = 2 - 2H: a mean over m rows keeps the longer ones and
// averages the shorter ones, so that its own variance falls as m^-γ. The longest stands for all beyond it, too; the
// shortest, from row to row, for all below it, and for averaging out faster than the others, whose cells overlap: 1.3
// makes the fitted H right within 0.01 from 0.52 to 0.95. What differs from row to row is white and drawn with what is.
void ColumnNoise::buildOctaves(const CorrelatedNoise& noise) {
  const double gamma = 2 - 2 * noise.hurst;
  std::vector<double> variance;
  double sum = gamma < 1 ? 1.3 / (1 - portable::pow(4, gamma - 1)) : 1;
  const double row_to_row = sum;
  for (std::uint64_t length = 4, last = 0; gamma < 1 && last == 0; length *= 4) {
    last = length >= rows_ ? 1 : 0;
    const double own = portable::pow(static_cast<double>(length), -gamma);
    variance.push_back(last == 1 ? own / (1 - portable::pow(4, -gamma)) : own);
    sum += variance.back();
  }
  const double long_memory = noise.along_fraction * (1 - row_to_row / sum);
  along_ = static_cast<float>(std::sqrt(long_memory));
  white_ = static_cast<float>(std::sqrt(std::max(0.0, 1 - noise.column_fraction - long_memory)));
  std::uint32_t length = 4;
  for (const double own : variance) {
    octaves_.push_back(octaveOf(length, own / (sum - row_to_row)));
    length *= 4;
  }
}

ColumnNoise::Octave ColumnNoise::octaveOf(std::uint32_t length, double variance) {
  Octave octave{length, {}, {}};
  const std::uint32_t steps = length <= kTabulated ? length : length / kNoiseLanes;
  for (std::uint32_t s = 0; s < steps; ++s) {
    const double fraction = static_cast<double>(s) / steps;
    octave.falling.push_back(static_cast<float>(std::sqrt(variance * (1 - fraction))));
    octave.rising.push_back(static_cast<float>(std::sqrt(variance * fraction)));
  }
  return octave;
}

STANDPOINT_CLONES void ColumnNoise::addOctaves(float* rows, std::uint32_t count, const OctaveNodes* octaves,
                                               int octave_count) {
  for (std::uint32_t from = 0; from < count; from += kNoiseLanes) {
    float sum[kNoiseLanes] = {};
    for (int k = 0; k < octave_count; ++k) {
      const auto& octave = octaves[k];
      const float* const nodes = octave.nodes + from / octave.length;
      const std::uint32_t place = from % octave.length;
      if (octave.length < kNoiseLanes) {
        addShortCells(sum, nodes, octave.falling, octave.rising);
      } else if (octave.length <= kTabulated) {
        addOneCell(sum, nodes, octave.falling + place, octave.rising + place);
      } else {  // so long that it does not change in sixteen rows
        const std::uint32_t step = place / kNoiseLanes;
        const float value = nodes[0] * octave.falling[step] + nodes[1] * octave.rising[step];
        for (float& row : sum) row += value;
      }
    }
    for (std::uint32_t s = 0; s < kNoiseLanes; ++s) rows[from + s] = sum[s];
  }
}

void ColumnNoise::along(std::uint32_t column, float* rows) const {
  const auto count = static_cast<std::uint32_t>(paddedRows());
  std::vector<std::vector<float>> nodes;
  std::vector<OctaveNodes> octaves;
  for (std::size_t k = 0; k < octaves_.size(); ++k) {
    const auto& octave = octaves_[k];
    nodes.emplace_back(count / octave.length + 2);
    normalNumbers(key_, column, kOctaveChannel + static_cast<std::uint32_t>(k), nodes.back());
    octaves.push_back({nodes.back().data(), octave.falling.data(), octave.rising.data(), octave.length});
  }
  addOctaves(rows, count, octaves.data(), static_cast<int>(octaves.size()));
}

// Behind, the mirror has turned on: v = 1 - v in front.
void ColumnNoise::wobble(std::uint32_t column, std::uint32_t first_row, float* sixteen) const {
  const Column& own = columns_[column];
  const float side = column >= half_ ? -own.wobble_cosine : own.wobble_cosine;
  for (std::uint32_t k = 0; k < kNoiseLanes; ++k)
    sixteen[k] = side * wobble_sine_[first_row + k] + own.wobble_sine * wobble_cosine_[first_row + k];
}

}  // namespace standpoint
