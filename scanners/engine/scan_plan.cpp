// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/scan_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/portable_math.h"
#include "scanners/engine/column_hits.h"
#include "scanners/engine/footprint.h"
#include "scanners/math/target_clones.h"
#include "scanners/noise/pulse_noise.h"

namespace standpoint {

namespace {

std::uint8_t byte(float fraction) { return static_cast<std::uint8_t>(std::clamp(fraction, 0.0F, 1.0F) * 255 + 0.5F); }

// In one turn of the mirror: in front upwards, behind downwards.
STANDPOINT_CLONES void timesOf(bool behind, std::uint32_t turn, double turn_s, const double* elevations_rad,
                               std::size_t count, double* times_s) {
  constexpr double kQuarter = std::numbers::pi / 2;
  const double from = behind ? 3 * kQuarter : kQuarter, up = behind ? -1 : 1;
  for (std::size_t i = 0; i < count; ++i)
    times_s[i] = (turn + (from + up * elevations_rad[i]) / (2 * std::numbers::pi)) * turn_s;
}

}  // namespace

PulseClock::PulseClock(const Instrument& instrument, const ScanSettings& settings)
    : half_((settings.columns + 1) / 2),
      turn_s_((settings.scan_seconds / settings.passes - instrument.overhead_s) / half_) {}

double PulseClock::time_s(std::uint32_t column, double elevation_rad) const {
  double time_s = 0;
  timesOf(behind(column), behind(column) ? column - half_ : column, turn_s_, &elevation_rad, 1, &time_s);
  return time_s;
}

void PulseClock::times(std::uint32_t column, const std::vector<double>& elevations_rad,
                       std::vector<double>& times_s) const {
  times_s.resize(elevations_rad.size());
  timesOf(behind(column), behind(column) ? column - half_ : column, turn_s_, elevations_rad.data(), times_s.size(),
          times_s.data());
}

double ScanPlan::azimuth_rad(std::uint32_t column) const {
  return settings.azimuth_from_rad + column * (settings.azimuth_to_rad - settings.azimuth_from_rad) / settings.columns;
}

// In the middle of its row, so that no two columns share the zenith.
double ScanPlan::elevation_rad(std::uint32_t row) const {
  return settings.elevation_from_rad +
         (row + 0.5) * (settings.elevation_to_rad - settings.elevation_from_rad) / settings.rows;
}

ScanPlan::ScanPlan(const EmbreeScene& scene_, const MaterialAssignment& assignment_, const Instrument& instrument_,
                   const ScanSettings& settings_, const Pose& start_, const ScanMotion* motion_,
                   const ScanOptions& options_)
    : scene(scene_),
      assignment(assignment_),
      triangles(scene_.environment(), assignment_),
      instrument(instrument_),
      settings(settings_),
      start(start_),
      motion(motion_),
      options(options_),
      clock(instrument_, settings_) {
  const Effects effects = options.effects;
  const double average = 1 / std::sqrt(static_cast<double>(settings.passes));
  noise_scale = settings.noise_factor * average;
  if (effects.has(Effect::angle_noise)) jitter_rad = instrument.angle_jitter_rad * average;
  Weather weather = options.weather;
  if (!effects.has(Effect::weather)) weather = {.visibility_km = weather.visibility_km};
  if (!effects.has(Effect::atmosphere)) weather = kNoAir;
  const Weather clear = effects.has(Effect::atmosphere) ? Weather{} : kNoAir;
  if (effects.has(Effect::detection))
    threshold = detectionThreshold(settings, extinction_per_m(clear, instrument.wavelength_nm));
  if (effects.has(Effect::chance)) softness = threshold * instrument.detection_softness;
  saturation = effects.has(Effect::saturation)
                   ? std::pow(10.0F, static_cast<float>(instrument.saturation.level_db) / 10)
                   : std::numeric_limits<float>::infinity();
  if (instrument.moving) pattern.emplace(*instrument.moving, settings);
  if (effects.has(Effect::bias)) errors = SystematicErrors::drawn(instrument, {options.seed, options.station_key});
  if (pattern) {  // it has no trunnion: where its beams go is calibrated, or is the boresight's error
    errors.collimation_rad = errors.trunnion_rad = errors.index_rad = 0;
    errors.azimuth_rad = errors.elevation_rad = {};
  }
  farthest_m = farthest_reported_m = settings.max_range_m;
  if (effects.has(Effect::ambiguity) && settings.unambiguous_m > 0) {
    unambiguous_m = settings.unambiguous_m;
    farthest_m = unambiguous_m + settings.max_range_m;
  }
  nearest_reported_m = std::max(instrument.min_range_m, settings.nearest_m);
  if (settings.farthest_m > 0) farthest_reported_m = std::min(farthest_reported_m, settings.farthest_m);
  if (effects.has(Effect::filters)) flags = instrument.filters, drops = settings.drops;
  if (effects.has(Effect::multipath) && options.quality != ScanQuality::preview && !moves())
    field_of_view_rad = instrument.waveform.field_of_view_rad;
  if (effects.has(Effect::interference)) interference = options.interference;
  if (effects.has(Effect::sun) && options.sun) daylight.emplace(scene, instrument, *options.sun, start.translation);
  receiver = receiverOf(instrument, effects, extinction_per_m(weather, instrument.wavelength_nm));
  receiver.fluctuation = fluctuationOf(
      instrument, effects, detectionThreshold(settings, 0) * instrument.detection_softness, settings.passes);
  drop_threshold = detectionThreshold(settings, 0);
  std::vector<double> elevations;
  for (std::uint32_t row = 0; row < settings.rows; ++row) elevations.push_back(elevation_rad(row));
  const RandomKey key{options.seed, options.station_key};
  if (effects.has(Effect::striping) && !pattern) column_noise.emplace(instrument, settings.columns, elevations, key);
  if (effects.has(Effect::range_noise)) white_fraction = column_noise ? static_cast<double>(column_noise->white()) : 1;
  if (weather.rain_mm_h > 0 || weather.snow_mm_h > 0 || weather.fog_mor_m > 0 || weather.dust_mor_m > 0)
    scatterers.emplace(instrument, weather, drop_threshold, settings.max_range_m, key, settings.passes,
                       effects.has(Effect::near_range));
  for (std::uint32_t row = 0; row < settings.rows + kPacket; ++row) {  // of a pattern it means nothing
    double row_sine = 0, row_cosine = 0;
    portable::sinCos(elevation_rad(row), row_sine, row_cosine);
    sine.push_back(row_sine), cosine.push_back(row_cosine);
  }
  if (effects.has(Effect::halo) && !moves()) {
    halo.emplace(*this);
    if (halo->empty()) halo.reset();
  }
  if (effects.has(Effect::textures) && !scene.environment().images.empty()) {
    paint.emplace(scene.environment());
    if (paint->empty()) paint.reset();
  }
  for (const auto& material : assignment.materials) {
    optics.push_back(opticsOf(material, instrument.wavelength_nm));
    varies |= effects.has(Effect::variation) && optics.back().variation > 0;
    surfaces_differ |= effects.has(Effect::variation) && optics.back().surface_spread > 0;
  }
  for (const auto& surface : scene.environment().surfaces) {
    optics.push_back(opticsOf(surface.colour));
    colours.push_back({byte(surface.colour.r), byte(surface.colour.g), byte(surface.colour.b)});
  }
  if (surfaces_differ) findSurfaceKeys();
}

// A product by its GlobalId; where a format has none by its name and its place in the list.
void ScanPlan::findSurfaceKeys() {
  const Environment& environment = scene.environment();
  for (std::size_t k = 0; k < environment.products.size(); ++k) {
    const Product& product = environment.products[k];
    const auto key = product.global_id.empty() ? stableHash(product.name.c_str(), stableHash(product.id.c_str())) + k
                                               : stableHash(product.global_id.c_str());
    product_keys.push_back(key);
  }
  for (std::size_t k = 0; k < environment.surfaces.size(); ++k)
    surface_keys.push_back((stableHash(environment.surfaces[k].name.c_str()) + k) * 0x9E3779B97F4A7C15ULL);
}

}  // namespace standpoint
