// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/waveform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scanners/portable_math.h"

namespace standpoint {

namespace {

constexpr double kLight_m_per_s = 299792458.0;
constexpr double kSigmaPerWidth = 2.354820045;   // FWHM of a Gaussian in its σ

// An echo of the contributions order[from..to), at `range_m`.
Echo echoOf(const std::vector<Contribution>& all, const std::vector<int>& order, std::size_t from, std::size_t to) {
  Echo echo;
  echo.strongest = order[from];
  for (std::size_t i = from; i < to; ++i)
    if (all[order[i]].x > all[echo.strongest].x) echo.strongest = order[i];
  echo.spread_m = static_cast<float>(all[order[to - 1]].range_m - all[order[from]].range_m);
  return echo;
}

// σ of the ranges by power.
float deviationOf(const std::vector<Contribution>& all, const std::vector<int>& order, std::size_t from, std::size_t to) {
  const double reference = all[order[from]].range_m;
  double power = 0, moment = 0, square = 0;
  for (std::size_t i = from; i < to; ++i) {
    const double x = static_cast<double>(all[order[i]].x), off = all[order[i]].range_m - reference;
    power += x, moment += x * off, square += x * off * off;
  }
  if (!(power > 0)) return 0;
  const double mean = moment / power;
  return static_cast<float>(std::sqrt(std::max(0.0, square / power - mean * mean)));
}

Echo mergedPulse(const std::vector<Contribution>& all, const std::vector<int>& order, std::size_t from, std::size_t to) {
  Echo echo = echoOf(all, order, from, to);
  const double reference = all[echo.strongest].range_m;
  double moment = 0;
  for (std::size_t i = from; i < to; ++i) {
    echo.x += all[order[i]].x;
    moment += static_cast<double>(all[order[i]].x) * (all[order[i]].range_m - reference);
  }
  echo.range_m = reference + (echo.x > 0 ? moment / static_cast<double>(echo.x) : 0);
  echo.deviation_m = deviationOf(all, order, from, to);
  return echo;
}

Echo phasorSum(const std::vector<Contribution>& all, const std::vector<int>& order, double fine_wavelength_m) {
  Echo echo = echoOf(all, order, 0, order.size());
  const double reference = all[echo.strongest].range_m;
  double real = 0, imaginary = 0;
  for (const int i : order) {
    const double turns = (all[i].range_m - reference) / fine_wavelength_m;
    float sine, cosine;
    portable::sinCosTurn(static_cast<float>(turns - std::floor(turns)), sine, cosine);
    real += static_cast<double>(all[i].x * cosine);
    imaginary += static_cast<double>(all[i].x * sine);
  }
  echo.x = static_cast<float>(std::sqrt(real * real + imaginary * imaginary));
  echo.range_m = reference + fine_wavelength_m * portable::turnOf(imaginary, real);
  echo.deviation_m = deviationOf(all, order, 0, order.size());
  return echo;
}

}  // namespace

bool standApart(double distance, double power_ratio) {
  if (distance <= 1) return false;
  if (!(power_ratio > 0) || !std::isfinite(power_ratio)) return false;
  const double root = std::sqrt(distance * distance - 1);
  return std::abs(portable::log(power_ratio)) < 2 * portable::log(distance - root) + 2 * distance * root;
}

void receiveEchoes(const Waveform& waveform, std::vector<Contribution>& contributions, std::vector<int>& order,
                   std::vector<Echo>& echoes) {
  echoes.clear();
  order.clear();
  const bool dark = std::none_of(contributions.begin(), contributions.end(), [](const Contribution& c) { return c.x > 0; });
  for (std::size_t i = 0; i < contributions.size(); ++i)
    if (dark || contributions[i].x > 0) order.push_back(static_cast<int>(i));   // what sends nothing back mixes with nothing
  if (order.empty()) return;
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return contributions[a].range_m != contributions[b].range_m ? contributions[a].range_m < contributions[b].range_m : a < b;
  });
  if (waveform.pulse_width_s <= 0 && waveform.fine_wavelength_m > 0) {
    echoes.push_back(phasorSum(contributions, order, waveform.fine_wavelength_m));
    return;
  }
  const double apart = kLight_m_per_s * waveform.pulse_width_s / kSigmaPerWidth;
  std::size_t from = 0;
  for (std::size_t begin = 0, to = 1; begin < order.size(); begin = to++) {
    while (to < order.size() && contributions[order[to]].range_m - contributions[order[to - 1]].range_m < apart) ++to;
    const Echo next = mergedPulse(contributions, order, begin, to);
    if (!echoes.empty() && !standApart((next.range_m - echoes.back().range_m) / apart, static_cast<double>(next.x / echoes.back().x))) {
      echoes.back() = mergedPulse(contributions, order, from, to);
      continue;
    }
    from = begin;
    echoes.push_back(next);
  }
  while (static_cast<int>(echoes.size()) > waveform.most_returns) {
    const auto weakest = std::min_element(echoes.begin(), echoes.end(), [](const Echo& a, const Echo& b) { return a.x < b.x; });
    echoes.erase(weakest);
  }
}

}  // namespace standpoint
