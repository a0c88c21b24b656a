// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/daylight.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>

#include <Eigen/Geometry>

#include "core/units.h"

namespace standpoint {

namespace {

constexpr double kLuxPerWatt = 120;    // luminous efficacy of sunlight, 110 to 130 lm/W
constexpr double kDisc_rad = 0.00465;  // half of the sun's diameter
constexpr double kScatterAtOneDegree = 1e-3;
constexpr double kFarthest_m = 1e6;

Error noSun(std::string_view text) {
  return {ErrorKind::usage,
          "\"" + std::string(text) +
              "\" must be AZIMUTH,ELEVATION[,W/m2]: degrees clockwise from the file's Y and above the horizon; 0 to "
              "1500 W/m2, or lux such as 80000lux",
          "--sun"};
}

}  // namespace

Result<Sun> sunFrom(std::string_view text) {
  std::array<double, 3> number{0, 0, 1000};
  std::size_t count = 0;
  std::string_view rest = text;
  for (bool more = true; more; ++count) {
    if (count == number.size()) return failure(noSun(text));
    const auto comma = std::min(rest.find(','), rest.size());
    std::string_view word = rest.substr(0, comma);
    more = comma < rest.size();
    rest.remove_prefix(more ? comma + 1 : comma);
    double scale = 1;
    if (count == 2 && word.ends_with("lux")) word.remove_suffix(3), scale = 1 / kLuxPerWatt;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number[count]);
    if (code != std::errc() || end != word.data() + word.size()) return failure(noSun(text));
    number[count] *= scale;
  }
  const auto [azimuth, elevation, irradiance] = number;
  const bool possible =
      azimuth >= -360 && azimuth <= 360 && elevation > 0 && elevation <= 90 && irradiance >= 0 && irradiance <= 1500;
  if (count < 2 || !possible) return failure(noSun(text));
  return Sun{azimuth * kRadPerDeg, elevation * kRadPerDeg, irradiance};
}

Daylight::Daylight(const EmbreeScene& scene, const Instrument& instrument, const Sun& sun,
                   const Eigen::Vector3d& station)
    : towards_(std::cos(sun.elevation_rad) * std::sin(sun.azimuth_rad),
               std::cos(sun.elevation_rad) * std::cos(sun.azimuth_rad), std::sin(sun.elevation_rad)),
      white_(instrument.sun_noise * sun.irradiance_W_m2 / 1000),
      station_lit_(scene.nearest(station, towards_, 0, kFarthest_m).facet == kNoFacet) {}

float Daylight::ofSurface(float reflectance, const Eigen::Vector3f& normal) const {
  return static_cast<float>(white_) * reflectance * std::max(0.0F, normal.dot(towards_.cast<float>()));
}

float Daylight::ofDirection(const Eigen::Vector3d& direction) const {
  if (!station_lit_ || !(direction.dot(towards_) > 0)) return 0;
  const double angle = direction.cross(towards_).norm();  // its sine, which is enough where it counts
  const double disc = white_ / (kDisc_rad * kDisc_rad);   // π / Ω_sun
  if (angle < kDisc_rad) return static_cast<float>(disc);
  const double degrees = std::max(angle, kDisc_rad) / kRadPerDeg;
  return static_cast<float>(disc * kScatterAtOneDegree / (degrees * degrees));
}

}  // namespace standpoint
