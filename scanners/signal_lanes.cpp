// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/signal_lanes.h"

#include <cmath>

#include "scanners/portable_math.h"
#include "scanners/target_clones.h"

namespace standpoint {

namespace {

STANDPOINT_INLINE void power(SignalLanes& lanes, float near_range, int exponent) {
  float ratio[kSignalLanes], blur[kSignalLanes];
  for (int k = 0; k < kSignalLanes; ++k) {
    ratio[k] = near_range / lanes.range_m[k];
    blur[k] = 1;
  }
  for (int n = 0; n < exponent; ++n)
    for (int k = 0; k < kSignalLanes; ++k) blur[k] *= ratio[k];
  for (int k = 0; k < kSignalLanes; ++k) {
    const float near = 1 / (1 + blur[k]);
    const float x = lanes.equivalent[k] * lanes.gain[k] * near / (lanes.range_m[k] * lanes.range_m[k]);
    lanes.x[k] = x > 1e-30F ? x : 1e-30F;
    lanes.log2_x[k] = portable::log2(lanes.x[k]);
  }
}

STANDPOINT_INLINE void noise(SignalLanes& lanes, const RangeNoiseLaw::Curve* curves, int count) {
  float place[kSignalLanes];
  for (int k = 0; k < kSignalLanes; ++k) place[k] = portable::log2(lanes.equivalent[k] > 1e-6F ? lanes.equivalent[k] : 1e-6F);
  for (int i = 0; i < count; ++i) {
    const float floor = curves[i].floor_m2;
    const float slope = curves[i].slope_m2;
    const float from = i > 0 ? curves[i - 1].log2_reflectivity : 0;
    const float scale = i > 0 ? 1 / (curves[i].log2_reflectivity - from) : 0;
    for (int k = 0; k < kSignalLanes; ++k) {
      const float sigma = std::sqrt(floor + slope / (lanes.x[k] * lanes.x[k]));
      const float share = (place[k] - from) * scale;
      const float least = share < 0 ? 0 : share;
      const float weight = i == 0 || least > 1 ? 1 : least;
      lanes.sigma_m[k] = i == 0 ? sigma : lanes.sigma_m[k] + weight * (sigma - lanes.sigma_m[k]);
    }
  }
}

STANDPOINT_CLONES void receiveLanes(SignalLanes& lanes, float near_range, int exponent, const RangeNoiseLaw::Curve* curves,
                                    int count) {
  power(lanes, near_range, exponent);
  noise(lanes, curves, count);
}

}  // namespace

void receive(SignalLanes& lanes, const Instrument& instrument, const RangeNoiseLaw& law) {
  receiveLanes(lanes, static_cast<float>(instrument.near_range_m), instrument.near_range_power, law.curves().data(),
               static_cast<int>(law.curves().size()));
}

}  // namespace standpoint
