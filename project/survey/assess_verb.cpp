// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/assess_verb.h"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

#include "core/data_folder.h"
#include "core/output_place.h"
#include "core/units.h"
#include "project/survey/scan_request.h"
#include "survey/scanning/scan_world.h"

namespace standpoint {

namespace {

constexpr std::size_t kListedHoles = 30, kToldHoles = 8, kSketchedGaps = 12;
constexpr std::size_t kSketched = 6000;  // places of the surface

Result<QualityRequest> qualityRequestFrom(const Document& document, const AssessOptions& options) {
  QualityRequest request;
  const auto& all = document.job->stations;
  if (std::none_of(all.begin(), all.end(), [](const Station& s) { return !s.scans.empty(); }))
    return failure(ErrorKind::unusable, "the project has no scans to assess; scan from a station first");
  TRY_ASSIGN(request.stations, stationsFrom(*document.job, options.stations));
  request.limits = qualityLimits(options.profile);
  if (!options.limits.empty()) {
    TRY_ASSIGN(request.limits, readQualityLimits(options.limits, std::move(request.limits)));
  }
  if (!document.job->targets.empty()) {
    TRY_ASSIGN(const auto kinds, readTargetKinds(dataFolder() / "scanners" / "targets" / "kinds.json"));
    request.target_rules = kinds.rules;
  }
  request.radius_m = options.radius_m;
  request.shift_m = document.georeference->shift_m;
  return request;
}

Result<void> checkReport(const std::filesystem::path& file) {
  if (file.empty()) return {};
  if (file.extension() != ".html" && file.extension() != ".csv")
    return failure(ErrorKind::usage, "unsupported report format: use .html or .csv", "--output");
  return checkFolderOf(file, "--output");
}

std::optional<AssessPlace> placeOf(const WorstPlace& worst, const Environment& environment,
                                   const Eigen::Vector3d& shift_m) {
  AssessPlace place;
  if (worst.at) place.at = *worst.at + shift_m;
  if (worst.product) place.product = identityOf(environment.products[*worst.product]);
  place.stations = worst.stations;
  place.what = worst.what;
  return place.any() ? std::optional(place) : std::nullopt;
}

AssessRow rowOf(const QualityRow& row, const Environment& environment, const Eigen::Vector3d& shift_m) {
  AssessRow r{row.id, row.label, row.unit, row.value, {}, {}, {}, {}, {}, row.verdict, row.note, {}};
  if (row.limit) {
    r.good = row.limit->good;
    r.bad = row.limit->bad;
    r.good_text = goodText(*row.limit);
    r.bad_text = badText(*row.limit);
    r.limit_source = row.limit->source;
  }
  r.worst = placeOf(row.worst, environment, shift_m);
  return r;
}

void addHoles(AssessAnswer& answer, const SurveyQuality& quality, const Environment& environment) {
  const double each = quality.samples.each_m2();
  for (const auto& hole : quality.seen.holes) {
    if (quality.stations.empty() || answer.holes.size() == kListedHoles) return;
    PlanHole row;
    static_cast<ProductIdentity&>(row) = identityOf(environment.products[hole.product]);
    static_cast<PlanCoverage&>(row) = {each * static_cast<double>(hole.exposed), each * static_cast<double>(hole.seen),
                                       each * static_cast<double>(hole.twice), hole.coverage()};
    row.unseen_m2 = each * static_cast<double>(hole.exposed - hole.seen);
    answer.holes.push_back(row);
  }
}

void addStations(AssessAnswer& answer, const SurveyQuality& quality, const Job& job) {
  for (const auto& s : quality.scans)
    answer.scans.push_back({job.stations[s.station].name, s.file, s.points, s.stray_fraction, s.deviation_median_m,
                            s.deviation_95_m, s.noise_m, s.noise_ratio, s.moved});
  const auto name = [&](std::size_t k) { return job.stations[quality.stations[k].station].name; };
  for (std::size_t k = 0; k < quality.stations.size(); ++k) {
    const auto& s = quality.stations[k];
    answer.stations.push_back({name(k), quality.seen.seen_m2[k], s.pose_error_m, s.pose_error_rad, s.targets});
  }
  for (const auto& p : quality.seen.pairs)
    answer.pairs.push_back({name(p.a), name(p.b), p.common_m2, p.of_a, p.of_b, p.overlap()});
}

void addSketch(AssessSketch& sketch, const SurveyQuality& quality, const Job& job, const Eigen::Vector3d& shift_m) {
  const auto& samples = quality.samples.samples;
  const std::size_t step = samples.size() / kSketched + 1;
  for (std::size_t k = 0; k < samples.size(); k += step) {
    if (!samples[k].exposed) continue;
    const bool seen = std::any_of(quality.stations.begin(), quality.stations.end(),
                                  [k](const StationQuality& s) { return s.seen[k] != 0; });
    sketch.surface.push_back({(samples[k].place.position + shift_m).head<2>(), seen});
  }
  for (const auto& patch : std::span(quality.patches).first(std::min(kSketchedGaps, quality.patches.size()))) {
    auto& gap = sketch.gaps.emplace_back();
    gap.at = (patch.at + shift_m).head<2>();
    const auto& shape = patch.shape;
    for (const auto& [a, b] : rimOf({shape.squares.begin(), shape.squares.end()}))
      gap.rim.push_back({(shape.corner(a) + shift_m).head<2>(), (shape.corner(b) + shift_m).head<2>()});
  }
  for (const auto& s : quality.stations) {
    const auto& station = job.stations[s.station];
    sketch.stations.push_back({station.name, (station.true_pose.translation + shift_m).head<2>()});
  }
}

AssessAnswer answerOf(const SurveyQuality& quality, const Document& document, const Environment& environment,
                      const AssessOptions& options) {
  const auto& shift_m = document.georeference->shift_m;
  AssessAnswer answer;
  answer.project = document.name;
  answer.profile = FieldValue<QualityProfile>::write(options.profile);
  answer.limits = options.limits.filename().string();
  answer.radius_m = quality.radius_m;
  answer.exposed_m2 = quality.samples.each_m2() * static_cast<double>(quality.seen.all.exposed);
  answer.samples = quality.samples.samples.size();
  for (const auto& row : quality.rows) {
    answer.rows.push_back(rowOf(row, environment, shift_m));
    std::size_t* const counts[] = {&answer.good, &answer.warn, &answer.bad, &answer.unknown};
    ++*counts[static_cast<int>(row.verdict)];
  }
  addStations(answer, quality, *document.job);
  addHoles(answer, quality, environment);
  answer.patches = patchesOf(quality.patches, environment, shift_m);
  addSketch(answer.sketch, quality, *document.job, shift_m);
  return answer;
}

std::string placeText(const AssessRow& row) {
  if (!row.worst) return {};
  std::string text;
  if (!row.worst->stations.empty()) text += fmt::format(" {}", fmt::join(row.worst->stations, " – "));
  if (const auto& p = row.worst->product) text += fmt::format(" {} {} {}", p->ifc_class, p->id, p->name);
  if (const auto& at = row.worst->at) text += fmt::format(" at {:.2f},{:.2f},{:.2f}", at->x(), at->y(), at->z());
  return text;
}

std::string textOf(const AssessAnswer& answer) {
  std::string text = fmt::format("{}, by {}\n", verdictText(answer), answer.profile);
  for (const auto& row : answer.rows) {
    text += fmt::format("{:8} {:21} {:>10}   {:10} {:14}", row.verdict == Verdict::warn ? "check" : nameOf(row.verdict),
                        row.label, row.good_text.empty() ? "" : valueText(row), row.good_text,
                        row.bad_text.empty() ? "" : "bad " + row.bad_text);
    if (!row.note.empty()) text += " " + row.note;
    if (row.verdict != Verdict::good && !row.good_text.empty() && row.worst)
      text += (row.note.empty() ? "" : ";") + placeText(row);
    while (text.back() == ' ') text.pop_back();
    text += "\n";
  }
  for (const auto& hole : std::span(answer.holes).first(std::min(kToldHoles, answer.holes.size())))
    text += fmt::format("not covered: {:8.2f} m2 of {} {} {}\n", hole.unseen_m2, hole.ifc_class, hole.id, hole.name);
  return text;
}

}  // namespace

std::span<const Choice<QualityProfile>> choices(QualityProfile) {
  static constexpr std::array kProfiles = {Choice<QualityProfile>{"LOA20", QualityProfile::loa20},
                                           Choice<QualityProfile>{"LOA30", QualityProfile::loa30},
                                           Choice<QualityProfile>{"LOA40", QualityProfile::loa40}};
  return kProfiles;
}

const Fields<AssessOptions>& assessFields() {
  using O = AssessOptions;
  static const Fields<O> fields = {
      {"stations", &O::stations, "all, or names separated by commas"},
      {"profile", &O::profile, "level of accuracy that the limits are for"},
      {"limits", &O::limits, "file (.json) of own limits in place of the profile's"},
      {"radius",
       &O::radius_m,
       "a point within it of a surface belongs to that surface; beyond, it is a stray point",
       {.unit = "m", .minimum = 0.005, .maximum = 1}},
      {"output", &O::output, "report to write (.html to print, .csv)"}};
  return fields;
}

const AnswerFields<AssessPlace>& answerFields(const AssessPlace*) {
  using A = AssessPlace;
  static const AnswerFields<A> fields = {{"at", &A::at, kLeftOut},
                                         {"product", &A::product, kLeftOut},
                                         {"stations", &A::stations, kLeftOut},
                                         {"what", &A::what, answers::nullWhereEmpty, kLeftOut}};
  return fields;
}

const AnswerFields<AssessRow>& answerFields(const AssessRow*) {
  using A = AssessRow;
  static const AnswerFields<A> fields = {{"id", &A::id},
                                         {"label", &A::label},
                                         {"value", &A::value},
                                         {"unit", &A::unit},
                                         {"good", &A::good, kLeftOut},
                                         {"bad", &A::bad, kLeftOut},
                                         {"limit_source", &A::limit_source, answers::nullWhereEmpty, kLeftOut},
                                         {"verdict", &A::verdict, [](Verdict v) { return std::string(nameOf(v)); }},
                                         {"note", &A::note, answers::nullWhereEmpty, kLeftOut},
                                         {"worst", &A::worst, kLeftOut}};
  return fields;
}

const AnswerFields<AssessScan>& answerFields(const AssessScan*) {
  using A = AssessScan;
  static const AnswerFields<A> fields = {{"station", &A::station},
                                         {"file", &A::file},
                                         {"points", &A::points},
                                         {"stray_fraction", &A::stray_fraction},
                                         {"deviation_median_m", &A::deviation_median_m},
                                         {"deviation_95_m", &A::deviation_95_m},
                                         {"noise_m", &A::noise_m},
                                         {"noise_ratio", &A::noise_ratio},
                                         {"moved", &A::moved}};
  return fields;
}

const AnswerFields<AssessStation>& answerFields(const AssessStation*) {
  using A = AssessStation;
  static const AnswerFields<A> fields = {{"station", &A::station},
                                         {"seen_m2", &A::seen_m2},
                                         {"pose_error_m", &A::pose_error_m, kLeftOut},
                                         {"pose_error_deg", &A::pose_error_rad, answers::degrees, kLeftOut},
                                         {"targets", &A::targets, kLeftOut}};
  return fields;
}

const AnswerFields<AssessAnswer>& answerFields(const AssessAnswer*) {
  using A = AssessAnswer;
  static const AnswerFields<A> fields = {{"profile", &A::profile},
                                         {"good", &A::good},
                                         {"warn", &A::warn},
                                         {"bad", &A::bad},
                                         {"unknown", &A::unknown},
                                         {"radius_m", &A::radius_m},
                                         {"exposed_m2", &A::exposed_m2},
                                         {"samples", &A::samples},
                                         {"rows", &A::rows},
                                         {"scans", &A::scans},
                                         {"stations", &A::stations},
                                         {"pairs", &A::pairs},
                                         {"holes", &A::holes},
                                         {"patches", &A::patches}};
  return fields;
}

std::string verdictText(const AssessAnswer& answer) {
  std::string text = fmt::format("{} good, {} to check, {} bad", answer.good, answer.warn, answer.bad);
  if (answer.unknown > 0) text += fmt::format(", {} not known", answer.unknown);
  return text;
}

std::string valueText(const AssessRow& row) {
  if (!row.value) return "–";
  const char* const separator = row.unit.empty() ? "" : " ";
  const double size = std::abs(*row.value);
  const int decimals = row.unit.empty() ? 0 : row.unit == "°" && size < 1 ? 4 : size < 10 ? 2 : 1;
  return fmt::format("{:.{}f}{}{}", *row.value, decimals, separator, row.unit);
}

Result<Answered<AssessAnswer>> runAssess(const Document& document, const AssessOptions& options, Progress& progress) {
  TRY(checkReport(options.output));
  TRY_ASSIGN(const auto request, qualityRequestFrom(document, options));
  Answered<AssessAnswer> outcome{document};
  noteDefaultRules(document, outcome.report);
  TRY_ASSIGN(const auto assignment, scanAssignment(document, progress));
  const ScanWorld world = scanWorld(document.environment(), document.job->targets, assignment);
  if (sceneTriangleCount(*document.environment()) == 0)
    return failure(ErrorKind::unusable,
                   "the scene contains no products to assess scans by; import a model, or include products again");
  TRY_ASSIGN(auto model, RayScene::build(document.environment(), progress));
  auto scene = model;
  if (!document.job->targets.empty()) {
    TRY_ASSIGN(scene, RayScene::build(world.environment, progress, world.balls));
  }
  TRY_ASSIGN(auto quality,
             assessSurvey(*document.job, scene, *model, std::make_shared<const MaterialAssignment>(world.assignment),
                          request, progress));
  outcome.answer = answerOf(quality, document, *world.environment, options);
  outcome.report.append(quality.report);
  if (!options.output.empty()) TRY(writeQualityReport(outcome.answer, options.output));
  outcome.description = "Assessed the scans: " + verdictText(outcome.answer);
  outcome.text = textOf(outcome.answer);
  return outcome;
}

}  // namespace standpoint
