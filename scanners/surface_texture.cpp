// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/surface_texture.h"

#include <algorithm>

#include "scanners/target_clones.h"
#include "scanners/value_noise.h"

namespace standpoint {

STANDPOINT_CLONES void variation(const float* x_m, const float* y_m, const float* z_m, const float* coefficient,
                                 const float* scale_m, float* factor) {
  float result[kTextureLanes];
  for (int k = 0; k < kTextureLanes; ++k) result[k] = textureFactor(x_m[k], y_m[k], z_m[k], coefficient[k], scale_m[k]);
  std::copy(result, result + kTextureLanes, factor);
}

}  // namespace standpoint
