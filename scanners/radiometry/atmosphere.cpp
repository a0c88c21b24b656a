// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/atmosphere.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include "core/portable_math.h"

namespace standpoint {

namespace {

struct Quantity {
  const char* key;
  const char* unit;
  double Weather::*value;
  double least, most;  // besides the value that stands for clear
};

// Below 5 m of optical range no instrument sees anything, and 300 mm/h is the heaviest rain that lasts for minutes.
constexpr std::array kQuantities = {
    Quantity{"visibility", "km", &Weather::visibility_km, 0.01, 1000},
    Quantity{"rain", "mm/h", &Weather::rain_mm_h, 0.1, 300},
    Quantity{"snow", "mm/h", &Weather::snow_mm_h, 0.1, 100},
    Quantity{"fog", "m", &Weather::fog_mor_m, 5, 50000},
    Quantity{"dust", "m", &Weather::dust_mor_m, 5, 50000},
};

std::string shortNumber(double value) {
  std::array<char, 32> buffer;
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

std::string quoted(std::string_view word) { return std::string("\"").append(word).append("\""); }

std::string bounds(const Quantity& q) {
  return std::string(q.key) + " takes " + shortNumber(q.least) + " to " + shortNumber(q.most) + " " + q.unit + ", or " +
         (q.value == &Weather::visibility_km ? "inf" : "0") + " for none";
}

// q of Kim et al. 2001: from haze to fog the wavelength ceases to matter.
double kimExponent(double visibility_km) {
  if (visibility_km > 50) return 1.6;
  if (visibility_km > 6) return 1.3;
  if (visibility_km > 1) return 0.16 * visibility_km + 0.34;
  return std::max(visibility_km - 0.5, 0.0);
}

double airExtinction(double visibility_km, double wavelength_nm) {
  if (std::isinf(visibility_km)) return 0;
  return 3.912e-3 / visibility_km * portable::pow(wavelength_nm / 550, -kimExponent(visibility_km));
}

Result<void> take(Weather& weather, std::string_view word, std::array<bool, kQuantities.size()>& given) {
  const auto equals = word.find('=');
  const auto key = word.substr(0, equals);
  for (std::size_t i = 0; i < kQuantities.size(); ++i) {
    const auto& q = kQuantities[i];
    if (key != q.key) continue;
    if (given[i]) return failure(ErrorKind::usage, "is given twice", q.key);
    given[i] = true;
    const auto number = equals == word.npos ? std::string_view() : word.substr(equals + 1);
    const auto [end, code] = std::from_chars(number.data(), number.data() + number.size(), weather.*q.value);
    if (code != std::errc() || end != number.data() + number.size())
      return failure(ErrorKind::usage, quoted(number) + " is not a number: " + bounds(q), q.key);
    return {};
  }
  std::string keys;
  for (const auto& q : kQuantities) keys += (keys.empty() ? "" : "; ") + bounds(q);
  return failure(ErrorKind::usage, quoted(key) + " is not a weather setting: " + keys, "weather");
}

}  // namespace

Result<Weather> weatherFrom(std::string_view text) {
  constexpr std::string_view kGaps = " ,\t\n";
  Weather weather;
  std::array<bool, kQuantities.size()> given{};
  for (auto from = text.find_first_not_of(kGaps); from != text.npos; from = text.find_first_not_of(kGaps, from)) {
    const auto to = std::min(text.find_first_of(kGaps, from), text.size());
    TRY(take(weather, text.substr(from, to - from), given));
    from = to;
  }
  TRY(check(weather));
  return weather;
}

Result<void> check(const Weather& weather) {
  for (const auto& q : kQuantities) {
    const double value = weather.*q.value;
    const bool none = q.value == &Weather::visibility_km ? std::isinf(value) && value > 0 : value == 0;
    if (!none && !(value >= q.least && value <= q.most))
      return failure(ErrorKind::usage, shortNumber(value) + " is out of bounds: " + bounds(q), q.key);
  }
  return {};
}

double extinction_per_m(const Weather& weather, double wavelength_nm) {
  return airExtinction(weather.visibility_km, wavelength_nm) + extinction_per_m(rainDrops(weather.rain_mm_h)) +
         extinction_per_m(snowFlakes(weather.snow_mm_h)) + extinctionOfRange(weather.fog_mor_m) +
         extinctionOfRange(weather.dust_mor_m);
}

DropSizes rainDrops(double mm_h) { return mm_h > 0 ? DropSizes{8000, 4.1 * portable::pow(mm_h, -0.21)} : DropSizes{}; }

DropSizes snowFlakes(double mm_h) {
  return mm_h > 0 ? DropSizes{7600 * portable::pow(mm_h, -0.87), 2.55 * portable::pow(mm_h, -0.48)} : DropSizes{};
}

// ∫ N(D) Q π/4 D² dD with Q = 2.
double extinction_per_m(const DropSizes& sizes) {
  const double length = 1 / sizes.lambda_per_mm;
  return 1e-6 * std::numbers::pi * sizes.n0_per_m3_mm * length * length * length;
}

double extinctionOfRange(double mor_m) { return mor_m > 0 ? 2.995732273553991 / mor_m : 0; }  // ln 20

}  // namespace standpoint
