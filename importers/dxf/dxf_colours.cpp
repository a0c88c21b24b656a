// SPDX-License-Identifier: GPL-3.0-or-later
// The AutoCAD colour index by the rule behind its table: 24 hues 15° apart, each in five values, in full and in half
// saturation, then six greys from a third to white. dxflib's table is the same to 1 of 255.
#include "importers/dxf/dxf_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace standpoint {

namespace {

constexpr std::array<std::uint32_t, 10> kStandard{0x000000, 0xFF0000, 0xFFFF00, 0x00FF00, 0x00FFFF,
                                                  0x0000FF, 0xFF00FF, 0xFFFFFF, 0x808080, 0xC0C0C0};
constexpr std::array kValues{255, 165, 127, 76, 38};

// How much of red is in a hue; green and blue are the same 120° and 240° further.
double share(double hue_deg) {
  const double from_peak = std::abs(std::remainder(hue_deg, 360.0)) / 60;
  return std::clamp(2 - from_peak, 0.0, 1.0);
}

}  // namespace

std::uint32_t rgbOfColourIndex(int index) {
  if (index < 10) return kStandard[static_cast<std::size_t>(std::max(index, 0))];
  if (index >= 250) return 0x010101U * static_cast<std::uint32_t>(85 + 34 * (std::min(index, 255) - 250));
  const double hue_deg = 15.0 * (index / 10 - 1), value = kValues[static_cast<std::size_t>(index % 10 / 2)];
  const double least = index % 2 == 0 ? 0 : 0.5;
  const auto part = [&](double offset_deg) {
    return static_cast<std::uint32_t>(value * (least + (1 - least) * share(hue_deg - offset_deg)));
  };
  return part(0) << 16U | part(120) << 8U | part(240);
}

}  // namespace standpoint
