// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

#include "core/environment.h"

namespace standpoint {

constexpr std::array<std::string_view, 12> kColourBands = {"transparent", "white", "grey",   "black", "red",  "brown",
                                                           "orange",      "beige", "yellow", "green", "blue", "violet"};

// A pane drawn with some tint still counts as transparent; viewers draw 20 % as barely so.
constexpr float kOpaqueFrom = 0.8F;

inline bool isTransparent(const Colour& colour) { return colour.a < kOpaqueFrom; }

std::string_view colourBand(const Colour& colour);

// What lets light through is transparent, however opaque its colour is written: glTF's glass has alpha 1 and a
// transmission.
inline bool isTransparent(const Surface& surface) {
  return isTransparent(surface.colour) || surface.transmission.value_or(0) > 1 - kOpaqueFrom;
}
inline std::string_view colourBand(const Surface& surface) {
  return isTransparent(surface) ? "transparent" : colourBand(surface.colour);
}

}  // namespace standpoint
