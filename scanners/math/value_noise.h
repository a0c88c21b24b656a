// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>

#include "core/portable_math.h"

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

constexpr float kShift = 0x1.8p23F;  // adding it rounds to a whole number
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
  std::memcpy(&corner, &shifted, sizeof corner);  // counts in ones there; where it begins does not matter
  const float t = bounded - (shifted - kShift);   // from the middle of the cell, -1/2 to 1/2
  const float u = t * (1.5F - 2 * t * t) * 1.5707963267948966F;  // smooth at the corners
  const float q = u * u;
  const float sine = u * (1 - q * (1.0F / 6) * (1 - q * (1.0F / 20) * (1 - q * (1.0F / 42))));
  const float cosine = 1 - q * 0.5F * (1 - q * (1.0F / 12) * (1 - q * (1.0F / 30)));
  return {corner, 0.70710678118654752F * (cosine - sine), 0.70710678118654752F * (cosine + sine)};
}

// The numbers of a cell's corners: x first, then y, then z.
struct Corners {
  float number[8];
};
STANDPOINT_INLINE Corners cornersOf(std::int32_t i, std::int32_t j, std::int32_t k, std::uint32_t salt) {
  const std::uint32_t x0 = static_cast<std::uint32_t>(i) * 0x8DA6B343U + salt, x1 = x0 + 0x8DA6B343U;
  const std::uint32_t y0 = static_cast<std::uint32_t>(j) * 0xD8163841U, y1 = y0 + 0xD8163841U;
  const std::uint32_t z0 = static_cast<std::uint32_t>(k) * 0xCB1AB31FU, z1 = z0 + 0xCB1AB31FU;
  return {{cornerNumber(x0 ^ y0 ^ z0), cornerNumber(x1 ^ y0 ^ z0), cornerNumber(x0 ^ y1 ^ z0),
           cornerNumber(x1 ^ y1 ^ z0), cornerNumber(x0 ^ y0 ^ z1), cornerNumber(x1 ^ y0 ^ z1),
           cornerNumber(x0 ^ y1 ^ z1), cornerNumber(x1 ^ y1 ^ z1)}};
}

STANDPOINT_INLINE float blend(const Corners& c, const Axis& i, const Axis& j, const Axis& k) {
  const float near = j.a * (i.a * c.number[0] + i.b * c.number[1]) + j.b * (i.a * c.number[2] + i.b * c.number[3]);
  const float far = j.a * (i.a * c.number[4] + i.b * c.number[5]) + j.b * (i.a * c.number[6] + i.b * c.number[7]);
  return (k.a * near + k.b * far) * 0.0067659F;  // 1 / √21845
}

// Zero mean, unit variance; the field's cells are 1 wide. Of many places, which mostly lie in one cell: then its
// corners are worked out once.
template <int kLanes>
STANDPOINT_INLINE void fieldLanes(const float* x, const float* y, const float* z, std::uint32_t salt, float* values) {
  std::int32_t corner[3][kLanes];
  float a[3][kLanes], b[3][kLanes];
  const float* const places[3] = {x, y, z};
  for (int axis = 0; axis < 3; ++axis)
    for (int n = 0; n < kLanes; ++n) {
      const Axis at = axisAt(places[axis][n]);
      corner[axis][n] = at.corner, a[axis][n] = at.a, b[axis][n] = at.b;
    }
  std::int32_t apart = 0;
  for (int n = 0; n < kLanes; ++n)
    apart |= (corner[0][n] ^ corner[0][0]) | (corner[1][n] ^ corner[1][0]) | (corner[2][n] ^ corner[2][0]);
  if (apart == 0) {
    const Corners shared = cornersOf(corner[0][0], corner[1][0], corner[2][0], salt);
    for (int n = 0; n < kLanes; ++n)
      values[n] = blend(shared, {0, a[0][n], b[0][n]}, {0, a[1][n], b[1][n]}, {0, a[2][n], b[2][n]});
    return;
  }
  for (int n = 0; n < kLanes; ++n)
    values[n] = blend(cornersOf(corner[0][n], corner[1][n], corner[2][n], salt), {0, a[0][n], b[0][n]},
                      {0, a[1][n], b[1][n]}, {0, a[2][n], b[2][n]});
}

}  // namespace standpoint::value_noise

namespace standpoint {

// variation() in surface_texture.h.
template <int kLanes>
STANDPOINT_INLINE void textureFactors(const float* x_m, const float* y_m, const float* z_m, const float* coefficient,
                                      const float* scale_m, float* factor) {
  constexpr float kCellsPerLength = 0.85F;  // makes the blend's correlation 1/e at the length
  constexpr float kWeathering = 0.8F;       // weights of the octaves; their squares add up to 1
  constexpr float kGrain = 0.6F;
  float x[kLanes], y[kLanes], z[kLanes], weathering[kLanes], grain[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    const float cells_per_m = kCellsPerLength / (scale_m[k] > 0 ? scale_m[k] : 1.0F);
    // Turned against the axes of buildings, so that walls do not run along the grid.
    x[k] = cells_per_m * (0.36F * x_m[k] + 0.48F * y_m[k] - 0.8F * z_m[k]);
    y[k] = cells_per_m * (-0.8F * x_m[k] + 0.6F * y_m[k]);
    z[k] = cells_per_m * (0.48F * x_m[k] + 0.64F * y_m[k] + 0.6F * z_m[k]);
  }
  value_noise::fieldLanes<kLanes>(x, y, z, 0x3C6EF372U, weathering);
  for (int k = 0; k < kLanes; ++k) x[k] *= 10, y[k] *= 10, z[k] *= 10;
  value_noise::fieldLanes<kLanes>(x, y, z, 0xDAA66D2BU, grain);
  for (int k = 0; k < kLanes; ++k) {
    const float cv = scale_m[k] > 0 ? coefficient[k] : 0.0F;
    const float exponent = cv * (kWeathering * weathering[k] + kGrain * grain[k]) - cv * cv / 2;
    factor[k] = portable::exp2(1.4426950408889634F * exponent);  // 1 / ln 2
  }
}

}  // namespace standpoint
