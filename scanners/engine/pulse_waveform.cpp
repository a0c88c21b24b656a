// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/pulse_waveform.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/portable_math.h"
#include "core/random.h"
#include "scanners/engine/column_hits.h"
#include "scanners/engine/end_powers.h"

namespace standpoint {

namespace {

constexpr double kLight_m_per_s = 299792458.0;
constexpr double kSigmaPerWidth = 2.354820045;  // FWHM of a Gaussian in its σ
constexpr double kTail = 5;                     // σ before the first surface and behind the last
constexpr double kBinsPerPulse = 20;
constexpr double kStep_rad = 1e-6;  // of the grid of one pulse

std::vector<PathEnd> endsOf(const ScanPlan& plan, FacetCache& facets, TimedScene& scene) {
  ColumnHits hits(plan, scene);
  hits.trace(0);
  BeamPaths paths(plan, facets, scene);
  const double time_s = hits.bodiesTime_s(0);
  paths.setTime(time_s);
  std::vector<PathEnd> ends;
  const Beam beam = hits.beam(0);
  SubRay rays[kReferenceSubRays] = {{0, 0, 1}};
  const int count = plan.wideBeams() ? kReferenceSubRays : 1;
  if (count > 1)
    drawFootprint(philox({plan.options.seed, plan.options.station_key}, 0, 0, kFootprintChannel), count, rays);
  for (int k = 0; k < count; ++k) {
    const RayLine line = lineOf(beam, rays[k].across, rays[k].upward, plan.instrument);
    const NearestHit hit = scene.nearest(line.origin, line.direction, 0, plan.farthest_m, time_s);
    if (hit.facet != kNoFacet) paths.follow(line.origin, line.direction, hit, rays[k].weight, ends);
  }
  return ends;
}

}  // namespace

Result<PulseWaveform> pulseWaveform(const RayScene& scene, const MaterialAssignment& assignment,
                                    const Instrument& instrument, const ScanSettings& settings,
                                    const Pose& local_from_scanner, const ScanOptions& options,
                                    const WaveformRequest& request) {
  const auto* embree = dynamic_cast<const EmbreeScene*>(&scene);
  if (embree == nullptr)
    return failure(ErrorKind::internal, "this ray scene was not made by RayScene::build", "ray scene");
  if (instrument.waveform.pulse_width_s <= 0)
    return failure(ErrorKind::usage, instrument.maker + " " + instrument.model +
                                         " measures phases and records no pulses: use a time-of-flight instrument, "
                                         "such as leica-rtc360");
  ScanSettings one = settings;
  one.columns = one.rows = 1;
  one.azimuth_from_rad = request.azimuth_rad, one.azimuth_to_rad = request.azimuth_rad + kStep_rad;
  one.elevation_from_rad = request.elevation_rad - kStep_rad / 2;
  one.elevation_to_rad = request.elevation_rad + kStep_rad / 2;
  const ScanPlan plan(*embree, assignment, instrument, one, local_from_scanner, nullptr, options);
  TimedScene timed(*embree, {});
  FacetCache facets(plan, timed);
  const auto ends = endsOf(plan, facets, timed);
  EndPowers end_powers(plan.receiver);
  const auto& powers = end_powers.of(ends);
  std::vector<Contribution> light;
  for (std::size_t i = 0; i < ends.size(); ++i)
    light.push_back({ends[i].path_m + ends[i].excess_m, powers[i], static_cast<int>(i)});
  const double width_m = kLight_m_per_s * instrument.waveform.pulse_width_s / 2, sigma_m = width_m / kSigmaPerWidth;
  PulseWaveform waveform;
  waveform.bin_m = request.bin_m > 0 ? request.bin_m : width_m / kBinsPerPulse;
  if (light.empty()) return waveform;
  const auto by_range = [](const Contribution& a, const Contribution& b) { return a.range_m < b.range_m; };
  const auto [nearest, farthest] = std::minmax_element(light.begin(), light.end(), by_range);
  const double first = std::floor((nearest->range_m - kTail * sigma_m) / waveform.bin_m);
  const double last = std::ceil((farthest->range_m + kTail * sigma_m) / waveform.bin_m);
  if (last - first >= static_cast<double>(kMostWaveformBins))
    return failure(ErrorKind::usage, "more than " + std::to_string(kMostWaveformBins) +
                                         " bins from the nearest to the farthest surface: "
                                         "use wider ones");
  waveform.first_m = first * waveform.bin_m;
  waveform.power.assign(static_cast<std::size_t>(last - first) + 1, 0);
  for (const Contribution& one_surface : light) {
    const auto at = [&](double range_m) {
      return static_cast<std::size_t>(std::clamp(range_m / waveform.bin_m - first, 0.0, last - first));
    };
    const std::size_t to = at(one_surface.range_m + kTail * sigma_m);
    for (std::size_t i = at(one_surface.range_m - kTail * sigma_m); i <= to; ++i) {
      const double off = ((first + static_cast<double>(i)) * waveform.bin_m - one_surface.range_m) / sigma_m;
      waveform.power[i] += static_cast<double>(one_surface.x) * portable::exp(-off * off / 2);
    }
  }
  receiveEchoes(instrument.waveform, light, waveform.echoes);
  return waveform;
}

}  // namespace standpoint
