// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/signal_lanes.h"

#include <cmath>
#include <numbers>

#include "scanners/portable_math.h"
#include "scanners/target_clones.h"

namespace standpoint {

namespace {

STANDPOINT_INLINE void reflect(SignalLanes& lanes) {
  for (int k = 0; k < kSignalLanes; ++k) {
    const float cosine = lanes.cosine[k] > 1e-4F ? lanes.cosine[k] : 1e-4F;
    const float square = cosine * cosine;
    const float tail = (1 - square) / square * lanes.steepness[k];                // tan²θ / m²
    const float kept = tail < 40 ? tail : 40;
    const float lobe = lanes.glint[k] * portable::exp2(-1.4426950408889634F * kept) / (square * square * cosine);
    lanes.equivalent[k] = lanes.diffuse[k] * (lanes.oren_a[k] * cosine + lanes.oren_b[k] * (1 - square)) + (tail < 40 ? lobe : 0);
  }
}

STANDPOINT_INLINE void power(SignalLanes& lanes, float near_range, int exponent, float decay) {
  float ratio[kSignalLanes], blur[kSignalLanes];
  for (int k = 0; k < kSignalLanes; ++k) {
    ratio[k] = near_range / lanes.range_m[k];
    blur[k] = 1;
  }
  for (int n = 0; n < exponent; ++n)
    for (int k = 0; k < kSignalLanes; ++k) blur[k] *= ratio[k];
  for (int k = 0; k < kSignalLanes; ++k) {
    const float loss = decay * lanes.range_m[k];
    const float air = portable::exp2(loss > -100 ? loss : -100);
    const float near = air / (1 + blur[k]);
    const float one = lanes.equivalent[k] * lanes.gain[k] * near / (lanes.range_m[k] * lanes.range_m[k]);
    const float x = (lanes.known_x[k] < 0 ? one : lanes.known_x[k]) * lanes.variation[k];
    lanes.x[k] = x > 1e-30F ? x : 1e-30F;
  }
}

STANDPOINT_INLINE void store(SignalLanes& lanes, float low_db, float high_db, float steps) {
  for (int k = 0; k < kSignalLanes; ++k) {
    const float share = (3.0102999566398120F * portable::log2(lanes.x[k]) - low_db) / (high_db - low_db);
    const float least = share < 0 ? 0 : share;
    lanes.intensity[k] = least > 1 ? 1 : least;
  }
  if (steps > 0)
    for (int k = 0; k < kSignalLanes; ++k)
      lanes.intensity[k] = static_cast<float>(static_cast<std::int32_t>(lanes.intensity[k] * steps + 0.5F)) / steps;
}

STANDPOINT_INLINE void noise(SignalLanes& lanes, const RangeNoiseLaw::Curve* curves, int count) {
  float place[kSignalLanes] = {};
  if (count > 1)   // one curve is that of every reflectivity
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

STANDPOINT_CLONES void receiveLanes(SignalLanes& lanes, const Receiver& receiver) {
  reflect(lanes);
  power(lanes, receiver.near_range_m, receiver.near_range_power, receiver.decay_per_m);
  store(lanes, receiver.low_db, receiver.high_db, receiver.levels);
  noise(lanes, receiver.curves, receiver.curve_count);
}

}  // namespace

Receiver receiverOf(const Instrument& instrument, const RangeNoiseLaw& law, Effects effects, double extinction_per_m) {
  Receiver receiver;
  receiver.near_range_m = effects.has(Effect::near_range) ? static_cast<float>(instrument.near_range_m) : 0;
  receiver.near_range_power = instrument.near_range_power;
  receiver.decay_per_m = static_cast<float>(-2 * extinction_per_m / std::numbers::ln2);
  receiver.low_db = static_cast<float>(instrument.intensity_low_db);
  receiver.high_db = static_cast<float>(instrument.intensity_high_db);
  receiver.levels = effects.has(Effect::quantisation) ? static_cast<float>(instrument.intensity_levels - 1) : 0;
  receiver.curves = law.curves().data();
  receiver.curve_count = static_cast<int>(law.curves().size());
  return receiver;
}

void receive(SignalLanes& lanes, const Receiver& receiver) { receiveLanes(lanes, receiver); }

}  // namespace standpoint
