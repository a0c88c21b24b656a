// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/range_noise_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "scanners/radiometry/radiometry.h"

namespace standpoint {

namespace {

constexpr int kParts = 3;
using Triple = std::array<double, kParts>;

struct NoiseFigure {
  Triple terms;         // 1, 1/x and 1/x², each over its largest among the figures
  double variance = 0;  // σ²
};

double modelled(const Triple& parts, const Triple& terms) {
  return parts[0] * terms[0] + parts[1] * terms[1] + parts[2] * terms[2];
}

// The weighted least squares of the parts in `used` (bits), by Gauss and Jordan; nothing where they cannot be told
// apart or one would be negative.
std::optional<Triple> leastSquares(const std::vector<NoiseFigure>& figures, const std::vector<double>& weights,
                                   unsigned used) {
  double rows[kParts][kParts + 1] = {};
  for (int i = 0; i < kParts; ++i) {
    if ((used >> static_cast<unsigned>(i) & 1U) == 0) {
      rows[i][i] = 1;
      continue;
    }
    for (std::size_t f = 0; f < figures.size(); ++f) {
      const double term = weights[f] * figures[f].terms[i];
      for (int j = 0; j < kParts; ++j)
        if ((used >> static_cast<unsigned>(j) & 1U) != 0) rows[i][j] += term * figures[f].terms[j];
      rows[i][kParts] += term * figures[f].variance;
    }
  }
  for (int i = 0; i < kParts; ++i) {
    if (rows[i][i] == 0) return std::nullopt;
    for (int r = 0; r < kParts; ++r) {
      if (r == i) continue;
      const double factor = rows[r][i] / rows[i][i];
      const double left = rows[r][r] - factor * rows[i][r];
      if (r > i && !(left > 1e-9 * rows[r][r])) return std::nullopt;
      for (int c = i; c <= kParts; ++c) rows[r][c] -= factor * rows[i][c];
    }
  }
  Triple parts{};
  for (int i = 0; i < kParts; ++i) {
    parts[i] = rows[i][kParts] / rows[i][i];
    if (parts[i] < 0) return std::nullopt;
  }
  return parts;
}

// (m - v)² / (m v) is the square of ln m/v near the figure: the weights follow the fit until it stands.
Triple fittedParts(const std::vector<NoiseFigure>& figures) {
  std::vector<double> weights;
  for (const auto& f : figures) weights.push_back(1 / (f.variance * f.variance));
  Triple parts{};
  constexpr int kRounds = 100;
  for (int round = 0; round < kRounds; ++round) {
    double least = INFINITY;
    for (unsigned used = 1; used < 1U << kParts; ++used) {
      const auto found = leastSquares(figures, weights, used);
      if (!found) continue;
      double sum = 0;
      for (std::size_t f = 0; f < figures.size(); ++f) {
        const double miss = modelled(*found, figures[f].terms) - figures[f].variance;
        sum += weights[f] * miss * miss;
      }
      if (sum < least) least = sum, parts = *found;
    }
    for (std::size_t f = 0; f < figures.size(); ++f)
      weights[f] = 1 / (modelled(parts, figures[f].terms) * figures[f].variance);
  }
  return parts;
}

bool isPhaseShift(const Instrument& instrument) { return instrument.technology == "phase_shift"; }

RangeNoiseParts ofOnePower(const Instrument& instrument, double x, double variance) {
  const double knee_m = instrument.noise_knee_m > 0 ? instrument.noise_knee_m : classNoiseKnee_m(instrument);
  double ratio = 1 / (knee_m * knee_m * x);  // of the falling part to the floor
  if (isPhaseShift(instrument)) ratio *= ratio;
  const double falling = variance * std::min(0.5, ratio / (1 + ratio));
  if (isPhaseShift(instrument)) return {variance - falling, 0, falling * x * x};
  return {variance - falling, falling * x, 0};
}

}  // namespace

double powerOf(const Instrument& instrument, const RangeNoise& figure) {
  return figure.reflectivity / (figure.range_m * figure.range_m) *
         static_cast<double>(nearRangeFactor(instrument, static_cast<float>(figure.range_m)));
}

double classNoiseKnee_m(const Instrument& instrument) { return isPhaseShift(instrument) ? 56 : 23; }

double sigma_m(const RangeNoiseParts& parts, double x) {
  return std::sqrt(parts.floor_m2 + (parts.shot_m2 + parts.amplifier_m2 / x) / x);
}

RangeNoiseParts rangeNoiseParts(const Instrument& instrument) {
  std::vector<double> powers, distinct;
  for (const auto& figure : instrument.range_noise) powers.push_back(powerOf(instrument, figure));
  const double weakest = *std::min_element(powers.begin(), powers.end());
  for (const double x : powers) {
    const auto same = [&](double other) { return std::abs(x / other - 1) < 1e-6; };
    if (std::none_of(distinct.begin(), distinct.end(), same)) distinct.push_back(x);
  }
  std::vector<NoiseFigure> figures;
  double mean_variance = 0;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const double sigma = instrument.range_noise[i].sigma_m, over = weakest / powers[i];
    mean_variance += sigma * sigma / static_cast<double>(powers.size());
    const bool both = distinct.size() > 2, phase = isPhaseShift(instrument);
    figures.push_back({{1, both || !phase ? over : 0, both || phase ? over * over : 0}, sigma * sigma});
  }
  if (distinct.size() == 1) return ofOnePower(instrument, weakest, mean_variance);
  const auto parts = fittedParts(figures);
  return {parts[0], parts[1] * weakest, parts[2] * weakest * weakest};
}

}  // namespace standpoint
