// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/waveform.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/portable_math.h"

namespace standpoint {

namespace {

constexpr double kLight_m_per_s = 299792458.0;
constexpr double kSigmaPerWidth = 2.354820045;  // FWHM of a Gaussian in its σ

using Group = std::span<const Contribution>;  // by range

struct Begun {
  Echo echo;
  double reference_m = 0;  // range of the strongest
};

Begun begin(Group group) {
  const Contribution* strongest = group.data();
  for (const Contribution& one : group)
    if (one.x > strongest->x) strongest = &one;
  Begun begun;
  begun.reference_m = strongest->range_m;
  begun.echo.strongest = strongest->index;
  begun.echo.spread_m = static_cast<float>(group.back().range_m - group.front().range_m);
  return begun;
}

// σ of the ranges by power.
float deviationOf(Group group) {
  const double reference = group.front().range_m;
  double power = 0, moment = 0, square = 0;
  for (const Contribution& one : group) {
    const double x = static_cast<double>(one.x), off = one.range_m - reference;
    power += x, moment += x * off, square += x * off * off;
  }
  if (!(power > 0)) return 0;
  const double mean = moment / power;
  return static_cast<float>(std::sqrt(std::max(0.0, square / power - mean * mean)));
}

Echo mergedPulse(Group group) {
  auto [echo, reference] = begin(group);
  double moment = 0;
  for (const Contribution& one : group) {
    echo.x += one.x;
    moment += static_cast<double>(one.x) * (one.range_m - reference);
  }
  echo.range_m = reference + (echo.x > 0 ? moment / static_cast<double>(echo.x) : 0);
  echo.deviation_m = deviationOf(group);
  return echo;
}

Echo phasorSum(Group group, double fine_wavelength_m) {
  auto [echo, reference] = begin(group);
  double real = 0, imaginary = 0;
  for (const Contribution& one : group) {
    const double turns = (one.range_m - reference) / fine_wavelength_m;
    float sine, cosine;
    portable::sinCosTurn(static_cast<float>(turns - std::floor(turns)), sine, cosine);
    real += static_cast<double>(one.x * cosine);
    imaginary += static_cast<double>(one.x * sine);
  }
  echo.x = static_cast<float>(std::sqrt(real * real + imaginary * imaginary));
  echo.range_m = reference + fine_wavelength_m * portable::turnOf(imaginary, real);
  echo.deviation_m = deviationOf(group);
  return echo;
}

// What sends nothing back mixes with nothing, unless there is nothing else.
void leaveOutDark(std::vector<Contribution>& contributions) {
  const auto dark = [](const Contribution& one) { return !(one.x > 0); };
  if (!std::all_of(contributions.begin(), contributions.end(), dark)) std::erase_if(contributions, dark);
}

}  // namespace

bool standApart(double distance, double power_ratio) {
  if (distance <= 1) return false;
  if (!(power_ratio > 0) || !std::isfinite(power_ratio)) return false;
  const double root = std::sqrt(distance * distance - 1);
  return std::abs(portable::log(power_ratio)) < 2 * portable::log(distance - root) + 2 * distance * root;
}

void receiveEchoes(const Waveform& waveform, std::vector<Contribution>& contributions, std::vector<Echo>& echoes) {
  echoes.clear();
  if (contributions.empty()) return;
  leaveOutDark(contributions);
  std::sort(contributions.begin(), contributions.end(), [](const Contribution& a, const Contribution& b) {
    return a.range_m != b.range_m ? a.range_m < b.range_m : a.index < b.index;
  });
  const Group all(contributions);
  if (waveform.pulse_width_s <= 0 && waveform.fine_wavelength_m > 0) {
    echoes.push_back(phasorSum(all, waveform.fine_wavelength_m));
    return;
  }
  const double apart = kLight_m_per_s * waveform.pulse_width_s / kSigmaPerWidth;
  std::size_t from = 0;
  for (std::size_t begin = 0, to = 1; begin < all.size(); begin = to++) {
    while (to < all.size() && all[to].range_m - all[to - 1].range_m < apart) ++to;
    const Echo next = mergedPulse(all.subspan(begin, to - begin));
    if (!echoes.empty() &&
        !standApart((next.range_m - echoes.back().range_m) / apart, static_cast<double>(next.x / echoes.back().x))) {
      echoes.back() = mergedPulse(all.subspan(from, to - from));
      continue;
    }
    from = begin;
    echoes.push_back(next);
  }
  while (static_cast<int>(echoes.size()) > waveform.max_returns) {
    const auto weakest =
        std::min_element(echoes.begin(), echoes.end(), [](const Echo& a, const Echo& b) { return a.x < b.x; });
    echoes.erase(weakest);
  }
}

}  // namespace standpoint
