// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/radiometry/signal_lanes.h"

#include <cmath>
#include <numbers>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

constexpr float kLeastPower = 1e-30F;  // its logarithm can be taken

template <class Is>
STANDPOINT_INLINE bool none(const float* values, Is is) {
  std::int32_t any = 0;
  for (int k = 0; k < kSignalLanes; ++k) any |= static_cast<std::int32_t>(is(values[k]));
  return any == 0;
}

STANDPOINT_INLINE void fill(float* values, float value) {
  for (int k = 0; k < kSignalLanes; ++k) values[k] = value;
}

// Without a lobe, as most surfaces are.
STANDPOINT_INLINE void reflectMatt(SignalLanes& lanes) {
  for (int k = 0; k < kSignalLanes; ++k) {
    const float cosine = lanes.cosine[k] > 1e-4F ? lanes.cosine[k] : 1e-4F;
    lanes.equivalent[k] = lanes.diffuse[k] * (cosine + lanes.roughness[k] * (1 - cosine * cosine));
  }
}

STANDPOINT_INLINE void reflect(SignalLanes& lanes) {
  if (none(lanes.glint, [](float glint) { return glint > 0; })) return reflectMatt(lanes);
  for (int k = 0; k < kSignalLanes; ++k) {
    const float cosine = lanes.cosine[k] > 1e-4F ? lanes.cosine[k] : 1e-4F;
    const float square = cosine * cosine;
    const float tail = (1 - square) / square * lanes.steepness[k];  // tan²θ / m²
    const float kept = tail < 40 ? tail : 40;
    const float lobe = lanes.glint[k] * portable::exp2(-1.4426950408889634F * kept) / (square * square * cosine);
    lanes.equivalent[k] = lanes.diffuse[k] * (cosine + lanes.roughness[k] * (1 - square)) + (tail < 40 ? lobe : 0);
  }
}

// η_opt(R).
STANDPOINT_INLINE void nearRange(const SignalLanes& lanes, const Receiver& receiver, float* near) {
  if (receiver.near_curve_below_m > 0) {
    const float below = receiver.near_curve_below_m;
    if (none(lanes.range_m, [below](float range) { return range < below; })) return fill(near, 1);
    const float c0 = receiver.near_curve[0], c1 = receiver.near_curve[1], c2 = receiver.near_curve[2],
                c3 = receiver.near_curve[3];
    for (int k = 0; k < kSignalLanes; ++k) {
      const float range = lanes.range_m[k] < below ? lanes.range_m[k] : below;
      const float power = c0 + range * (c1 + range * (c2 + range * c3)) + 2 * portable::log2(range);
      const float kept = power > -100 ? power : -100;
      const float factor = portable::exp2(kept < 0 ? kept : 0);
      near[k] = lanes.range_m[k] < below ? factor : 1;
    }
    return;
  }
  float ratio[kSignalLanes], blur[kSignalLanes];
  for (int k = 0; k < kSignalLanes; ++k) {
    ratio[k] = receiver.near_range_m / lanes.range_m[k];
    blur[k] = 1;
  }
  for (int n = 0; n < receiver.near_range_power; ++n)
    for (int k = 0; k < kSignalLanes; ++k) blur[k] *= ratio[k];
  for (int k = 0; k < kSignalLanes; ++k) near[k] = 1 / (1 + blur[k]);
}

STANDPOINT_INLINE void power(SignalLanes& lanes, const Receiver& receiver) {
  float near[kSignalLanes];
  nearRange(lanes, receiver, near);
  const float decay = receiver.decay_per_m;
  for (int k = 0; k < kSignalLanes; ++k) {
    const float loss = decay * lanes.range_m[k];
    const float air = portable::exp2(loss > -100 ? loss : -100);
    const float one = lanes.equivalent[k] * lanes.gain[k] * (air * near[k]) / (lanes.range_m[k] * lanes.range_m[k]);
    const float x = (lanes.known_x[k] < 0 ? one : lanes.known_x[k]) * lanes.variation[k];
    lanes.x[k] = x > kLeastPower ? x : kLeastPower;
  }
}

// What is measured of x: it never falls to nothing, for a pulse that is not there is not measured.
STANDPOINT_INLINE void fluctuate(const SignalLanes& lanes, const Fluctuation& f, const float* inverse_x,
                                 float* measured) {
  for (int k = 0; k < kSignalLanes; ++k) measured[k] = lanes.x[k];
  if (!f.any) return;
  const float jitter2 = f.jitter2, speckle2 = f.speckle2, grains = f.grains, exit2 = f.exit2_m2, spread2 = f.spread2;
  const float dark2 = f.dark * f.dark;
  for (int k = 0; k < kSignalLanes; ++k) {
    const float spot2 = exit2 / (lanes.range_m[k] * lanes.range_m[k]) + spread2;
    const float variance =
        jitter2 + speckle2 / (1 + grains * spot2) + dark2 * (1 + lanes.background[k]) * (inverse_x[k] * inverse_x[k]);
    const float factor = 1 + lanes.fluctuation[k] * std::sqrt(variance);
    measured[k] = lanes.x[k] * (factor > 0.05F ? factor : 0.05F);
  }
}

STANDPOINT_INLINE void store(SignalLanes& lanes, const float* measured, float low_db, float high_db, float steps) {
  const float scale = 1 / (high_db - low_db);
  for (int k = 0; k < kSignalLanes; ++k) {
    const float fraction = (3.0102999566398120F * portable::log2(measured[k]) - low_db) * scale;
    const float least = fraction < 0 ? 0 : fraction;
    lanes.intensity[k] = least > 1 ? 1 : least;
  }
  if (steps > 0)
    for (int k = 0; k < kSignalLanes; ++k)
      lanes.intensity[k] = static_cast<float>(static_cast<std::int32_t>(lanes.intensity[k] * steps + 0.5F)) / steps;
}

STANDPOINT_INLINE void noise(SignalLanes& lanes, const Receiver& receiver, const float* inverse_x) {
  const float floor = receiver.noise_floor_m2, shot = receiver.noise_shot_m2, amplifier = receiver.noise_amplifier_m2;
  for (int k = 0; k < kSignalLanes; ++k)
    lanes.sigma_m[k] = std::sqrt(floor + (1 + lanes.background[k]) * (shot + amplifier * inverse_x[k]) * inverse_x[k]);
}

STANDPOINT_INLINE void slant(SignalLanes& lanes, const Fluctuation& f) {
  if (!f.slants) return fill(lanes.spread_m, 0);
  constexpr float kLeastCosine = 0.01F;
  const float speckle2 = f.speckle2, grains = f.grains, exit2 = f.exit2_m2, spread2 = f.spread2;
  for (int k = 0; k < kSignalLanes; ++k) {
    const float cosine = lanes.cosine[k] > kLeastCosine ? lanes.cosine[k] : kLeastCosine;
    const float square = cosine * cosine, range2 = lanes.range_m[k] * lanes.range_m[k];
    const float tangent2 = square < 1 ? (1 - square) / square : 0;
    const float spot2 = exit2 + spread2 * range2;
    lanes.spread_m[k] = std::sqrt(spot2 * tangent2 * (1.0F / 32) * speckle2 * range2 / (range2 + grains * spot2));
  }
}

STANDPOINT_CLONES void receiveLanes(SignalLanes& lanes, const Receiver& receiver) {
  reflect(lanes);
  power(lanes, receiver);
  float measured[kSignalLanes], inverse_x[kSignalLanes];
  for (int k = 0; k < kSignalLanes; ++k) inverse_x[k] = 1 / (lanes.x[k] > 1e-12F ? lanes.x[k] : 1e-12F);
  fluctuate(lanes, receiver.fluctuation, inverse_x, measured);
  store(lanes, measured, receiver.low_db, receiver.high_db, receiver.levels);
  noise(lanes, receiver, inverse_x);
  slant(lanes, receiver.fluctuation);
}

STANDPOINT_CLONES void powerLanes(SignalLanes& lanes, const Receiver& receiver, float* x) {
  reflect(lanes);
  power(lanes, receiver);
  for (int k = 0; k < kSignalLanes; ++k) x[k] = lanes.x[k] > kLeastPower ? lanes.x[k] : 0;
}

}  // namespace

Receiver receiverOf(const Instrument& instrument, Effects effects, double extinction_per_m) {
  Receiver receiver;
  receiver.near_range_m = effects.has(Effect::near_range) ? static_cast<float>(instrument.near_range_m) : 0;
  receiver.near_range_power = instrument.near_range_power;
  if (effects.has(Effect::near_range)) {
    receiver.near_curve_below_m = static_cast<float>(instrument.near_range_curve.below_m);
    receiver.near_curve = nearRangePolynomial(instrument.near_range_curve);
  }
  receiver.decay_per_m = static_cast<float>(-2 * extinction_per_m / std::numbers::ln2);
  receiver.low_db = static_cast<float>(instrument.intensity_low_db);
  receiver.high_db = static_cast<float>(instrument.intensity_high_db);
  receiver.levels = effects.has(Effect::quantisation) ? static_cast<float>(instrument.intensity_levels - 1) : 0;
  const auto noise = rangeNoiseParts(instrument);
  receiver.noise_floor_m2 = static_cast<float>(noise.floor_m2);
  receiver.noise_shot_m2 = static_cast<float>(noise.shot_m2);
  receiver.noise_amplifier_m2 = static_cast<float>(noise.amplifier_m2);
  return receiver;
}

Fluctuation fluctuationOf(const Instrument& instrument, Effects effects, double dark, int passes) {
  Fluctuation f;
  f.any = effects.has(Effect::amplitude_noise);
  f.slants = effects.has(Effect::incidence_noise);
  const double average = 1.0 / passes, quarter_pi = std::numbers::pi / 4;
  const double grains = quarter_pi * instrument.amplitude.aperture_m / (1e-9 * instrument.wavelength_nm);
  f.jitter2 = static_cast<float>(average * instrument.amplitude.jitter * instrument.amplitude.jitter);
  f.speckle2 = static_cast<float>(average / 2);
  f.grains = static_cast<float>(grains * grains);
  f.exit2_m2 = static_cast<float>(instrument.exit_diameter_m * instrument.exit_diameter_m);
  f.spread2 = static_cast<float>(instrument.divergence_rad * instrument.divergence_rad);
  f.dark = static_cast<float>(dark);
  return f;
}

double slantSpread_m(const Fluctuation& fluctuation, double range_m, double cosine) {
  SignalLanes lanes{};
  fill(lanes.range_m, static_cast<float>(range_m));
  fill(lanes.cosine, static_cast<float>(cosine));
  slant(lanes, fluctuation);
  return static_cast<double>(lanes.spread_m[0]);
}

void receive(SignalLanes& lanes, const Receiver& receiver) { receiveLanes(lanes, receiver); }
void receivePower(SignalLanes& lanes, const Receiver& receiver, float* x) { powerLanes(lanes, receiver, x); }

}  // namespace standpoint
