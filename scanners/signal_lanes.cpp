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
  }
}

STANDPOINT_INLINE void store(SignalLanes& lanes, float low_db, float high_db, float steps) {
  for (int k = 0; k < kSignalLanes; ++k) {
    const float share = (3.0102999566398120F * portable::log2(lanes.x[k]) - low_db) / (high_db - low_db);
    const float least = share < 0 ? 0 : share;
    const float clipped = least > 1 ? 1 : least;
    lanes.intensity[k] = static_cast<float>(static_cast<std::int32_t>(clipped * steps + 0.5F)) / steps;
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

// The instrument's figures as the lanes need them.
struct Receiver {
  float near_range, low_db, high_db, steps;
  int exponent, curve_count;
  const RangeNoiseLaw::Curve* curves;
};

STANDPOINT_CLONES void receiveLanes(SignalLanes& lanes, const Receiver& receiver) {
  power(lanes, receiver.near_range, receiver.exponent);
  store(lanes, receiver.low_db, receiver.high_db, receiver.steps);
  noise(lanes, receiver.curves, receiver.curve_count);
}

}  // namespace

void receive(SignalLanes& lanes, const Instrument& instrument, const RangeNoiseLaw& law) {
  receiveLanes(lanes, {static_cast<float>(instrument.near_range_m), static_cast<float>(instrument.intensity_low_db),
                       static_cast<float>(instrument.intensity_high_db), static_cast<float>(instrument.intensity_levels - 1),
                       instrument.near_range_power, static_cast<int>(law.curves().size()), law.curves().data()});
}

}  // namespace standpoint
