// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include <cstring>

#include "scanners/portable_math.h"

// A random field over space from integer arithmetic: a number for each corner of a cubic grid, blended in between.
// Straight-line code that vectorises.
namespace standpoint::value_noise {

// Four bytes summed: mean 510, variance 4 (256² - 1) / 12; nearly normal, and blending eight of them makes it more so.
STANDPOINT_INLINE float cornerNumber(std::uint32_t place) {
  const std::uint32_t h = (place ^ (place >> 15U)) * 0x846CA68BU;
  const std::uint32_t pairs = (h & 0x00FF00FFU) + ((h >> 8U) & 0x00FF00FFU);
  const std::uint32_t sum = (pairs & 0xFFFFU) + (pairs >> 16U);
  return static_cast<float>(static_cast<std::int32_t>(sum) - 510);
}

constexpr float kShift = 0x1.8p23F;      // adding it rounds to a whole number
constexpr float kFarthest = 0x1p21F;

// Where a coordinate lies between two corners, with weights a² + b² = 1: whatever the place, the variance is the same.
struct Axis {
  std::int32_t corner;
  float a, b;
};
STANDPOINT_INLINE Axis axisAt(float coordinate) {
  const float low = coordinate > -kFarthest ? coordinate : -kFarthest;
  const float bounded = low < kFarthest ? low : kFarthest;
  const float shifted = bounded + kShift;
  std::int32_t corner;
  std::memcpy(&corner, &shifted, sizeof corner);            // counts in ones there; where it begins does not matter
  const float t = bounded - (shifted - kShift);          // from the middle of the cell, -1/2 to 1/2
  const float u = t * (1.5F - 2 * t * t) * 1.5707963267948966F;   // smooth at the corners
  const float q = u * u;
  const float sine = u * (1 - q * (1.0F / 6) * (1 - q * (1.0F / 20) * (1 - q * (1.0F / 42))));
  const float cosine = 1 - q * 0.5F * (1 - q * (1.0F / 12) * (1 - q * (1.0F / 30)));
  return {corner, 0.70710678118654752F * (cosine - sine), 0.70710678118654752F * (cosine + sine)};
}

// Zero mean, unit variance; the field's cells are 1 wide.
STANDPOINT_INLINE float field(float x, float y, float z, std::uint32_t salt) {
  const Axis i = axisAt(x), j = axisAt(y), k = axisAt(z);
  const std::uint32_t x0 = static_cast<std::uint32_t>(i.corner) * 0x8DA6B343U + salt;
  const std::uint32_t y0 = static_cast<std::uint32_t>(j.corner) * 0xD8163841U;
  const std::uint32_t z0 = static_cast<std::uint32_t>(k.corner) * 0xCB1AB31FU;
  const std::uint32_t x1 = x0 + 0x8DA6B343U;
  const std::uint32_t y1 = y0 + 0xD8163841U;
  const std::uint32_t z1 = z0 + 0xCB1AB31FU;
  const float near = j.a * (i.a * cornerNumber(x0 ^ y0 ^ z0) + i.b * cornerNumber(x1 ^ y0 ^ z0)) +
                     j.b * (i.a * cornerNumber(x0 ^ y1 ^ z0) + i.b * cornerNumber(x1 ^ y1 ^ z0));
  const float far = j.a * (i.a * cornerNumber(x0 ^ y0 ^ z1) + i.b * cornerNumber(x1 ^ y0 ^ z1)) +
                    j.b * (i.a * cornerNumber(x0 ^ y1 ^ z1) + i.b * cornerNumber(x1 ^ y1 ^ z1));
  return (k.a * near + k.b * far) * 0.0067659F;             // 1 / √21845
}

}  // namespace standpoint::value_noise

namespace standpoint {

// One place of variation() in surface_texture.h.
STANDPOINT_INLINE float textureFactor(float x_m, float y_m, float z_m, float coefficient, float scale_m) {
  constexpr float kCellsPerLength = 0.85F;   // makes the blend's correlation 1/e at the length
  constexpr float kWeathering = 0.8F;        // weights of the octaves; their squares add up to 1
  constexpr float kGrain = 0.6F;
  const float cells_per_m = kCellsPerLength / (scale_m > 0 ? scale_m : 1.0F);
  const float cv = scale_m > 0 ? coefficient : 0.0F;
  // Turned against the axes of buildings, so that walls do not run along the grid.
  const float x = cells_per_m * (0.36F * x_m + 0.48F * y_m - 0.8F * z_m);
  const float y = cells_per_m * (-0.8F * x_m + 0.6F * y_m);
  const float z = cells_per_m * (0.48F * x_m + 0.64F * y_m + 0.6F * z_m);
  const float weathering = value_noise::field(x, y, z, 0x3C6EF372U);
  const float grain = value_noise::field(10 * x, 10 * y, 10 * z, 0xDAA66D2BU);
  const float exponent = cv * (kWeathering * weathering + kGrain * grain) - cv * cv / 2;
  return portable::exp2(1.4426950408889634F * exponent);   // 1 / ln 2
}

}  // namespace standpoint
