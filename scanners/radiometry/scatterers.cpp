// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/scatterers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/portable_math.h"
#include "core/units.h"
#include "scanners/radiometry/radiometry.h"

namespace standpoint {

namespace {

constexpr std::size_t kNodes = 1024;
constexpr std::uint32_t kDropChannel = 32;  // of Philox; further blocks of a pulse 256 apart, kinds 128 apart
constexpr std::uint32_t kFogChannel = 96;   // further blocks 256 apart
constexpr double kNearest_m = 0.1;          // an instrument without a shortest range
constexpr double kSmallest_m = 5e-5;        // smaller drops are mist and belong to the haze
constexpr double kWater = 0.02;             // ((n - 1) / (n + 1))², n = 1.33
constexpr double kIce = 0.0173;             // n = 1.303
constexpr double kFogBackscatter = 0.046;   // β · MOR, per steradian

}  // namespace

Scatterers::Scatterers(const Instrument& instrument, const Weather& weather, double min_x, double max_range_m,
                       const RandomKey& key, int passes, bool near_range)
    : instrument_(instrument),
      key_(key),
      min_x_(min_x),
      extinction_per_m_(standpoint::extinction_per_m(weather, instrument.wavelength_nm)),
      photons_per_x_(kPhotonsAtThreshold * passes / min_x),
      near_range_(near_range) {
  const double nearest = std::max(instrument.min_range_m, kNearest_m);
  const double span = portable::log(std::max(max_range_m, 1.01 * nearest) / nearest);
  for (std::size_t i = 0; i < kNodes; ++i)
    nodes_m_.push_back(nearest * portable::exp(span * static_cast<double>(i) / (kNodes - 1)));
  if (weather.rain_mm_h > 0) populations_.push_back({ScattererKind::drop, rainDrops(weather.rain_mm_h), kWater, {}});
  if (weather.snow_mm_h > 0) populations_.push_back({ScattererKind::flake, snowFlakes(weather.snow_mm_h), kIce, {}});
  for (auto& population : populations_) count(population);
  if (weather.fog_mor_m > 0 || weather.dust_mor_m > 0) openGates(weather, max_range_m);
}

double Scatterers::beamDiameter(double range_m) const {
  const double spread = instrument_.divergence_rad * range_m;
  return std::sqrt(instrument_.exit_diameter_m * instrument_.exit_diameter_m + spread * spread);
}

double Scatterers::white(double range_m) const {
  const float seen = near_range_ ? nearRangeFactor(instrument_, static_cast<float>(range_m)) : 1;
  return static_cast<double>(seen) * portable::exp(-std::min(2 * extinction_per_m_ * range_m, 600.0)) /
         (range_m * range_m);
}

// x = F white(r) min(D / beam, 1)²: the smallest D that reaches the least x.
double Scatterers::leastDiameter(const Population& population, double range_m, double white_x) const {
  const double fraction = min_x_ / (population.backscatter * white_x);
  if (fraction > 1) return std::numeric_limits<double>::infinity();
  return std::max(beamDiameter(range_m) * std::sqrt(fraction), kSmallest_m);
}

// N(> D) of an exponential distribution is n0/Λ e^(-ΛD); the beam sweeps its cross-section.
void Scatterers::count(Population& population) const {
  const auto per_m = [&](double range_m) {
    const double diameter = leastDiameter(population, range_m, white(range_m));
    if (std::isinf(diameter)) return 0.0;
    const double exponent = std::min(1e3 * population.sizes.lambda_per_mm * diameter, 600.0);
    const double beam = beamDiameter(range_m);
    return population.sizes.n0_per_m3_mm / population.sizes.lambda_per_mm * portable::exp(-exponent) *
           std::numbers::pi / 4 * beam * beam;
  };
  population.number.assign(kNodes, 0);
  for (std::size_t i = 1; i < kNodes; ++i)
    population.number[i] =
        population.number[i - 1] + (per_m(nodes_m_[i - 1]) + per_m(nodes_m_[i])) / 2 * (nodes_m_[i] - nodes_m_[i - 1]);
}

// The node at or before a range, never the last.
std::size_t Scatterers::nodeBefore(double range_m) const {
  const auto after = std::upper_bound(nodes_m_.begin() + 1, nodes_m_.end() - 1, range_m);
  return static_cast<std::size_t>(after - nodes_m_.begin()) - 1;
}

double Scatterers::numberBefore(const Population& population, double range_m) const {
  const std::size_t i = nodeBefore(range_m);
  const double fraction = std::clamp((range_m - nodes_m_[i]) / (nodes_m_[i + 1] - nodes_m_[i]), 0.0, 1.0);
  return population.number[i] + fraction * (population.number[i + 1] - population.number[i]);
}

double Scatterers::rangeOf(const Population& population, double number) const {
  const auto after = std::upper_bound(population.number.begin() + 1, population.number.end() - 1, number);
  const auto index = static_cast<std::size_t>(after - population.number.begin()) - 1;
  const double fraction =
      (number - population.number[index]) / (population.number[index + 1] - population.number[index]);
  return nodes_m_[index] + std::clamp(fraction, 0.0, 1.0) * (nodes_m_[index + 1] - nodes_m_[index]);
}

double Scatterers::expected(double max_range_m) const {
  double sum = 0;
  for (const auto& population : populations_) sum += numberBefore(population, max_range_m);
  return sum;
}

// The drops come in the order of their range, an exponential waiting time apart in expected number. What is larger than
// the least diameter is exponentially distributed again.
void Scatterers::drops(const Population& population, std::uint32_t column, std::uint32_t row, double max_range_m,
                       Scatterer& best) const {
  const double total = numberBefore(population, max_range_m);
  if (total <= 0) return;
  std::uint32_t channel = kDropChannel + 128 * static_cast<std::uint32_t>(population.kind);
  double number = 0;
  for (;; channel += 256) {
    const auto block = philox(key_, column, row, channel);
    for (std::size_t k = 0; k < 4; k += 2) {
      if (uniform(block[k]) <= 1 - (total - number)) return;  // -ln u ≥ 1 - u: most pulses need no logarithm
      number -= portable::log(uniform(block[k]));
      if (number >= total) return;
      const double range_m = rangeOf(population, number);
      const double above_m = -1e-3 / population.sizes.lambda_per_mm * portable::log(uniform(block[k + 1]));
      const double white_x = white(range_m);
      const double diameter = leastDiameter(population, range_m, white_x) + above_m;
      const double fraction = std::min(diameter / beamDiameter(range_m), 1.0);
      const double x = population.backscatter * white_x * fraction * fraction;
      if (x > best.x) best = {population.kind, range_m, x};
    }
  }
}

// π turns the backscatter per steradian into that of a Lambert target, whose own is ρ/π. The pulse is a squared sine of
// the width's full length, 2 τ in time and so c τ in range.
double Scatterers::softPower(double range_m, double pulse_length_m, double backscatter_per_m) const {
  constexpr int kSteps = 64;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const float turn = (static_cast<float>(k) + 0.5F) / (2 * kSteps);
    const double from = range_m - 2 * static_cast<double>(turn) * pulse_length_m;
    if (from <= 0.01) break;
    float sine, cosine;
    portable::sinCosTurn(turn, sine, cosine);
    sum += static_cast<double>(sine * sine) * white(from);
  }
  return std::numbers::pi * backscatter_per_m * sum * pulse_length_m / kSteps;
}

// A phase scanner has no pulse: what its finest tone cannot tell apart takes its place. Gates that reach the least x
// with a chance of less than some 1e-9 are left out.
void Scatterers::openGates(const Weather& weather, double max_range_m) {
  constexpr double kDeviations = 6;
  const auto& waveform = instrument_.waveform;
  const double length_m =
      waveform.pulse_width_s > 0 ? kSpeedOfLight_m_s * waveform.pulse_width_s : waveform.fine_wavelength_m;
  double backscatter = 0;
  if (weather.fog_mor_m > 0) backscatter += kFogBackscatter / weather.fog_mor_m;
  if (weather.dust_mor_m > 0) backscatter += kFogBackscatter / weather.dust_mor_m;
  gate_m_ = length_m / 2;
  for (double from_m = nodes_m_.front(); from_m < max_range_m; from_m += gate_m_) {
    const double x = softPower(from_m + gate_m_ / 2, length_m, backscatter);
    const double photons = x * photons_per_x_;
    if (photons + kDeviations * std::sqrt(photons) >= min_x_ * photons_per_x_) gates_.push_back({from_m, x});
  }
}

// A Poisson number from a normal one, by the first two terms of its Cornish–Fisher expansion: where it matters there
// are tens of photons. What is counted may come from anywhere within its gate.
void Scatterers::fog(std::uint32_t column, std::uint32_t row, double max_range_m, Scatterer& best) const {
  std::uint32_t channel = kFogChannel;
  for (std::size_t i = 0; i < gates_.size(); i += 2, channel += 256) {
    const auto block = philox(key_, column, row, channel);
    for (std::size_t k = 0; k < 2 && i + k < gates_.size(); ++k) {
      const Gate& gate = gates_[i + k];
      const double range_m = gate.from_m + gate_m_ * uniform(block[2 + k]);
      if (range_m > max_range_m) return;
      float sine, cosine;
      portable::sinCosTurn(static_cast<float>(uniform(block[1])), sine, cosine);
      const double normal =
          std::sqrt(-2 * portable::log(uniform(block[0]))) * static_cast<double>(k == 0 ? cosine : sine);
      const double mean = gate.x * photons_per_x_;
      const double counted = mean + std::sqrt(mean) * normal + (normal * normal - 1) / 6;
      const double x = counted / photons_per_x_;
      if (x > best.x) best = {ScattererKind::fog, range_m, x};
    }
  }
}

std::optional<Scatterer> Scatterers::strongest(std::uint32_t column, std::uint32_t row, double max_range_m,
                                               double min_x) const {
  if (!(max_range_m > nodes_m_[0])) return std::nullopt;
  Scatterer best;
  for (const auto& population : populations_) drops(population, column, row, max_range_m, best);
  fog(column, row, max_range_m, best);
  if (best.x <= 0 || best.x < min_x) return std::nullopt;
  return best;
}

}  // namespace standpoint
