// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"
#include "project/survey/scan_request.h"
#include "project/survey/survey_verbs.h"
#include "survey/instruments.h"
#include "survey/scanning/scan_world.h"
#include "survey/stations/placement.h"
#include "survey/stations/survey_plan.h"

namespace standpoint {

namespace {

using nlohmann::json;

constexpr std::size_t kHoles = 30;   // that are listed
constexpr double kLowOverlap = 0.3;  // of what field practice asks for between neighbours

json coverageJson(const SurfaceCoverage& surface, double each_m2) {
  return {{"exposed_m2", each_m2 * static_cast<double>(surface.exposed)},
          {"seen_m2", each_m2 * static_cast<double>(surface.seen)},
          {"twice_m2", each_m2 * static_cast<double>(surface.twice)},
          {"coverage", surface.coverage()}};
}

json rowsOf(const std::vector<SurfaceCoverage>& surfaces, const char* key, double each_m2) {
  json rows = json::array();
  for (const auto& surface : surfaces) {
    rows.push_back(coverageJson(surface, each_m2));
    rows.back()[key] = surface.name;
  }
  return rows;
}

json holesOf(const SurveyPlan& plan, const Environment& environment) {
  json rows = json::array();
  for (std::size_t k = 0; k < std::min(kHoles, plan.holes.size()); ++k) {
    json row = identity(environment.products[plan.holes[k].product]);
    row.update(coverageJson(plan.holes[k], plan.samples.each_m2()));
    row["unseen_m2"] = plan.samples.each_m2() * static_cast<double>(plan.holes[k].exposed - plan.holes[k].seen);
    rows.push_back(std::move(row));
  }
  return rows;
}

json answerOf(const SurveyPlan& plan, const Environment& environment) {
  const double each = plan.samples.each_m2();
  json answer = coverageJson(plan.all, each);
  answer["area_m2"] = plan.samples.area_m2;
  answer["samples"] = plan.samples.samples.size();
  const double fraction = plan.all.coverage();
  answer["coverage_sigma"] =
      plan.all.exposed == 0 ? 0 : std::sqrt(fraction * (1 - fraction) / static_cast<double>(plan.all.exposed));
  answer["classes"] = rowsOf(plan.classes, "class", each);
  answer["storeys"] = rowsOf(plan.storeys, "storey", each);
  answer["holes"] = holesOf(plan, environment);
  double points = 0, seconds = 0, bytes = 0;
  answer["stations"] = json::array();
  for (std::size_t k = 0; k < plan.stations.size(); ++k) {
    const auto& f = plan.forecasts[k];
    answer["stations"].push_back({{"station", plan.stations[k]},
                                  {"seen_m2", plan.seen_m2[k]},
                                  {"points", std::llround(f.points)},
                                  {"instrument_seconds", f.seconds},
                                  {"bytes", std::llround(plan.bytes[k])}});
    points += f.points;
    seconds += f.seconds;
    bytes += plan.bytes[k];
  }
  answer["points"] = std::llround(points);
  answer["instrument_seconds"] = seconds;
  answer["bytes"] = std::llround(bytes);
  answer["pairs"] = json::array();
  for (const auto& p : plan.pairs)
    answer["pairs"].push_back({{"a", plan.stations[p.a]},
                               {"b", plan.stations[p.b]},
                               {"common_m2", p.common_m2},
                               {"of_a", p.of_a},
                               {"of_b", p.of_b},
                               {"overlap", p.overlap()}});
  return answer;
}

std::string minutes(double seconds) {
  const auto whole = std::llround(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string textOf(const SurveyPlan& plan, const json& answer) {
  std::string text;
  for (std::size_t k = 0; k < plan.stations.size(); ++k)
    text += fmt::format("{:12} sees {:8.1f} m2   {:7.2f} M points   {:>6} min   {:7.1f} MB\n", plan.stations[k],
                        plan.seen_m2[k], plan.forecasts[k].points / 1e6, minutes(plan.forecasts[k].seconds),
                        plan.bytes[k] / 1e6);
  if (plan.stations.size() > 1)
    text += fmt::format("{:12}                     {:7.2f} M points   {:>6} min   {:7.1f} MB\n", "all",
                        answer["points"].get<double>() / 1e6, minutes(answer["instrument_seconds"]),
                        answer["bytes"].get<double>() / 1e6);
  for (const auto& surface : plan.storeys)
    text += fmt::format("storey {:30} {:5.1f} %\n", surface.name.empty() ? "(none)" : surface.name,
                        surface.coverage() * 100);
  for (const auto& surface : plan.classes)
    text += fmt::format("class  {:30} {:5.1f} %\n", surface.name.empty() ? "(none)" : surface.name,
                        surface.coverage() * 100);
  for (const auto& pair : plan.pairs)
    text += fmt::format("overlap {} - {}: {:.0f} %{}\n", plan.stations[pair.a], plan.stations[pair.b],
                        pair.overlap() * 100, pair.overlap() < kLowOverlap ? ", low overlap" : "");
  for (const auto& hole : answer["holes"])
    text += fmt::format("not covered: {:8.2f} m2 of {} {} {}\n", hole["unseen_m2"].get<double>(),
                        hole.value("class", ""), hole.value("id", ""), hole.value("name", ""));
  return text;
}

Result<PlanRequest> requestFrom(const Document& document, const PlanOptions& options) {
  PlanRequest request;
  TRY_ASSIGN(auto instrument, instrumentById(options.instrument));
  request.instrument = std::move(instrument);
  TRY_ASSIGN(auto settings, resolveSettings(request.instrument, options.settings));
  request.settings = std::move(settings);
  if (!document.job->stations.empty()) {
    TRY_ASSIGN(auto stations, stationsFrom(*document.job, options.stations));
    request.stations = std::move(stations);
  }
  if (options.spacing_m) request.wanted.max_spacing_m = *options.spacing_m;
  if (options.max_incidence_deg) request.wanted.max_incidence_rad = *options.max_incidence_deg * kRadPerDeg;
  if (options.max_range_m) request.wanted.max_range_m = *options.max_range_m;
  request.channels.returns = request.instrument.waveform.max_returns > 1;
  request.samples = options.samples;
  request.seed = options.seed;
  return request;
}

// The place that adds most to what these stations see.
Result<json> proposalFor(const Document& document, const RayScene& scene, const SurveyPlan& plan,
                         const PlanRequest& request, Progress& progress) {
  TRY_ASSIGN(const auto stand, readTripodStand(tripodStandFile()));
  const StationPlacement placement(scene, stand, request.instrument.trunnion_height_m);
  std::vector<std::uint8_t> seen(plan.samples.samples.size(), 0);
  for (const auto& f : plan.forecasts)
    for (std::size_t k = 0; k < seen.size(); ++k) seen[k] |= f.seen[k];
  const SightLimits limits{std::min(request.wanted.max_range_m, request.settings.max_range_m),
                           std::max(SightLimits{}.min_cosine, std::cos(request.wanted.max_incidence_rad)),
                           request.settings.elevation_from_rad, request.settings.elevation_to_rad};
  progress.stage("Search for next station", 0.7, 1);
  const auto next = nextStation(*document.job, document.walkable(), placement, plan.samples, seen, limits,
                                request.instrument.tripod_height_m, progress);
  TRY(progress.check());
  if (!next) return json();
  return json{{"at", toJson(next->centre + document.georeference->shift_m)}, {"adds_m2", next->adds_m2}};
}

}  // namespace

const Fields<PlanOptions>& planFields() {
  using O = PlanOptions;
  static const Fields<O> fields = {
      {"stations", &O::stations, "all, or names separated by commas"},
      {"instrument", &O::instrument, "id of the instrument, such as leica-rtc360", {.required = true}},
      {"set", &O::settings, "settings in the device's own words, such as resolution=12mm"},
      {"spacing",
       &O::spacing_m,
       "a surface counts as seen with a point for each square of at most this side",
       {.unit = "m", .minimum = 0.0001, .maximum = 100}},
      {"max-incidence-deg",
       &O::max_incidence_deg,
       "maximum angle of incidence of what counts as seen",
       {.unit = "deg", .minimum = 1, .maximum = 90}},
      {"max-range",
       &O::max_range_m,
       "maximum range of what counts as seen",
       {.unit = "m", .minimum = 0.1, .maximum = 10000}},
      {"samples", &O::samples, "number of sample points on the surfaces", {.minimum = 100, .maximum = 5000000}},
      {"seed", &O::seed, "seed of the sample points", {.minimum = 0, .maximum = 9007199254740991.0}}};
  return fields;
}

Result<Outcome> runPlan(const Document& document, const PlanOptions& options, Progress& progress) {
  TRY_ASSIGN(auto request, requestFrom(document, options));
  Outcome outcome{document, json::object(), {}, {}};
  noteDefaultRules(document, outcome.report);
  TRY_ASSIGN(auto assignment, scanAssignment(document, progress));
  const ScanWorld world = scanWorld(document.environment(), document.job->targets, assignment);
  if (sceneTriangleCount(*world.environment) == 0)
    return failure(
        ErrorKind::unusable,
        "the scene contains no products to plan for; import a model, or include products again with `treat`");
  TRY_ASSIGN(auto scene, RayScene::build(world.environment, progress));
  TRY_ASSIGN(auto plan, planSurvey(*document.job, scene, std::make_shared<const MaterialAssignment>(world.assignment),
                                   request, progress));
  TRY_ASSIGN(auto proposal, proposalFor(document, *scene, plan, request, progress));
  outcome.answer = answerOf(plan, *world.environment);
  outcome.answer["proposed"] = proposal;
  outcome.description = fmt::format("{} station{} would cover {:.1f} % of {:.0f} m2", plan.stations.size(),
                                    plan.stations.size() == 1 ? "" : "s", plan.all.coverage() * 100,
                                    outcome.answer["exposed_m2"].get<double>());
  outcome.text = textOf(plan, outcome.answer);
  if (proposal.is_object())
    outcome.text += fmt::format("another station at {:.2f},{:.2f},{:.2f} would add {:.1f} m2\n",
                                proposal["at"][0].get<double>(), proposal["at"][1].get<double>(),
                                proposal["at"][2].get<double>(), proposal["adds_m2"].get<double>());
  return outcome;
}

}  // namespace standpoint
