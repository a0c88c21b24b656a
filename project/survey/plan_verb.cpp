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

constexpr std::size_t kHoles = 30;   // that are listed
constexpr double kLowOverlap = 0.3;  // of what field practice asks for between neighbours

PlanCoverage coverageOf(const SurfaceCoverage& surface, double each_m2) {
  return {each_m2 * static_cast<double>(surface.exposed), each_m2 * static_cast<double>(surface.seen),
          each_m2 * static_cast<double>(surface.twice), surface.coverage()};
}

std::vector<PlanHole> holesOf(const SurveyPlan& plan, const Environment& environment) {
  const double each = plan.samples.each_m2();
  std::vector<PlanHole> holes;
  for (std::size_t k = 0; k < std::min(kHoles, plan.holes.size()); ++k) {
    const auto& hole = plan.holes[k];
    holes.push_back({coverageOf(hole, each), identityOf(environment.products[hole.product]),
                     each * static_cast<double>(hole.exposed - hole.seen)});
  }
  return holes;
}

void addStations(PlanAnswer& answer, const SurveyPlan& plan) {
  double points = 0, bytes = 0;
  for (std::size_t k = 0; k < plan.stations.size(); ++k) {
    const auto& f = plan.forecasts[k];
    answer.stations.push_back(
        {plan.stations[k], plan.seen_m2[k], std::llround(f.points), f.seconds, std::llround(plan.bytes[k])});
    points += f.points;
    answer.instrument_seconds += f.seconds;
    bytes += plan.bytes[k];
  }
  answer.points = std::llround(points);
  answer.bytes = std::llround(bytes);
}

PlanAnswer answerOf(const SurveyPlan& plan, const Environment& environment, const Eigen::Vector3d& shift_m) {
  const double each = plan.samples.each_m2();
  PlanAnswer answer{coverageOf(plan.all, each)};
  answer.area_m2 = plan.samples.area_m2;
  answer.samples = plan.samples.samples.size();
  const double fraction = plan.all.coverage();
  if (plan.all.exposed != 0)
    answer.coverage_sigma = std::sqrt(fraction * (1 - fraction) / static_cast<double>(plan.all.exposed));
  for (const auto& surface : plan.classes) answer.classes.push_back({coverageOf(surface, each), surface.name});
  for (const auto& surface : plan.storeys) answer.storeys.push_back({coverageOf(surface, each), surface.name});
  answer.holes = holesOf(plan, environment);
  answer.patches = patchesOf(plan.patches, environment, shift_m);
  addStations(answer, plan);
  for (const auto& p : plan.pairs)
    answer.pairs.push_back({plan.stations[p.a], plan.stations[p.b], p.common_m2, p.of_a, p.of_b, p.overlap()});
  return answer;
}

std::string minutes(double seconds) {
  const auto whole = std::llround(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

std::string textOf(const SurveyPlan& plan, const PlanAnswer& answer) {
  std::string text;
  for (std::size_t k = 0; k < plan.stations.size(); ++k)
    text += fmt::format("{:12} sees {:8.1f} m2   {:7.2f} M points   {:>6} min   {:7.1f} MB\n", plan.stations[k],
                        plan.seen_m2[k], plan.forecasts[k].points / 1e6, minutes(plan.forecasts[k].seconds),
                        plan.bytes[k] / 1e6);
  if (plan.stations.size() > 1)
    text += fmt::format("{:12}                     {:7.2f} M points   {:>6} min   {:7.1f} MB\n", "all",
                        static_cast<double>(answer.points) / 1e6, minutes(answer.instrument_seconds),
                        static_cast<double>(answer.bytes) / 1e6);
  for (const auto& surface : plan.storeys)
    text += fmt::format("storey {:30} {:5.1f} %\n", surface.name.empty() ? "(none)" : surface.name,
                        surface.coverage() * 100);
  for (const auto& surface : plan.classes)
    text += fmt::format("class  {:30} {:5.1f} %\n", surface.name.empty() ? "(none)" : surface.name,
                        surface.coverage() * 100);
  for (const auto& pair : plan.pairs)
    text += fmt::format("overlap {} - {}: {:.0f} %{}\n", plan.stations[pair.a], plan.stations[pair.b],
                        pair.overlap() * 100, pair.overlap() < kLowOverlap ? ", low overlap" : "");
  for (const auto& hole : answer.holes)
    text += fmt::format("not covered: {:8.2f} m2 of {} {} {}\n", hole.unseen_m2, hole.ifc_class, hole.id, hole.name);
  if (const auto& next = answer.proposed)
    text += fmt::format("another station at {:.2f},{:.2f},{:.2f} would add {:.1f} m2\n", next->at.x(), next->at.y(),
                        next->at.z(), next->adds_m2);
  return text;
}

Result<PlanRequest> planRequestFrom(const Document& document, const PlanOptions& options) {
  PlanRequest request;
  TRY_ASSIGN(request.instrument, instrumentNamed(options.instrument));
  TRY_ASSIGN(request.settings, resolveSettings(request.instrument, options.settings));
  if (!document.job->stations.empty()) {
    TRY_ASSIGN(request.stations, stationsFrom(*document.job, options.stations));
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
Result<std::optional<PlanProposal>> proposalFor(const Document& document, const RayScene& scene, const SurveyPlan& plan,
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
  const GroundSearch search{document.walkable(), request.instrument.tripod_height_m,
                            document.georeference->shift_m.z()};
  const auto next = nextStation(*document.job, search, placement, plan.samples, seen, limits, progress);
  TRY(progress.check());
  if (!next) return std::optional<PlanProposal>();
  return std::optional(PlanProposal{next->centre + document.georeference->shift_m, next->adds_m2});
}

}  // namespace

const Fields<PlanOptions>& planFields() {
  using O = PlanOptions;
  static const Fields<O> fields = {
      {"stations", &O::stations, "all, or names separated by commas"},
      {"instrument", &O::instrument, "id or file of the instrument, such as leica-rtc360", {.required = true}},
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

const AnswerFields<PlanCoverage>& answerFields(const PlanCoverage*) {
  using A = PlanCoverage;
  static const AnswerFields<A> fields = {
      {"exposed_m2", &A::exposed_m2}, {"seen_m2", &A::seen_m2}, {"twice_m2", &A::twice_m2}, {"coverage", &A::coverage}};
  return fields;
}

const AnswerFields<PlanClass>& answerFields(const PlanClass* plan_class) {
  static const auto fields = withBases<PlanClass>({{"class", &PlanClass::ifc_class}},
                                                  answerFields(static_cast<const PlanCoverage*>(plan_class)));
  return fields;
}

const AnswerFields<PlanStorey>& answerFields(const PlanStorey* storey) {
  static const auto fields =
      withBases<PlanStorey>({{"storey", &PlanStorey::storey}}, answerFields(static_cast<const PlanCoverage*>(storey)));
  return fields;
}

const AnswerFields<PlanHole>& answerFields(const PlanHole* hole) {
  static const auto fields =
      withBases<PlanHole>({{"unseen_m2", &PlanHole::unseen_m2}}, answerFields(static_cast<const PlanCoverage*>(hole)),
                          answerFields(static_cast<const ProductIdentity*>(hole)));
  return fields;
}

const AnswerFields<PlanPatch>& answerFields(const PlanPatch* patch) {
  using A = PlanPatch;
  static const auto fields = withBases<A>(
      {{"area_m2", &A::area_m2}, {"spacing_m", &A::spacing_m}, {"at", &A::at}, {"reason", &A::reason, kLeftOut}},
      answerFields(static_cast<const ProductIdentity*>(patch)));
  return fields;
}

std::vector<PlanPatch> patchesOf(const std::vector<SurfaceHole>& holes, const Environment& environment,
                                 const Eigen::Vector3d& shift_m) {
  std::vector<PlanPatch> patches;
  for (const auto& hole : holes)
    patches.push_back({identityOf(environment.products[hole.product]),
                       hole.area_m2,
                       hole.spacing_m,
                       hole.at + shift_m,
                       hole.shape,
                       {}});
  return patches;
}

const AnswerFields<PlanStation>& answerFields(const PlanStation*) {
  using A = PlanStation;
  static const AnswerFields<A> fields = {{"station", &A::station},
                                         {"seen_m2", &A::seen_m2},
                                         {"points", &A::points},
                                         {"instrument_seconds", &A::instrument_seconds},
                                         {"bytes", &A::bytes}};
  return fields;
}

const AnswerFields<PlanPair>& answerFields(const PlanPair*) {
  using A = PlanPair;
  static const AnswerFields<A> fields = {{"a", &A::a},       {"b", &A::b},       {"common_m2", &A::common_m2},
                                         {"of_a", &A::of_a}, {"of_b", &A::of_b}, {"overlap", &A::overlap}};
  return fields;
}

const AnswerFields<PlanProposal>& answerFields(const PlanProposal*) {
  static const AnswerFields<PlanProposal> fields = {{"at", &PlanProposal::at}, {"adds_m2", &PlanProposal::adds_m2}};
  return fields;
}

const AnswerFields<PlanAnswer>& answerFields(const PlanAnswer* answer) {
  using A = PlanAnswer;
  static const auto fields = withBases<A>({{"area_m2", &A::area_m2},
                                           {"samples", &A::samples},
                                           {"coverage_sigma", &A::coverage_sigma},
                                           {"classes", &A::classes},
                                           {"storeys", &A::storeys},
                                           {"holes", &A::holes},
                                           {"patches", &A::patches},
                                           {"stations", &A::stations},
                                           {"points", &A::points},
                                           {"instrument_seconds", &A::instrument_seconds},
                                           {"bytes", &A::bytes},
                                           {"pairs", &A::pairs},
                                           {"proposed", &A::proposed}},
                                          answerFields(static_cast<const PlanCoverage*>(answer)));
  return fields;
}

Result<Answered<PlanAnswer>> runPlan(const Document& document, const PlanOptions& options, Progress& progress) {
  TRY_ASSIGN(auto request, planRequestFrom(document, options));
  Answered<PlanAnswer> outcome{document};
  noteDefaultRules(document, outcome.report);
  TRY_ASSIGN(auto assignment, scanAssignment(document, progress));
  const ScanWorld world = scanWorld(document.environment(), document.job->targets, assignment);
  if (sceneTriangleCount(*world.environment) == 0)
    return failure(ErrorKind::unusable,
                   "the scene contains no products to plan for; import a model, or include products again");
  TRY_ASSIGN(auto scene, RayScene::build(world.environment, progress, world.balls));
  TRY_ASSIGN(auto plan, planSurvey(*document.job, scene, std::make_shared<const MaterialAssignment>(world.assignment),
                                   request, progress));
  TRY_ASSIGN(auto proposal, proposalFor(document, *scene, plan, request, progress));
  outcome.answer = answerOf(plan, *world.environment, document.georeference->shift_m);
  outcome.answer.proposed = proposal;
  outcome.description =
      fmt::format("{} station{} would cover {:.1f} % of {:.0f} m2", plan.stations.size(),
                  plan.stations.size() == 1 ? "" : "s", plan.all.coverage() * 100, outcome.answer.exposed_m2);
  outcome.text = textOf(plan, outcome.answer);
  return outcome;
}

}  // namespace standpoint
