// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/footprint.h"

#include "core/portable_math.h"
#include "core/random.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// Of the spiral that sunflowers have: each ray the golden angle on from the one before.
struct Spiral {
  float cosine[kReferenceSubRays], sine[kReferenceSubRays];
  Spiral() {
    for (int k = 0; k < kReferenceSubRays; ++k) {
      const double turns = k * kGoldenTurns;
      portable::sinCosTurn(static_cast<float>(turns - std::floor(turns)), sine[k], cosine[k]);
    }
  }
};

// `spread`: the density of the rays falls as exp(-spread r²); it differs, so that weights do and shares are no steps.
STANDPOINT_CLONES void place(const Spiral& spiral, float spread, float shift, float cosine, float sine, int count,
                             float* across, float* upward, float* weight) {
  constexpr float kPerNeper = 1.4426950408889634F;  // 1 / ln 2
  const float within = 1 - portable::exp2(-kPerNeper * static_cast<float>(kBeamEdge * kBeamEdge) * spread);
  const float per_ray = within / static_cast<float>(count), exponent = (2 - spread) / spread;
  for (int k = 0; k < count; ++k) {
    const float octaves = portable::log2(1 - per_ray * (static_cast<float>(k) + shift));  // of the density
    const float radius = std::sqrt(-octaves / (kPerNeper * spread));
    across[k] = radius * (cosine * spiral.cosine[k] - sine * spiral.sine[k]);
    upward[k] = radius * (sine * spiral.cosine[k] + cosine * spiral.sine[k]);
    weight[k] = portable::exp2(exponent * octaves);
  }
}

}  // namespace

void drawFootprint(const std::array<std::uint32_t, 4>& draw, int count, SubRay* rays) {
  static const Spiral kSpiral;
  float sine, cosine, across[kReferenceSubRays], upward[kReferenceSubRays], weight[kReferenceSubRays];
  portable::sinCosTurn(static_cast<float>(uniform(draw[0])), sine, cosine);
  // Of 24 bits, so that it stays below 1 as a float.
  const float shift = (static_cast<float>(draw[1] >> 8U) + 0.5F) * 0x1p-24F;
  place(kSpiral, static_cast<float>(0.5 + uniform(draw[2])), shift, cosine, sine, count, across, upward, weight);
  float whole = 0;
  for (int k = 0; k < count; ++k) whole += weight[k];
  for (int k = 0; k < count; ++k)
    rays[k] = {static_cast<double>(across[k]), static_cast<double>(upward[k]), weight[k] / whole};
}

}  // namespace standpoint
