// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace standpoint {

constexpr int kTextureLanes = 16;

// How the reflectance of one surface varies about its material's (physics.md §2.9): exp(CV g - CV²/2) with g a field of
// zero mean and unit variance over the position in the local frame, in two octaves: weathering, whose correlation falls
// to 1/e at `scale_m`, and grain at a tenth of it. The same place always has the same factor, whoever looks. A scale or
// a coefficient of 0 varies nothing. Sixteen places at a time, the same bits in registers of any width.
void variation(const float* x_m, const float* y_m, const float* z_m, const float* coefficient, const float* scale_m,
               float* factor);

// How one surface differs from another of its material: exp(σ g - σ²/2), with g of zero mean and unit variance, nearly
// normal, that belongs to the key alone.
float surfaceFactor(std::uint64_t key, float spread);

}  // namespace standpoint
