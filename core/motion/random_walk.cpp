// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/random_walk.h"

#include <algorithm>
#include <cmath>

#include "core/portable_math.h"
#include "core/random.h"
#include "core/units.h"

namespace standpoint {

namespace {

std::array<std::uint32_t, 4> blockOf(const MotionKey& key, std::uint32_t level, std::uint32_t index) {
  return philox({key.seed, key.trajectory}, index, level, static_cast<std::uint32_t>(key.process) + key.component);
}

// cos 2πt of |t| below 2^50, absolute error below 1e-15 and that of t itself: no branch and no call, so that several go
// side by side. By the sine of what is left to a quarter turn, at most π/2.
inline double cosineOfTurns(double turns) {
  constexpr double kRounding = 0x1.8p52;  // adding it leaves a whole number
  const double rest = turns - ((turns + kRounding) - kRounding);
  const double x = kRadPerTurn * (0.25 - std::abs(rest)), q = x * x;
  double sum = -1.0 / 121645100408832000;  // 19!
  for (const double inverse : {1.0 / 355687428096000, -1.0 / 1307674368000, 1.0 / 6227020800, -1.0 / 39916800,
                               1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6, 1.0})
    sum = sum * q + inverse;
  return x * sum;
}

}  // namespace

double normalNumber(const MotionKey& key, std::uint32_t level, std::uint32_t index) {
  const auto block = blockOf(key, level, index);
  double sine, cosine;
  portable::sinCos(kRadPerTurn * uniform(block[1]), sine, cosine);
  return std::sqrt(-2 * portable::log(uniform(block[0]))) * cosine;
}

double uniformNumber(const MotionKey& key, std::uint32_t level, std::uint32_t index) {
  return uniform(blockOf(key, level, index)[0]);
}

namespace {

// The value at a knot, from those at the first and the last: halves what is between, where `middle` says it.
template <class Middle>
double halved(std::uint32_t knot, double at_low, double at_high, const Middle& middle) {
  if (knot >= RandomWalk::kLastKnot) return at_high;
  std::uint32_t low = 0;
  for (int level = RandomWalk::kLevels; knot != low; --level) {
    const std::uint32_t middle_knot = low + (1U << static_cast<unsigned>(level - 1));
    const double at_middle = middle(at_low, at_high, level, middle_knot);
    if (knot < middle_knot) {
      at_high = at_middle;
    } else {
      low = middle_knot;
      at_low = at_middle;
    }
  }
  return at_low;
}

}  // namespace

double RandomWalk::middle(double low, double high, int level, std::uint32_t knot) const {
  const double width = std::ldexp(1.0, level);
  return 0.5 * (low + high) + 0.5 * std::sqrt(width) * normalNumber(key_, static_cast<std::uint32_t>(level), knot);
}

double RandomWalk::at(std::uint32_t knot) const {
  return halved(knot, 0, 1024 * normalNumber(key_, kLevels, 0),
                [this](double low, double high, int level, std::uint32_t at) { return middle(low, high, level, at); });
}

void RandomWalk::fill(std::uint32_t low, int level, double at_low, double at_high, std::vector<double>& knots) const {
  knots[low] = at_low;
  if (level == 0) return;
  const std::uint32_t middle_knot = low + (1U << static_cast<unsigned>(level - 1));
  if (low + 1 >= knots.size()) return;
  const double at_middle = middle(at_low, at_high, level, middle_knot);
  fill(low, level - 1, at_low, at_middle, knots);
  if (middle_knot < knots.size()) fill(middle_knot, level - 1, at_middle, at_high, knots);
}

std::vector<double> RandomWalk::first(std::uint32_t count) const {
  std::vector<double> knots(std::min(count, kLastKnot + 1));
  const double last = 1024 * normalNumber(key_, kLevels, 0);
  if (!knots.empty()) fill(0, kLevels, 0, last, knots);
  if (knots.size() > kLastKnot) knots.back() = last;
  return knots;
}

GaussMarkov::GaussMarkov(const MotionKey& key, double step_per_tau) : key_(key) {
  for (int level = 0; level <= RandomWalk::kLevels; ++level)
    correlation_[level] = portable::exp(-std::min(700.0, std::ldexp(step_per_tau, level)));
}

// The middle of two knots r apart from each has the mean r (low + high)/(1 + r²) and the variance (1 - r²)/(1 + r²).
double GaussMarkov::at(std::uint32_t knot) const {
  const double whole = correlation_[RandomWalk::kLevels];
  const double first = normalNumber(key_, RandomWalk::kLevels + 1, 0);
  const double last = whole * first + std::sqrt(1 - whole * whole) * normalNumber(key_, RandomWalk::kLevels, 0);
  return halved(knot, first, last, [this](double low, double high, int level, std::uint32_t at) {
    const double r = correlation_[level - 1], square = r * r;
    return (r * (low + high) +
            std::sqrt((1 - square) * (1 + square)) * normalNumber(key_, static_cast<std::uint32_t>(level), at)) /
           (1 + square);
  });
}

BandNoise::BandNoise(const MotionKey& key, double lowest_hz, double highest_hz) {
  for (int i = 0; i < kCount; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    hertz_[i] = lowest_hz + (i + uniformNumber(key, 0, index)) * (highest_hz - lowest_hz) / kCount;
    phase_turns_[i] = uniformNumber(key, 1, index);
  }
}

double BandNoise::at(double time_s) const {
  std::array<double, kCount> cosine;
  for (int i = 0; i < kCount; ++i) cosine[i] = cosineOfTurns(hertz_[i] * time_s + phase_turns_[i]);
  double sum = 0;
  for (const double one : cosine) sum += one;
  return sum * std::sqrt(2.0 / kCount);
}

}  // namespace standpoint
