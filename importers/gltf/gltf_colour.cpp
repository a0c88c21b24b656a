// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "importers/gltf/gltf_material.h"

namespace standpoint {

float srgbFromLinear(float linear) {
  const double x = std::clamp<double>(linear, 0, 1);
  return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

float linearFromSrgb(float srgb) {
  const double x = std::clamp<double>(srgb, 0, 1);
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

std::uint8_t srgb8FromLinear16(std::uint16_t linear) {
  static const auto kTable = [] {
    std::array<std::uint8_t, 65536> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<std::uint8_t>(std::lround(255 * srgbFromLinear(static_cast<float>(i) / 65535.0F)));
    return table;
  }();
  return kTable[linear];
}

std::uint16_t linear16FromSrgb8(std::uint8_t srgb) {
  static const auto kTable = [] {
    std::array<std::uint16_t, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<std::uint16_t>(std::lround(65535 * linearFromSrgb(static_cast<float>(i) / 255.0F)));
    return table;
  }();
  return kTable[srgb];
}

}  // namespace standpoint
