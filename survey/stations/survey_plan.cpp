// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/survey_plan.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include "pointclouds/e57/e57_packet_writer.h"
#include "survey/stations/placement.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

// Of a point in an E57 of ours: four floats, the grid, the labels, the colour, what is known of it; of each 1024 bytes
// of a page 4 are its sum.
double bytesPerPoint(const ScanSettings& settings, const ScanChannels& channels, const Environment& environment,
                     std::size_t materials) {
  using e57::bitsFor;
  const double bits = 4 * 32 + bitsFor(settings.rows - 1) + bitsFor(settings.columns - 1) +
                      bitsFor(environment.products.size()) + bitsFor(materials) + (settings.imaging ? 24 : 0) +
                      (channels.time ? 64 : 0) + (channels.returns ? 16 : 0) + (channels.truth ? 6 * 32 + 8 : 0);
  return bits / 8 * 1024 / 1020;
}

void count(SurfaceCoverage& surface, const SurfaceSample& sample, int times) {
  if (!sample.exposed) return;
  surface.exposed += 1;
  surface.seen += static_cast<std::uint64_t>(times > 0);
  surface.twice += static_cast<std::uint64_t>(times > 1);
}

std::vector<SurfaceCoverage> sorted(const std::map<std::string, SurfaceCoverage>& by_name) {
  std::vector<SurfaceCoverage> surfaces;
  for (const auto& [name, surface] : by_name)
    if (surface.exposed > 0) {
      surfaces.push_back(surface);
      surfaces.back().name = name;
    }
  return surfaces;
}

void countCoverage(SurveyPlan& plan, const Environment& environment) {
  std::map<std::string, SurfaceCoverage> classes, storeys;
  std::vector<SurfaceCoverage> products(environment.products.size());
  for (std::size_t k = 0; k < plan.samples.samples.size(); ++k) {
    const auto& sample = plan.samples.samples[k];
    int times = 0;
    for (const auto& f : plan.forecasts) times += f.seen[k];
    const auto& product = environment.products[sample.product];
    count(plan.all, sample, times);
    count(classes[product.ifc_class], sample, times);
    count(storeys[product.storey], sample, times);
    count(products[sample.product], sample, times);
  }
  plan.classes = sorted(classes);
  plan.storeys = sorted(storeys);
  for (std::uint32_t p = 0; p < products.size(); ++p)
    if (products[p].seen < products[p].exposed) {
      products[p].product = p;
      products[p].name = environment.products[p].id;
      plan.holes.push_back(products[p]);
    }
  std::stable_sort(plan.holes.begin(), plan.holes.end(),
                   [](const auto& a, const auto& b) { return a.exposed - a.seen > b.exposed - b.seen; });
}

void countPairs(SurveyPlan& plan) {
  const double each = plan.samples.each_m2();
  for (const auto& f : plan.forecasts)
    plan.seen_m2.push_back(each * static_cast<double>(std::count(f.seen.begin(), f.seen.end(), 1)));
  for (std::size_t a = 0; a < plan.forecasts.size(); ++a)
    for (std::size_t b = a + 1; b < plan.forecasts.size(); ++b) {
      std::uint64_t common = 0;
      for (std::size_t k = 0; k < plan.samples.samples.size(); ++k)
        common += plan.forecasts[a].seen[k] & plan.forecasts[b].seen[k];
      const double area = each * static_cast<double>(common);
      const auto fraction = [area](double of) { return of > 0 ? area / of : 0; };
      plan.pairs.push_back({a, b, area, fraction(plan.seen_m2[a]), fraction(plan.seen_m2[b])});
    }
}

}  // namespace

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
  progress.stage("Forecast", 0.2, 0.7);
  for (const auto index : request.stations) {
    TRY(progress.check());
    const auto& station = job.stations[index];
    plan.stations.push_back(station.name);
    plan.forecasts.push_back(forecastScan(expectation, station.true_pose, plan.samples, request.wanted));
    plan.bytes.push_back(plan.forecasts.back().points * bytes_per_point);
    progress.advance(static_cast<double>(plan.forecasts.size()) / static_cast<double>(request.stations.size()));
  }
  countCoverage(plan, environment);
  countPairs(plan);
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
