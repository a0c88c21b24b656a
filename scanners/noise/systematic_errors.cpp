// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/noise/systematic_errors.h"

#include <cmath>

#include "core/portable_math.h"
#include "scanners/noise/pulse_noise.h"

namespace standpoint {

namespace {

constexpr double kFurtherFraction = 1.0 / 3;  // of a0

}  // namespace

SystematicErrors SystematicErrors::drawn(const Instrument& instrument, const RandomKey& key) {
  PulseNoise draw;
  pulseNoise(key, 0, 0, NoiseChannel::scan, draw);
  SystematicErrors errors;
  const bool cyclic = instrument.waveform.fine_wavelength_m > 0;
  const double further = kFurtherFraction * instrument.range_bias_m;
  const double offset =
      cyclic ? std::sqrt(1 - kFurtherFraction * kFurtherFraction) * instrument.range_bias_m : instrument.range_bias_m;
  errors.offset_m = offset * static_cast<double>(draw.range[0]);
  errors.scale = 1 + 1e-6 * instrument.range_bias_ppm * static_cast<double>(draw.detection[0]);
  errors.lift_m = further * static_cast<double>(draw.range[1]);
  if (cyclic) {
    errors.cycle_m = instrument.waveform.fine_wavelength_m;
    errors.cyclic_sine_m = further * static_cast<double>(draw.range[2]);
    errors.cyclic_cosine_m = further * static_cast<double>(draw.range[3]);
  }
  const double each = std::sqrt((instrument.angle_sigma_rad * instrument.angle_sigma_rad -
                                 instrument.angle_jitter_rad * instrument.angle_jitter_rad) /
                                3);
  errors.collimation_rad = each * static_cast<double>(draw.lateral[0]);
  errors.trunnion_rad = each * static_cast<double>(draw.lateral[1]);
  errors.index_rad = each * static_cast<double>(draw.elevation[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    errors.azimuth_rad[k] = each * static_cast<double>(draw.lateral[k + 2]);
    errors.elevation_rad[k] = each * static_cast<double>(draw.elevation[k + 1]);
  }
  return errors;
}

double SystematicErrors::cyclic_m(double range_m) const {
  if (cycle_m <= 0) return 0;
  const double turns = range_m / cycle_m;
  float sine, cosine;
  portable::sinCosTurn(static_cast<float>(turns - std::floor(turns)), sine, cosine);
  return cyclic_sine_m * static_cast<double>(sine) + cyclic_cosine_m * static_cast<double>(cosine);
}

double SystematicErrors::azimuthError_rad(double hz_rad) const {
  return azimuth_rad[0] * std::sin(hz_rad) + azimuth_rad[1] * std::cos(hz_rad) + azimuth_rad[2] * std::sin(2 * hz_rad) +
         azimuth_rad[3] * std::cos(2 * hz_rad);
}

double SystematicErrors::elevationError_rad(double face, double sine_v, double cosine_v) const {
  return face * index_rad + elevation_rad[0] * cosine_v + elevation_rad[1] * sine_v +
         elevation_rad[2] * (1 - 2 * sine_v * sine_v) + elevation_rad[3] * 2 * sine_v * cosine_v;
}

}  // namespace standpoint
