// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string_view>

#include "core/result.h"

namespace standpoint {

// The air of a scan. Fog and dust lie in it besides the haze that the visibility stands for.
struct Weather {
  double visibility_km = 23;  // at 550 nm, 2 % contrast; infinity = no air at all
  double rain_mm_h = 0;
  double snow_mm_h = 0;  // of melted water
  double fog_mor_m = 0;  // meteorological optical range, 5 % contrast; 0 = no fog
  double dust_mor_m = 0;
  bool operator==(const Weather&) const = default;
};

constexpr Weather kNoAir{std::numeric_limits<double>::infinity(), 0, 0, 0, 0};

// "rain=10 fog=200 visibility=5": mm/h, m, km; separated by spaces or commas; what is not named is clear.
Result<Weather> weatherFrom(std::string_view text);
// The key that is out of its bounds as the error's source.
Result<void> check(const Weather& weather);

// α of the extinction e^(-αr), one way: Kim et al. 2001 for the air, drops and flakes twice their cross-section, fog
// and dust alike at all wavelengths (physics.md §2.5, §2.6).
double extinction_per_m(const Weather& weather, double wavelength_nm);

// N(D) = n0 e^(-ΛD): drops by Marshall and Palmer 1948, flakes by Gunn and Marshall 1958 with D of the melted flake.
struct DropSizes {
  double n0_per_m3_mm = 0;
  double lambda_per_mm = 1;
};
DropSizes rainDrops(double mm_h);
DropSizes snowFlakes(double mm_h);
double extinction_per_m(const DropSizes& sizes);
// α of a fog or dust of this optical range.
double extinctionOfRange(double mor_m);

}  // namespace standpoint
