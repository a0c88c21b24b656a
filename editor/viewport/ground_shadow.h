// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "editor/viewport/merged_scene.h"

namespace standpoint {

// How dark a building makes the ground around it: less of the sky is seen there, and the sun behind it not at all.
struct GroundShadow {
  static constexpr int kSide = 512;
  std::vector<std::uint8_t> darkness;  // kSide rows from the least y on; 0 along the rim; empty: there is none
  double x = 0, y = 0, width_m = 0, height_m = 0;
};

// Of all that is opaque below the cut, but the terrain, in light that comes along the sun of the view. It falls on the
// height of the terrain, else on what it stands on. Of more than four million triangles there is none.
GroundShadow castShadow(const ViewState& state);

}  // namespace standpoint
