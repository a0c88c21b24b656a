// SPDX-License-Identifier: GPL-3.0-or-later
#include "materials/colour.h"

#include <algorithm>

namespace standpoint {

namespace {

// Hue 0..360, saturation and value 0..1 (Smith 1978).
struct Hsv {
  float hue, saturation, value;
};

Hsv hsv(const Colour& c) {
  const float high = std::max({c.r, c.g, c.b});
  const float range = high - std::min({c.r, c.g, c.b});
  if (range <= 0) return {0, 0, high};
  const float sextant = high == c.r   ? (c.g - c.b) / range
                        : high == c.g ? 2 + (c.b - c.r) / range
                                      : 4 + (c.r - c.g) / range;
  return {sextant < 0 ? 60 * sextant + 360 : 60 * sextant, range / high, high};
}

std::string_view hueBand(const Hsv& c) {
  if (c.hue < 18 || c.hue >= 340) return c.value < 0.35F ? "brown" : "red";
  if (c.hue < 48) return c.saturation < 0.45F && c.value > 0.6F ? "beige" : c.value < 0.75F ? "brown" : "orange";
  if (c.hue < 70) return c.saturation < 0.45F && c.value > 0.6F ? "beige" : "yellow";
  return c.hue < 170 ? "green" : c.hue < 260 ? "blue" : "violet";
}

}  // namespace

// The default colour means that the file says none: no band, so no colour rule decides on it.
std::string_view colourBand(const Colour& colour) {
  if (colour == Colour{}) return "";
  if (isTransparent(colour)) return "transparent";
  const auto c = hsv(colour);
  if (c.value < 0.15F) return "black";
  if (c.saturation < 0.12F) return c.value > 0.85F ? "white" : "grey";
  return hueBand(c);
}

}  // namespace standpoint
