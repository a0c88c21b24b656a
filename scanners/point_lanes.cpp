// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/point_lanes.h"

#include <algorithm>
#include <numbers>

#include "scanners/portable_math.h"
#include "scanners/surface_texture.h"
#include "scanners/target_clones.h"

namespace standpoint {

namespace {

Pose relative(const Pose& from, const Pose& to) {
  const Eigen::Quaterniond back = from.rotation.conjugate();
  return {back * to.rotation, back * (to.translation - from.translation)};
}

// Lateral and lift are to first order, which at 60 arcsec and 100 m is right to 4 µm.
STANDPOINT_CLONES void place(const PointLanes::Figures& f, ReturnLanes& r) {
  for (int k = 0; k < kReturnLanes; ++k) {
    const double cosine = r.cosine[k], sine = r.sine[k];
    const auto wobble = static_cast<double>(r.wobble[k]);
    const double lateral =
        f.jitter_rad * static_cast<double>(r.noise.lateral[k]) + f.lateral_rad + f.azimuth_rad * cosine;
    const double lift =
        f.jitter_rad * static_cast<double>(r.noise.elevation[k]) + f.lift_rad + f.lift_by_wobble_rad * wobble;
    const double noise = f.white_share * static_cast<double>(r.noise.range[k]) +
                         f.along_share * static_cast<double>(r.along[k]) + f.common;
    const double over = static_cast<double>(portable::log2(r.signal.x[k] / f.saturation));
    const double walk = r.signal.x[k] > f.saturation ? f.walk_m_per_octave * over : 0;
    const double range = r.range_m[k] * f.scale + f.bias_m +
                         f.noise_scale * static_cast<double>(r.signal.sigma_m[k]) * noise + f.extra_m +
                         f.wobble_m * wobble + walk;
    const double outward = cosine - lift * sine;
    r.x_m[k] = static_cast<float>(range * (outward * f.ahead_x + lateral * f.lateral_x));
    r.y_m[k] = static_cast<float>(range * (outward * f.ahead_y + lateral * f.lateral_y));
    r.z_m[k] = static_cast<float>(range * (sine + lift * cosine));
  }
}

}  // namespace

PointLanes::PointLanes(const ScanPlan& plan) : plan_(plan), start_(at(plan.trajectory, 0)) {
  if (plan.column_noise) along_.resize(plan.column_noise->paddedRows());
  figures_.jitter_rad = plan.jitter_rad;
  figures_.scale = plan.bias.scale;
  figures_.bias_m = plan.bias.range_m;
  figures_.noise_scale = plan.noise_scale;
  figures_.white_share = plan.white_share;
  figures_.saturation = plan.saturation;
  figures_.walk_m_per_octave = plan.instrument.saturation.walk_m_per_decade * std::numbers::ln2 / std::numbers::ln10;
  if (!plan.column_noise) return;
  figures_.along_share = static_cast<double>(plan.column_noise->along());
  figures_.lift_by_wobble_rad = plan.instrument.correlated.elevation_wobble_rad;
  figures_.wobble_m = plan.instrument.correlated.wobble_m;
}

void PointLanes::begin(std::uint32_t column, const Eigen::Vector3d& ahead, const Eigen::Vector3d& lateral) {
  column_ = column;
  const double face = plan_.clock.behind(column) ? -1 : 1;
  figures_.ahead_x = ahead.x(), figures_.ahead_y = ahead.y();
  figures_.lateral_x = lateral.x(), figures_.lateral_y = lateral.y();
  figures_.lateral_rad = face * plan_.bias.collimation_rad;
  figures_.lift_rad = face * plan_.bias.index_rad;
  if (!plan_.column_noise) return;
  plan_.column_noise->along(column, along_.data());
  const ColumnNoise::Column& noise = plan_.column_noise->column(column);
  figures_.azimuth_rad = static_cast<double>(noise.azimuth_rad);
  figures_.common = static_cast<double>(plan_.column_noise->common() * noise.common);
  figures_.extra_m = plan_.instrument.correlated.column_extra_m * static_cast<double>(noise.extra);
}

void PointLanes::drawRows(std::uint32_t first_row, ReturnLanes& returns) const {
  const RandomKey key{plan_.options.seed, plan_.options.station_key};
  pulseNoise(key, column_, first_row, NoiseChannel::pulse, returns.noise);
  if (!plan_.column_noise) return;
  std::copy_n(along_.data() + first_row, kReturnLanes, returns.along);
  plan_.column_noise->wobble(column_, first_row, returns.wobble);
}

void PointLanes::drawFurther(const ReturnLanes& first, int pulse, NoiseChannel channel, ReturnLanes& returns,
                             int lane) const {
  PulseNoise noise;
  pulseNoise({plan_.options.seed, plan_.options.station_key}, column_, first.row[0], channel, noise);
  returns.noise.range[lane] = noise.range[pulse];
  returns.noise.lateral[lane] = noise.lateral[pulse];
  returns.noise.elevation[lane] = noise.elevation[pulse];
  returns.noise.detection[lane] = noise.detection[pulse];
  returns.row[lane] = first.row[pulse];
  returns.cosine[lane] = first.cosine[pulse], returns.sine[lane] = first.sine[pulse];
  returns.along[lane] = first.along[pulse], returns.wobble[lane] = first.wobble[pulse];
}

std::uint32_t PointLanes::receive(ReturnLanes& returns, int count) const {
  if (plan_.varies)
    variation(returns.place_x, returns.place_y, returns.place_z, returns.variation, returns.texture_scale_m,
              returns.signal.variation);
  standpoint::receive(returns.signal, plan_.receiver);
  place(figures_, returns);
  if (plan_.moves()) moveBack(returns, count);
  return detected(returns, count);
}

// P_d = ½ erfc((x_min - x) / √2 σ), drawn (§2.7).
std::uint32_t PointLanes::detected(const ReturnLanes& returns, int count) const {
  std::uint32_t lanes = 0;
  for (int k = 0; k < count; ++k) {
    const double chance = plan_.softness > 0 ? plan_.softness * static_cast<double>(returns.noise.detection[k]) : 0;
    const bool seen = static_cast<double>(returns.signal.x[k]) + chance >= plan_.threshold;
    lanes |= static_cast<std::uint32_t>(seen) << static_cast<unsigned>(k);
  }
  return lanes;
}

void PointLanes::moveBack(ReturnLanes& returns, int count) const {
  for (int k = 0; k < count; ++k) {
    const double time = plan_.clock.time_s(column_, plan_.elevation_rad(returns.row[k]));
    const Eigen::Vector3d seen = Eigen::Vector3f(returns.x_m[k], returns.y_m[k], returns.z_m[k]).cast<double>();
    const Eigen::Vector3f point = (relative(start_, at(plan_.trajectory, time)) * seen).cast<float>();
    returns.x_m[k] = point.x(), returns.y_m[k] = point.y(), returns.z_m[k] = point.z();
  }
}

}  // namespace standpoint
