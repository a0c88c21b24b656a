// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/point_lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"
#include "scanners/noise/surface_texture.h"

namespace standpoint {

namespace {

STANDPOINT_INLINE float risen(const PointLanes::Ramp& ramp, float octaves) {
  const float up = octaves - ramp.from;
  const float on = up > 0 ? up : 0;
  return ramp.slope * (on < ramp.width ? on : ramp.width);
}

// Lateral and lift are to first order, which at 60 arcsec and 100 m is right to 4 µm.
// `cyclic_m` is what of the range repeats.
STANDPOINT_CLONES void place(const PointLanes::Figures& f, const double* cyclic_m, ReturnLanes& r) {
  for (int k = 0; k < kReturnLanes; ++k) {
    const double cosine = r.cosine[k], sine = r.sine[k];
    const auto wobble = static_cast<double>(r.wobble[k]);
    const double lateral = f.jitter_rad * static_cast<double>(r.noise.lateral[k]) + f.lateral_rad +
                           f.trunnion_rad * sine + f.azimuth_rad * cosine;
    const double systematic = f.lift_rad + f.lift_cosine_rad * cosine + f.lift_sine_rad * sine +
                              f.lift_cosine2_rad * (1 - 2 * sine * sine) + f.lift_sine2_rad * 2 * sine * cosine;
    const double lift =
        f.jitter_rad * static_cast<double>(r.noise.elevation[k]) + systematic + f.lift_by_wobble_rad * wobble;
    const double sigma = f.noise_scale * static_cast<double>(r.signal.sigma_m[k]);
    const double white = f.white_fraction * sigma, spread = static_cast<double>(r.signal.spread_m[k]);
    const double noise = std::sqrt(white * white + spread * spread) * static_cast<double>(r.noise.range[k]) +
                         sigma * (f.along_fraction * static_cast<double>(r.along[k]) + f.common);
    const float octaves = portable::log2(r.signal.x[k]);
    const float offset = f.least_offset_m + risen(f.offset[0], octaves) + risen(f.offset[1], octaves) +
                         risen(f.offset[2], octaves) + risen(f.offset[3], octaves);
    const double range = r.range_m[k] * f.scale + f.bias_m + f.bias_sine_m * sine + cyclic_m[k] + noise + f.extra_m +
                         f.wobble_m * wobble + static_cast<double>(offset);
    const double outward = cosine - lift * sine;
    r.x_m[k] = static_cast<float>(range * (outward * f.ahead_x + lateral * f.lateral_x));
    r.y_m[k] = static_cast<float>(range * (outward * f.ahead_y + lateral * f.lateral_y));
    r.z_m[k] = static_cast<float>(range * (sine + lift * cosine));
  }
}

// `lit`: there is a background.
STANDPOINT_CLONES std::uint32_t detectedOf(const ReturnLanes& r, double softness, double threshold, bool lit) {
  std::uint64_t bits[kReturnLanes];
  double noise[kReturnLanes];
  for (int k = 0; k < kReturnLanes; ++k) noise[k] = 1;
  if (lit)
    for (int k = 0; k < kReturnLanes; ++k) noise[k] = std::sqrt(1 + static_cast<double>(r.signal.background[k]));
  for (int k = 0; k < kReturnLanes; ++k) {
    const double chance = softness * static_cast<double>(r.noise.detection[k]);
    const bool seen = static_cast<double>(r.signal.x[k]) + noise[k] * chance >= noise[k] * threshold;
    bits[k] = seen ? std::uint64_t{1} << static_cast<unsigned>(k) : 0;
  }
  std::uint64_t lanes = 0;
  for (int k = 0; k < kReturnLanes; ++k) lanes |= bits[k];
  return static_cast<std::uint32_t>(lanes);
}

// Whether any lane can be faulted at all: most sixteens hold plain surfaces of moderate power.
STANDPOINT_CLONES bool suspicious(const ReturnLanes& r, float weak, float saturation) {
  std::int32_t any = 0;
  for (int k = 0; k < kReturnLanes; ++k)
    any |= static_cast<std::int32_t>(r.deviation_m[k] > 0) | static_cast<std::int32_t>(r.signal.x[k] <= weak) |
           static_cast<std::int32_t>(r.signal.x[k] > saturation);
  return any != 0;
}

}  // namespace

PointLanes::PointLanes(const ScanPlan& plan) : plan_(plan) {
  if (plan.column_noise) along_.resize(plan.column_noise->paddedRows());
  figures_.jitter_rad = plan.jitter_rad;
  const SystematicErrors& errors = plan.errors;
  figures_.scale = errors.scale;
  figures_.bias_m = errors.offset_m, figures_.bias_sine_m = errors.lift_m;
  figures_.lift_cosine_rad = errors.elevation_rad[0], figures_.lift_sine_rad = errors.elevation_rad[1];
  figures_.lift_cosine2_rad = errors.elevation_rad[2], figures_.lift_sine2_rad = errors.elevation_rad[3];
  figures_.noise_scale = plan.noise_scale;
  figures_.white_fraction = plan.white_fraction;
  setOffsets();
  if (!plan.column_noise) return;
  figures_.along_fraction = static_cast<double>(plan.column_noise->along());
  figures_.lift_by_wobble_rad = plan.instrument.correlated.elevation_wobble_rad;
  figures_.wobble_m = plan.instrument.correlated.wobble_m;
}

void PointLanes::setOffsets() {
  constexpr double kOctavesPerDb = 0.33219280948873623, kDecadesPerOctave = 0.30102999566398120;
  constexpr std::size_t kWalk = kMostOffsets - 1;  // the ramps between n powers are n - 1
  const Effects effects = plan_.options.effects;
  if (effects.has(Effect::saturation))
    figures_.offset[kWalk] = {static_cast<float>(kOctavesPerDb * plan_.instrument.saturation.level_db), 1e3F,
                              static_cast<float>(kDecadesPerOctave * plan_.instrument.saturation.walk_m_per_decade)};
  const RangeOffset& table = plan_.instrument.range_offset;
  if (!effects.has(Effect::range_offset) || table.power_db.empty()) return;
  figures_.least_offset_m = static_cast<float>(table.offset_m.front());
  for (std::size_t i = 0; i + 1 < table.power_db.size(); ++i) {
    const double width = kOctavesPerDb * (table.power_db[i + 1] - table.power_db[i]);
    figures_.offset[i] = {static_cast<float>(kOctavesPerDb * table.power_db[i]), static_cast<float>(width),
                          static_cast<float>((table.offset_m[i + 1] - table.offset_m[i]) / width)};
  }
}

// Of a scanner that moves, points are first placed as if all pulses went along x, since each goes another way.
void PointLanes::begin(const ColumnHits& hits) {
  const std::uint32_t column = column_ = hits.column();
  moving_ = hits.moving();
  const double face = !plan_.pattern && plan_.clock.behind(column) ? -1 : 1;
  const Eigen::Vector3d ahead = moving_ != nullptr ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : hits.ahead();
  const Eigen::Vector3d lateral = moving_ != nullptr ? Eigen::Vector3d(Eigen::Vector3d::UnitY()) : hits.lateral();
  figures_.ahead_x = ahead.x(), figures_.ahead_y = ahead.y();
  figures_.lateral_x = lateral.x(), figures_.lateral_y = lateral.y();
  figures_.lateral_rad = face * plan_.errors.collimation_rad;
  figures_.trunnion_rad = face * plan_.errors.trunnion_rad;
  figures_.azimuth_rad = plan_.pattern ? 0 : plan_.errors.azimuthError_rad(plan_.azimuth_rad(column));
  figures_.lift_rad = face * plan_.errors.index_rad;
  if (!plan_.column_noise) return;
  plan_.column_noise->along(column, along_.data());
  const ColumnNoise::Column& noise = plan_.column_noise->column(column);
  figures_.azimuth_rad += static_cast<double>(noise.azimuth_rad);
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
  std::copy_n(returns.noise.detection, kReturnLanes, returns.signal.fluctuation);
  standpoint::receive(returns.signal, plan_.receiver);
  double cyclic_m[kReturnLanes] = {};
  if (plan_.errors.cycle_m > 0)
    for (int k = 0; k < kReturnLanes; ++k) cyclic_m[k] = plan_.errors.cyclic_m(returns.range_m[k]);
  place(figures_, cyclic_m, returns);
  if (plan_.unambiguous_m > 0) foldBack(returns);
  if (moving_ != nullptr) moveBack(returns, count);
  const std::uint32_t lanes = detected(returns, count);
  return plan_.flags == PointFilters{} && plan_.drops == PointFilters{} ? lanes : filtered(returns, lanes);
}

// P_d = ½ erfc((x_min - x) / √2 σ), drawn (§2.7). In daylight the threshold keeps its distance to the noise; without it
// the background is nothing.
std::uint32_t PointLanes::detected(const ReturnLanes& returns, int count) const {
  const std::uint32_t lanes = detectedOf(returns, plan_.softness, plan_.threshold, plan_.daylight.has_value());
  return count < kReturnLanes ? lanes & ((1U << static_cast<unsigned>(count)) - 1) : lanes;
}

bool PointLanes::faulted(const ReturnLanes& returns, int lane, const PointFilters& filters) const {
  const float x = returns.signal.x[lane];
  if (filters.deviation_m > 0 && static_cast<double>(returns.deviation_m[lane]) > filters.deviation_m) return true;
  if (filters.weak_factor > 0 && static_cast<double>(x) < filters.weak_factor * plan_.threshold) return true;
  return filters.overload && x > plan_.saturation;
}

// Flags what the instrument's filters find fault with, and leaves out what they drop.
std::uint32_t PointLanes::filtered(ReturnLanes& returns, std::uint32_t lanes) const {
  const auto weak = static_cast<float>(std::max(plan_.flags.weak_factor, plan_.drops.weak_factor) * plan_.threshold);
  if (!suspicious(returns, weak, plan_.saturation)) return lanes;
  std::uint32_t kept = lanes;
  for (std::uint32_t left = lanes; left != 0; left &= left - 1) {
    const int lane = std::countr_zero(left);
    if (faulted(returns, lane, plan_.drops))
      kept &= ~(left & -left);
    else if (faulted(returns, lane, plan_.flags))
      returns.flag(lane, point_flag::kFiltered);
  }
  return kept;
}

void PointLanes::foldBack(ReturnLanes& returns) const {
  for (int k = 0; k < kReturnLanes; ++k) {
    if (returns.range_m[k] < plan_.unambiguous_m - 1) continue;
    const double range = std::sqrt(static_cast<double>(returns.x_m[k]) * static_cast<double>(returns.x_m[k]) +
                                   static_cast<double>(returns.y_m[k]) * static_cast<double>(returns.y_m[k]) +
                                   static_cast<double>(returns.z_m[k]) * static_cast<double>(returns.z_m[k]));
    const auto fraction = static_cast<float>(plan_.folded(range) / range);
    returns.x_m[k] *= fraction, returns.y_m[k] *= fraction, returns.z_m[k] *= fraction;
  }
}

void PointLanes::moveBack(ReturnLanes& returns, int count) const {
  for (int k = 0; k < count; ++k) {
    const std::uint32_t row = returns.row[k];
    if (row >= plan_.settings.rows) continue;
    Eigen::Vector3d seen = static_cast<double>(returns.x_m[k]) * moving_->ahead(row) +
                           static_cast<double>(returns.y_m[k]) * moving_->lateral(row);
    seen.z() = static_cast<double>(returns.z_m[k]);
    const Eigen::Vector3f point = moving_->placed(row, seen).cast<float>();
    returns.x_m[k] = point.x(), returns.y_m[k] = point.y(), returns.z_m[k] = point.z();
  }
}

}  // namespace standpoint
