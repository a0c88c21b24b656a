// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "core/result.h"

namespace standpoint {

// The sun over a scan. It matters to what a receiver sees beside its own light, not to what has which colour.
struct Sun {
  double azimuth_rad = 0;  // clockwise from the file's +Y, which is grid north
  double elevation_rad = 0;
  double irradiance_W_m2 = 1000;  // on a surface that faces it
  bool operator==(const Sun&) const = default;
};

// "135,40" or "135,40,600" or "135,40,80000lux": azimuth and elevation in degrees, W/m² (sunlight has 120 lux for
// each).
Result<Sun> sunFrom(std::string_view text);

}  // namespace standpoint
