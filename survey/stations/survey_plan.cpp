// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/survey_plan.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "pointclouds/e57/e57_packet_writer.h"
#include "survey/stations/placement.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

// Of each sample by the station from which the points lie densest, 0 where none sees it.
void addSpacing(std::vector<double>& spacing_m, const ScanForecast& forecast, const Pose& pose,
                const ScanSettings& settings, const SurfaceSamples& samples) {
  for (std::size_t k = 0; k < spacing_m.size(); ++k) {
    if (forecast.seen[k] == 0) continue;
    const double here = spacingAt(settings, pose, samples.samples[k].place);
    spacing_m[k] = spacing_m[k] > 0 ? std::min(spacing_m[k], here) : here;
  }
}

}  // namespace

// Four floats, the grid, the labels, the colour, what is known of it; of each 1024 bytes
// of a page 4 are its sum.
double bytesPerPoint(const ScanSettings& settings, const ScanChannels& channels, const Environment& environment,
                     std::size_t materials) {
  using e57::bitsFor;
  const double bits = 4 * 32 + bitsFor(settings.rows - 1) + bitsFor(settings.columns - 1) +
                      bitsFor(environment.products.size()) + bitsFor(materials) + (settings.imaging ? 24 : 0) +
                      (channels.time ? 64 : 0) + (channels.returns ? 16 : 0) + (channels.truth ? 6 * 32 + 8 : 0);
  return bits / 8 * 1024 / 1020;
}

Result<SurveyPlan> planSurvey(const Job& job, std::shared_ptr<const RayScene> scene,
                              std::shared_ptr<const MaterialAssignment> assignment, const PlanRequest& request,
                              Progress& progress) {
  const auto& environment = scene->environment();
  const double bytes_per_point =
      bytesPerPoint(request.settings, request.channels, environment, assignment->materials.size());
  progress.stage("Sample surfaces", 0, 0.2);
  TRY_ASSIGN(auto samples, sampleSurfaces(*scene, request.samples, request.seed, progress));
  SurveyPlan plan;
  plan.samples = std::move(samples);
  const Expectation expectation(std::move(scene), std::move(assignment),
                                ReturnLaw(request.instrument, request.settings));
  std::vector<double> spacing_m(plan.samples.samples.size(), 0);
  progress.stage("Forecast", 0.2, 0.7);
  for (const auto index : request.stations) {
    TRY(progress.check());
    const auto& station = job.stations[index];
    plan.stations.push_back(station.name);
    plan.forecasts.push_back(forecastScan(expectation, station.true_pose, plan.samples, request.wanted));
    addSpacing(spacing_m, plan.forecasts.back(), station.true_pose, request.settings, plan.samples);
    plan.bytes.push_back(plan.forecasts.back().points * bytes_per_point);
    progress.advance(static_cast<double>(plan.forecasts.size()) / static_cast<double>(request.stations.size()));
  }
  std::vector<const std::vector<std::uint8_t>*> seen;
  for (const auto& f : plan.forecasts) seen.push_back(&f.seen);
  static_cast<SurfacesSeen&>(plan) = countSeen(plan.samples, environment, seen);
  if (!plan.stations.empty()) plan.patches = surfaceHoles(plan.samples, spacing_m, kMostPatches);
  return plan;
}

std::optional<NextStation> nextStation(const Job& job, const GroundSearch& search, const StationPlacement& placement,
                                       const SurfaceSamples& samples, const std::vector<std::uint8_t>& seen,
                                       const SightLimits& limits, Progress& progress) {
  constexpr std::size_t kMost = 3000;  // of the places that are not seen yet: evenly taken
  std::vector<const SurfacePlace*> unseen;
  for (std::size_t k = 0; k < samples.samples.size(); ++k)
    if (samples.samples[k].exposed && seen[k] == 0) unseen.push_back(&samples.samples[k].place);
  const std::size_t step = unseen.size() / kMost + 1;
  std::vector<std::uint8_t> gained((unseen.size() + step - 1) / step);
  const auto& scene = placement.scene();
  const double each = samples.each_m2() * static_cast<double>(step);
  const auto worth = [&](const Eigen::Vector3d& centre) {
    tbb::parallel_for(std::size_t{0}, gained.size(), [&](std::size_t k) {  // each into its own slot
      gained[k] = static_cast<std::uint8_t>(inSight(scene, centre, *unseen[k * step], limits));
    });
    return each * static_cast<double>(std::count(gained.begin(), gained.end(), 1));
  };
  auto grounds = groundsToTry(job, scene, search);
  grounds.push_back(groundWithoutFloor(scene));
  const auto centre = bestOf(grounds, job, placement, search.height_m, worth, progress);
  if (!centre) return std::nullopt;
  return NextStation{*centre, worth(*centre)};
}

}  // namespace standpoint
