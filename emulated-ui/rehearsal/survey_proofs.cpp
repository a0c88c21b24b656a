// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/rehearsal/survey_proofs.h"

#include <algorithm>
#include <numeric>

#include "core/units.h"
#include "project/survey/scan_request.h"
#include "project/survey/survey_verbs.h"
#include "survey/instruments.h"
#include "survey/scanning/scan_world.h"
#include "survey/stations/placement.h"
#include "survey/stations/survey_plan.h"

namespace standpoint {

namespace {

constexpr double kSteepEnough_deg = 60;  // instrument facts 4.2: incidence below 60°
constexpr double kEvery_m = 0.8;         // between the places from which something might be seen
constexpr std::size_t kSamples = 30000;  // of the whole model: a room still has some hundreds

bool inside(const std::vector<double>& box, const Eigen::Vector3d& p) {
  if (box.size() != 6) return true;
  for (Eigen::Index i = 0; i < 3; ++i)
    if (p[i] < box[static_cast<std::size_t>(i)] || p[i] > box[static_cast<std::size_t>(i) + 3]) return false;
  return true;
}

// Places all over the area where a tripod can stand, at the instrument's usual height above its floor.
std::vector<Station> everywhere(const std::vector<double>& area, const RayScene& scene, const Instrument& instrument,
                                const Document& document) {
  std::vector<Station> stations;
  const auto stand = readTripodStand(tripodStandFile());
  if (area.size() != 6 || !stand) return stations;
  const StationPlacement placement(scene, *stand, instrument.trunnion_height_m);
  for (double x = area[0] + kEvery_m / 2; x < area[3]; x += kEvery_m)
    for (double y = area[1] + kEvery_m / 2; y < area[4]; y += kEvery_m) {
      Station station;
      station.true_pose.translation =
          Eigen::Vector3d(x, y, area[2] + instrument.tripod_height_m) - document.georeference->shift_m;
      if (!placement.whyNot(station.true_pose.translation)) stations.push_back(std::move(station));
    }
  return stations;
}

std::vector<std::uint8_t> seenFromAny(const SurveyPlan& plan) {
  std::vector<std::uint8_t> seen(plan.samples.samples.size(), 0);
  for (const auto& forecast : plan.forecasts)
    for (std::size_t k = 0; k < seen.size(); ++k) seen[k] |= forecast.seen[k];
  return seen;
}

}  // namespace

std::map<std::string, double> readSurvey(const Exercise& exercise, const Device& device, const Document& document,
                                         std::vector<std::uint8_t>& in_reach) {
  std::map<std::string, double> figures = {
      {"survey.walls", 0}, {"survey.coverage", 0}, {"survey.reached", 0}, {"survey.overlap", 0}};
  if (!document.job || document.job->stations.empty()) return figures;
  Progress quiet;
  const auto assignment = scanAssignment(document, quiet);
  if (!assignment) return {};
  const ScanWorld world = scanWorld(document.environment(), document.job->targets, *assignment);
  const auto scene = RayScene::build(world.environment, quiet, world.balls);
  if (!scene) return {};
  PlanRequest request;
  request.instrument = device.type().instrument;
  request.settings = device.expected();
  request.stations.resize(document.job->stations.size());
  std::iota(request.stations.begin(), request.stations.end(), std::size_t{0});
  request.samples = kSamples;
  const auto materials = std::make_shared<const MaterialAssignment>(world.assignment);
  const auto plan = planSurvey(*document.job, *scene, materials, request, quiet);
  request.wanted.max_incidence_rad = kSteepEnough_deg * kRadPerDeg;
  const auto steep = planSurvey(*document.job, *scene, materials, request, quiet);
  if (!plan || !steep) return {};
  const auto& samples = plan->samples.samples;
  if (in_reach.size() != samples.size()) {
    Job job;
    job.stations = everywhere(exercise.area, **scene, request.instrument, document);
    request.wanted = {};
    request.stations.resize(job.stations.size());
    std::iota(request.stations.begin(), request.stations.end(), std::size_t{0});
    if (const auto whole = planSurvey(job, *scene, materials, request, quiet)) in_reach = seenFromAny(*whole);
    in_reach.resize(samples.size(), 1);
  }
  const auto seen = seenFromAny(*plan), seen_steeply = seenFromAny(*steep);
  double walls = 0, walls_seen = 0, all = 0, all_seen = 0, reachable = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (!samples[k].exposed || !inside(exercise.area, samples[k].place.position + document.georeference->shift_m))
      continue;
    all += 1;
    all_seen += seen[k] != 0 ? 1 : 0;
    reachable += in_reach[k] != 0 || seen[k] != 0 ? 1 : 0;
    if (!world.environment->products[samples[k].product].ifc_class.starts_with("IfcWall")) continue;
    walls += 1;
    walls_seen += seen_steeply[k] != 0 ? 1 : 0;
  }
  figures["survey.walls"] = walls > 0 ? walls_seen / walls : 0;
  figures["survey.coverage"] = all > 0 ? all_seen / all : 0;
  figures["survey.reached"] = reachable > 0 ? all_seen / reachable : 0;
  std::vector<double> best(plan->stations.size(), 0);
  for (const auto& pair : plan->pairs)
    for (const auto side : {pair.a, pair.b}) best[side] = std::max(best[side], pair.overlap());
  figures["survey.overlap"] = best.size() < 2 ? 0 : *std::min_element(best.begin(), best.end());
  return figures;
}

}  // namespace standpoint
