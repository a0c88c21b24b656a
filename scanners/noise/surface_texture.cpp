// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/surface_texture.h"

#include <algorithm>

#include "scanners/math/target_clones.h"
#include "scanners/math/value_noise.h"

namespace standpoint {

STANDPOINT_CLONES void variation(const float* x_m, const float* y_m, const float* z_m, const float* coefficient,
                                 const float* scale_m, float* factor) {
  float result[kTextureLanes];
  textureFactors<kTextureLanes>(x_m, y_m, z_m, coefficient, scale_m, result);
  std::copy(result, result + kTextureLanes, factor);
}

}  // namespace standpoint
