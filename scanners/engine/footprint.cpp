// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/footprint.h"

#include "scanners/math/portable_math.h"

namespace standpoint {

namespace {

SubRay onRing(double fraction, int place, int places, float weight) {
  float sine, cosine;
  portable::sinCosTurn(static_cast<float>(place) / static_cast<float>(places), sine, cosine);
  return {cosine, sine, fraction, weight};
}

std::array<SubRay, kSubRays> pattern() {
  constexpr float kOuter = 0.0339F, kInner = 0.0841F;
  std::array<SubRay, kSubRays> rays{};
  for (int k = 0; k < 6; ++k) {
    rays[k] = onRing(kOuterFraction, 2 * k, 12, kOuter);
    rays[6 + k] = onRing(kOuterFraction, 2 * k + 1, 12, kOuter);
    rays[12 + k] = onRing(0.4, k, 6, kInner);
  }
  return rays;
}

}  // namespace

const std::array<SubRay, kSubRays>& subRays() {
  static const std::array<SubRay, kSubRays> kRays = pattern();
  return kRays;
}

}  // namespace standpoint
