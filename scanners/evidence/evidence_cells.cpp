// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/evidence/evidence_cells.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"

namespace standpoint {

namespace {

constexpr double kRangesPerOctave = 4, kIncidence_deg = 5;
// Where more of the returns than this have the very least or the very most figure, those are the ends of the scale.
constexpr double kAtTheEnd = 2e-3;

struct Keyed {
  std::uint64_t key;
  std::uint32_t index;
};

std::uint64_t keyOf(const MeasuredReturn& r) {
  const double octave = std::clamp(std::log2(static_cast<double>(r.range_m)) + 10, 0.0, 60.0);
  const double degrees = std::acos(std::clamp(static_cast<double>(r.cosine), 0.0, 1.0)) / kRadPerDeg;
  return std::uint64_t{r.group} << 32U | static_cast<std::uint64_t>(octave * kRangesPerOctave) << 8U |
         static_cast<std::uint64_t>(degrees / kIncidence_deg);
}

EvidenceCell cellOf(const std::vector<MeasuredReturn>& returns, const Keyed* first, const Keyed* last) {
  std::vector<float> figures;
  double log_range = 0, log_cosine = 0;
  for (const Keyed* k = first; k != last; ++k) {
    const auto& r = returns[k->index];
    figures.push_back(r.intensity);
    log_range += std::log(static_cast<double>(r.range_m));
    log_cosine += std::log(static_cast<double>(r.cosine));
  }
  const auto n = static_cast<double>(figures.size());
  const auto middle = figures.begin() + static_cast<std::ptrdiff_t>(figures.size() / 2);
  std::nth_element(figures.begin(), middle, figures.end());
  return {returns[first->index].group, figures.size(), *middle, std::exp(log_range / n), std::exp(log_cosine / n)};
}

}  // namespace

double EvidenceCell::weight() const { return std::sqrt(static_cast<double>(points)); }

std::vector<EvidenceCell> evidenceCells(const std::vector<MeasuredReturn>& returns, const EvidenceOptions& options,
                                        MaterialComparison& counts, std::vector<bool>& is_used) {
  is_used.assign(returns.size(), false);
  if (returns.empty()) return {};
  const auto [least, most] = std::minmax_element(
      returns.begin(), returns.end(), [](const auto& a, const auto& b) { return a.intensity < b.intensity; });
  const float low = least->intensity, high = most->intensity;
  std::uint64_t at_low = 0, at_high = 0;
  for (const auto& r : returns) at_low += r.intensity == low ? 1 : 0, at_high += r.intensity == high ? 1 : 0;
  const double end = kAtTheEnd * static_cast<double>(returns.size());
  const bool cut_low = static_cast<double>(at_low) > end, cut_high = static_cast<double>(at_high) > end;
  const double min_cosine = std::cos(options.steepest_deg * kRadPerDeg);
  std::vector<Keyed> keyed;
  for (std::uint32_t i = 0; i < returns.size(); ++i) {
    const auto& r = returns[i];
    if (!(static_cast<double>(r.cosine) >= min_cosine)) {
      ++counts.grazing;
    } else if ((cut_low && r.intensity == low) || (cut_high && r.intensity == high)) {
      ++counts.saturated;
    } else {
      is_used[i] = true;
      keyed.push_back({keyOf(r), i});
    }
  }
  counts.used = keyed.size();
  std::sort(keyed.begin(), keyed.end(),
            [](const Keyed& a, const Keyed& b) { return a.key != b.key ? a.key < b.key : a.index < b.index; });
  std::vector<EvidenceCell> cells;
  for (std::size_t from = 0; from < keyed.size();) {
    std::size_t to = from;
    while (to < keyed.size() && keyed[to].key == keyed[from].key) ++to;
    if (to - from >= options.fewest_in_cell) cells.push_back(cellOf(returns, keyed.data() + from, keyed.data() + to));
    from = to;
  }
  return cells;
}

double wayDb(const Instrument& instrument, double range_m, bool range_compensated) {
  if (range_compensated) return 0;
  return 10 * std::log10(static_cast<double>(nearRangeFactor(instrument, static_cast<float>(range_m))) /
                         (range_m * range_m));
}

double surfaceDb(const Optics& optics, double cosine) {
  return 10 * std::log10(std::max(1e-5, static_cast<double>(lambertEquivalent(optics, static_cast<float>(cosine)))));
}

double weightedMedian(std::vector<Weighted> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end(), [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double sum = 0, passed = 0;
  for (const auto& v : values) sum += v.weight;
  for (const auto& v : values)
    if ((passed += v.weight) >= sum / 2) return v.value;
  return values.back().value;
}

Spread spreadOf(std::vector<float>& values) {
  Spread s;
  if (values.empty()) return s;
  std::sort(values.begin(), values.end());
  const auto at = [&](double fraction) {
    return static_cast<double>(
        values[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)))]);
  };
  return {values.size(), at(0.05), at(0.25), at(0.5), at(0.75), at(0.95)};
}

}  // namespace standpoint
