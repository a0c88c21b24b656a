// SPDX-License-Identifier: GPL-3.0-or-later
#include "project/survey/register_verb.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/random.h"
#include "core/units.h"
#include "project/answers.h"
#include "survey/registration/cloud_fit.h"
#include "survey/registration/registered_clouds.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using nlohmann::json;

Vector3d trueCentre(const Station& station, const Target& target) {
  return station.true_pose.rotation.conjugate() * (target.centre - station.true_pose.translation);
}

RegisterLink linkRow(const Job& job, const TargetRegistration& r, const NetworkLink& link) {
  RegisterLink row{job.stations[r.station_of[link.from]].name,
                   job.stations[r.station_of[link.to]].name,
                   link.rows.size(),
                   link.rms_m,
                   link.mean_m,
                   link.unbiased_m,
                   {}};
  for (const auto& [target, d] : link.rows)
    row.differences.push_back({r.target_names[target], d.x(), d.y(), d.z(), d.norm()});
  return row;
}

std::vector<RegisteredTarget> targetRows(const Job& job, const TargetRegistration& r, const Vector3d& shift_m) {
  std::vector<RegisteredTarget> rows;
  for (std::size_t t = 0; t < r.network.targets; ++t) {
    if (!r.fit.target[t]) continue;
    RegisteredTarget row{r.target_names[t], *r.fit.target[t] + shift_m, {}, {}};
    for (std::size_t i = 0; i < r.network.sightings.size(); ++i) {
      const auto& s = r.network.sightings[i];
      if (s.target != t) continue;
      const Vector3d& d = r.fit.residual_m[i];
      row.residuals.push_back({job.stations[r.station_of[s.station]].name, d.x(), d.y(), d.z(), d.norm()});
    }
    for (const auto& target : job.targets)
      if (target.name == r.target_names[t]) row.true_error_m = (*r.fit.target[t] - target.centre).norm();
    rows.push_back(std::move(row));
  }
  return rows;
}

RegisterMeasurements measuredRows(const Job& job, const TargetMeasurements& measured) {
  RegisterMeasurements rows;
  for (const auto& m : measured.found) {
    const auto& station = job.stations[m.station];
    const auto& target = job.targets[m.target];
    RegisterMeasured row{station.name,
                         target.name,
                         m.fit.centre,
                         m.fit.sigma_m(),
                         m.fit.points,
                         m.fit.residual_m,
                         (m.fit.centre - trueCentre(station, target)).norm(),
                         {}};
    if (target.kind == TargetKind::checkerboard) row.incidence_rad = m.fit.incidence_rad;
    rows.found.push_back(std::move(row));
  }
  for (const auto& m : measured.missed)
    rows.missed.push_back({job.stations[m.station].name, job.targets[m.target].name, m.why});
  return rows;
}

RegisteredStation stationRow(const Station& station, const Pose& solved, const Vector3d& shift_m) {
  RegisteredStation row;
  row.name = station.name;
  row.solved_pose = solved;
  row.solved_pose.translation += shift_m;
  row.true_error_m = (solved.translation - station.true_pose.translation).norm();
  row.true_turn_error_rad = solved.rotation.angularDistance(station.true_pose.rotation);
  return row;
}

RegisterAnswer answerOf(const Job& job, const TargetRegistration& r, const TargetMeasurements& measured,
                        const Vector3d& shift_m) {
  RegisterAnswer answer;
  for (std::size_t i = 0; i < r.network.stations; ++i) {
    auto row = stationRow(job.stations[r.station_of[i]], r.fit.pose[i], shift_m);
    row.held = r.network.held && r.network.held->first == i;
    row.sigma_shift_m = r.fit.sigma_shift_m[i];
    row.sigma_turn_rad = r.fit.sigma_turn_rad[i];
    answer.stations.push_back(std::move(row));
  }
  double mean = 0, count = 0;
  answer.links.emplace();
  for (const auto& link : r.links) {
    answer.links->push_back(linkRow(job, r, link));
    mean += link.mean_m * static_cast<double>(link.rows.size()), count += static_cast<double>(link.rows.size());
  }
  answer.targets = targetRows(job, r, shift_m);
  answer.mean_target_error_m.emplace();
  if (count > 0) *answer.mean_target_error_m = mean / count;
  answer.sigma_factor = r.fit.sigma_factor;
  answer.redundancy = r.fit.redundancy;
  answer.wrong_matches = r.wrong_matches;
  answer.measured = measuredRows(job, measured);
  return answer;
}

// What people read: links as office software lists them, and what only a simulation can say beside it. Millimetres.
std::string textOf(const RegisterAnswer& answer) {
  std::string text;
  const auto mm = [](const std::optional<double>& metres) {
    return metres ? fmt::format("{:.2f}", *metres * 1000) : std::string("–");
  };
  for (const auto& link : answer.links.value_or(std::vector<RegisterLink>())) {
    text += fmt::format("{} – {}: {} targets, {} mm RMS, mean {} mm, unbiased {} mm\n", link.from, link.to,
                        link.targets, mm(link.rms_m), mm(link.mean_m), mm(link.unbiased_m));
    for (const auto& d : link.differences)
      text += fmt::format("    {:12}  dx {:>7}  dy {:>7}  dz {:>7}  3D {:>7} mm\n", d.target, mm(d.dx_m), mm(d.dy_m),
                          mm(d.dz_m), mm(d.d3_m));
  }
  for (const auto& s : answer.stations)
    text += fmt::format("{}: true error {} mm and {:.4f}°\n", s.name, mm(s.true_error_m),
                        s.true_turn_error_rad / kRadPerDeg);
  return text;
}

// How an operator lays one cloud beside another by eye, before the fit.
constexpr double kByEye_m = 0.15, kByEye_rad = 1.5 * kRadPerDeg;

Pose laidByEye(const Station& station, std::uint64_t seed) {
  const auto r = philox({seed, static_cast<std::uint32_t>(stableHash(station.name.c_str()))}, 0, 0, 602);
  const auto either = [](std::uint32_t x) { return 2 * uniform(x) - 1; };
  Pose pose = station.true_pose;
  pose.translation += kByEye_m * Vector3d(either(r[0]), either(r[1]), either(r[2]));
  pose.rotation = Eigen::AngleAxisd(kByEye_rad * either(r[3]), Vector3d::UnitZ()) * pose.rotation;
  return pose;
}

// Where the user has laid it by hand instead: moved and turned about itself in plan.
Pose laidByHand(Pose pose, const std::optional<StartOffset>& offset) {
  if (!offset) return pose;
  pose.translation += Vector3d(offset->x_m, offset->y_m, 0);
  pose.rotation = Eigen::AngleAxisd(offset->turn_deg * kRadPerDeg, Vector3d::UnitZ()) * pose.rotation;
  return pose;
}

Result<std::size_t> heldStation(const Job& job, const TargetMeasurements& measured, const RegisterOptions& options) {
  if (options.fix.empty()) return measured.scans.front().station;
  const auto& name = options.fix;
  for (std::size_t i = 0; i < job.stations.size(); ++i)
    if (job.stations[i].name == name) return i;
  return failure(ErrorKind::usage, fmt::format("unknown station '{}'", name), "--fix");
}

// Station by station, each to all that are placed already; the held one first.
Result<RegisterAnswer> byClouds(Job& job, const TargetMeasurements& measured, std::size_t held,
                                const RegisterOptions& options, const Vector3d& shift_m, Report& report,
                                Progress& progress) {
  std::vector<PlacedCloud> placed;
  std::vector<const ScannedStation*> waiting;
  for (const auto& s : measured.scans) {
    if (s.station != held) {
      waiting.push_back(&s);
      continue;
    }
    placed.push_back({job.stations[held].true_pose, s.sample});
    job.stations[held].solved_pose = job.stations[held].true_pose;
  }
  if (placed.empty())
    return failure(ErrorKind::usage, fmt::format("none of the files contains station {}", job.stations[held].name),
                   "--fix");
  RegisterAnswer answer;
  answer.stations.push_back(stationRow(job.stations[held], job.stations[held].true_pose, shift_m));
  for (const auto* scan : waiting) {
    Station& station = job.stations[scan->station];
    progress.stage("Fitting " + station.name, 0.9, 1);
    const auto start = laidByHand(laidByEye(station, options.seed), options.start_offset);
    const auto fit = fitCloudToClouds(scan->sample, start, placed, options.reach_m, progress);
    if (!fit)
      return failure(fit.error().kind, fmt::format("station {}: {}", station.name, fit.error().message), scan->file);
    for (const auto& motion : fit->free)
      report.warn(station.name,
                  fmt::format("the other scans do not constrain it {}: start position kept", describe(motion)));
    if (!fit->settled) report.warn(station.name, fmt::format("not converged after {} iterations", fit->iterations));
    if (fit->used_fraction < 0.3)
      report.warn(station.name, fmt::format("only {:.0f} % of points overlap the other scans: too little overlap",
                                            fit->used_fraction * 100));
    answer.stations.push_back(stationRow(station, fit->to_from, shift_m));
    answer.stations.back().fit = *fit;
    station.solved_pose = fit->to_from;
    placed.push_back({fit->to_from, scan->sample});
  }
  return answer;
}

Result<RegisterAnswer> byTargets(Job& job, const TargetMeasurements& measured, std::size_t held,
                                 const RegisterOptions& options, const Vector3d& shift_m, Report& report) {
  RegistrationRequest request;
  request.held = held;
  request.matching = options.by;
  if (!options.control.empty()) {
    TRY_ASSIGN(auto control, readControlPoints(options.control, shift_m));
    request.control = std::move(control);
    job.control_points = request.control;
  }
  TRY_ASSIGN(const auto r, registerByTargets(job, measured, request, report));
  auto answer = answerOf(job, r, measured, shift_m);
  for (std::size_t i = 0; i < r.station_of.size(); ++i) job.stations[r.station_of[i]].solved_pose = r.fit.pose[i];
  return answer;
}

}  // namespace

std::span<const Choice<TargetMatching>> choices(TargetMatching) {
  static constexpr std::array kMatchings = {Choice<TargetMatching>{"names", TargetMatching::by_names},
                                            Choice<TargetMatching>{"geometry", TargetMatching::by_geometry}};
  return kMatchings;
}

Result<StartOffset> FieldValue<StartOffset>::read(const json& value) {
  const auto& text = value.get_ref<const std::string&>();
  const auto numbers = parseNumbers(text);
  if (!numbers || numbers->size() != 3 || !vectorFrom(*numbers).allFinite())
    return failure(ErrorKind::usage, fmt::format("'{}' must be three numbers: x,y,turn in m and degrees", text));
  const auto v = vectorFrom(*numbers);
  return StartOffset{v.x(), v.y(), v.z()};
}

json FieldValue<StartOffset>::write(const StartOffset& offset) {
  return fmt::format("{},{},{}", offset.x_m, offset.y_m, offset.turn_deg);
}

const Fields<RegisterOptions>& registerFields() {
  using O = RegisterOptions;
  static const Fields<O> fields = {
      {"files", &O::files, "the scans (E57, PTX), one of each station", {.positional = true, .required = true}},
      {"fix", &O::fix, "station that keeps its pose (default: the first)"},
      {"by", &O::by, "match targets by their names, or by the distances between them"},
      {"control", &O::control, "text file of control points: name X Y Z [sigma in mm]"},
      {"cloud", &O::cloud, "register cloud to cloud instead of by targets"},
      {"output", &O::output,
       "a folder for copies of the scans with their solved poses, or a file for a single scan file"},
      {"reach",
       &O::reach_m,
       "maximum distance of a point from its surface for --cloud",
       {.unit = "m", .minimum = 0.01, .maximum = 100}},
      {"start-offset", &O::start_offset,
       "x,y,turn for --cloud, in m and degrees: offset of each scan before the fit from the rough alignment by eye"},
      {"click",
       &O::click_m,
       "maximum distance of the operator's click from the target; the measurement starts there",
       {.unit = "m", .minimum = 0, .maximum = 0.5}},
      {"seed", &O::seed, "seed of the operator's hand", {.minimum = 0, .maximum = 9007199254740991.0}}};
  return fields;
}

const AnswerFields<TargetDifference>& answerFields(const TargetDifference*) {
  using A = TargetDifference;
  static const AnswerFields<A> fields = {
      {"target", &A::target}, {"dx_m", &A::dx_m}, {"dy_m", &A::dy_m}, {"dz_m", &A::dz_m}, {"d3_m", &A::d3_m}};
  return fields;
}

const AnswerFields<RegisterLink>& answerFields(const RegisterLink*) {
  using A = RegisterLink;
  static const AnswerFields<A> fields = {{"from", &A::from},
                                         {"to", &A::to},
                                         {"targets", &A::targets},
                                         {"rms_m", &A::rms_m},
                                         {"mean_m", &A::mean_m},
                                         {"unbiased_m", &A::unbiased_m},
                                         {"differences", &A::differences}};
  return fields;
}

const AnswerFields<StationResidual>& answerFields(const StationResidual*) {
  using A = StationResidual;
  static const AnswerFields<A> fields = {
      {"station", &A::station}, {"dx_m", &A::dx_m}, {"dy_m", &A::dy_m}, {"dz_m", &A::dz_m}, {"d3_m", &A::d3_m}};
  return fields;
}

const AnswerFields<RegisteredTarget>& answerFields(const RegisteredTarget*) {
  using A = RegisteredTarget;
  static const AnswerFields<A> fields = {
      {"name", &A::name}, {"at", &A::at}, {"residuals", &A::residuals}, {"true_error_m", &A::true_error_m, kLeftOut}};
  return fields;
}

const AnswerFields<RegisterMeasured>& answerFields(const RegisterMeasured*) {
  using A = RegisterMeasured;
  static const AnswerFields<A> fields = {{"station", &A::station},
                                         {"target", &A::target},
                                         {"centre", &A::centre_m},
                                         {"sigma_m", &A::sigma_m},
                                         {"points", &A::points},
                                         {"residual_m", &A::residual_m},
                                         {"true_error_m", &A::true_error_m},
                                         {"incidence_deg", &A::incidence_rad, answers::degrees, kLeftOut}};
  return fields;
}

const AnswerFields<RegisterMissed>& answerFields(const RegisterMissed*) {
  using A = RegisterMissed;
  static const AnswerFields<A> fields = {{"station", &A::station}, {"target", &A::target}, {"why", &A::why}};
  return fields;
}

const AnswerFields<RegisterMeasurements>& answerFields(const RegisterMeasurements*) {
  using A = RegisterMeasurements;
  static const AnswerFields<A> fields = {{"found", &A::found}, {"missed", &A::missed}};
  return fields;
}

const AnswerFields<RegisteredStation>& answerFields(const RegisteredStation*) {
  using A = RegisteredStation;
  static const AnswerFields<A> fields = {{"name", &A::name},
                                         {"solved_pose", &A::solved_pose},
                                         {"true_error_m", &A::true_error_m},
                                         {"true_turn_error_deg", &A::true_turn_error_rad, answers::degrees},
                                         {"held", &A::held, kLeftOut},
                                         {"sigma_shift_m", &A::sigma_shift_m, kLeftOut},
                                         {"sigma_turn_deg", &A::sigma_turn_rad, answers::degreesOfEach, kLeftOut},
                                         {"fit", &A::fit, kLeftOut}};
  return fields;
}

const AnswerFields<RegisterAnswer>& answerFields(const RegisterAnswer*) {
  using A = RegisterAnswer;
  static const AnswerFields<A> fields = {{"stations", &A::stations},
                                         {"links", &A::links, kLeftOut},
                                         {"targets", &A::targets, kLeftOut},
                                         {"mean_target_error_m", &A::mean_target_error_m, kLeftOut},
                                         {"sigma_factor", &A::sigma_factor, kLeftOut},
                                         {"redundancy", &A::redundancy, kLeftOut},
                                         {"wrong_matches", &A::wrong_matches, kLeftOut},
                                         {"measured", &A::measured, kLeftOut},
                                         {"files", &A::files, kLeftOut}};
  return fields;
}

Result<Answered<RegisterAnswer>> runRegister(const Document& document, const RegisterOptions& options,
                                             Progress& progress) {
  const bool cloud = options.cloud;
  if (cloud && !options.control.empty())
    return failure(ErrorKind::usage, "--cloud and --control cannot be combined", "--control");
  if (!cloud && document.job->targets.size() < 3)
    return failure(ErrorKind::usage, fmt::format("the project has {} targets, at least three are required: add targets "
                                                 "before scanning, or register cloud to cloud",
                                                 document.job->targets.size()));
  MeasuringRequest request;
  request.files = options.files;
  std::vector<std::filesystem::path> written;
  if (!options.output.empty()) {
    TRY_ASSIGN(auto to, registeredFiles(request.files, options.output));
    written = std::move(to);
  }
  request.seed = options.seed;
  request.click_m = options.click_m;
  request.targets = !cloud, request.sample = cloud;
  TRY_ASSIGN(const auto measured, measureTargets(*document.job, request, progress));
  if (measured.scans.size() < (options.control.empty() ? 2U : 1U))
    return failure(ErrorKind::usage,
                   "a single station cannot be registered: specify scans of at least two, or use control points",
                   "files");
  Answered<RegisterAnswer> outcome{document, {}, measured.report};
  Job job = *document.job;
  TRY_ASSIGN(const auto held, heldStation(job, measured, options));
  const Vector3d& shift_m = document.georeference->shift_m;
  TRY_ASSIGN(auto answer, cloud ? byClouds(job, measured, held, options, shift_m, outcome.report, progress)
                                : byTargets(job, measured, held, options, shift_m, outcome.report));
  outcome.answer = std::move(answer);
  outcome.text = textOf(outcome.answer);
  if (!written.empty()) {
    TRY(writeRegistered(job, shift_m, request.files, written, outcome.report, progress));
    outcome.answer.files = written;
  }
  outcome.description =
      fmt::format("Registered {} stations {}", measured.scans.size(), cloud ? "cloud to cloud" : "by targets");
  outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
