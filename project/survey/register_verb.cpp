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

json linkRow(const Job& job, const TargetRegistration& r, const NetworkLink& link) {
  json rows = json::array();
  for (const auto& row : link.rows)
    rows.push_back({{"target", r.target_names[row.target]},
                    {"dx_m", row.difference_m.x()},
                    {"dy_m", row.difference_m.y()},
                    {"dz_m", row.difference_m.z()},
                    {"d3_m", row.difference_m.norm()}});
  return {{"from", job.stations[r.station_of[link.from]].name},
          {"to", job.stations[r.station_of[link.to]].name},
          {"targets", link.rows.size()},
          {"rms_m", link.rms_m},
          {"mean_m", link.mean_m},
          {"unbiased_m", link.unbiased_m ? json(*link.unbiased_m) : json(nullptr)},
          {"differences", std::move(rows)}};
}

json targetRows(const Job& job, const TargetRegistration& r, const Vector3d& shift_m) {
  json rows = json::array();
  for (std::size_t t = 0; t < r.network.targets; ++t) {
    if (!r.fit.target[t]) continue;
    json from = json::array();
    for (std::size_t i = 0; i < r.network.sightings.size(); ++i) {
      const auto& s = r.network.sightings[i];
      if (s.target != t) continue;
      const Vector3d& d = r.fit.residual_m[i];
      from.push_back({{"station", job.stations[r.station_of[s.station]].name},
                      {"dx_m", d.x()},
                      {"dy_m", d.y()},
                      {"dz_m", d.z()},
                      {"d3_m", d.norm()}});
    }
    json row = {{"name", r.target_names[t]},
                {"at", toJson(Vector3d(*r.fit.target[t] + shift_m))},
                {"residuals", std::move(from)}};
    for (const auto& target : job.targets)
      if (target.name == r.target_names[t]) row["true_error_m"] = (*r.fit.target[t] - target.centre).norm();
    rows.push_back(std::move(row));
  }
  return rows;
}

json measuredRows(const Job& job, const TargetMeasurements& measured) {
  json found = json::array(), missed = json::array();
  for (const auto& m : measured.found) {
    const auto& station = job.stations[m.station];
    const auto& target = job.targets[m.target];
    json row = {{"station", station.name},
                {"target", target.name},
                {"centre", toJson(m.fit.centre)},
                {"sigma_m", toJson(m.fit.sigma_m())},
                {"points", m.fit.points},
                {"residual_m", m.fit.residual_m},
                {"true_error_m", (m.fit.centre - trueCentre(station, target)).norm()}};
    if (target.kind == TargetKind::checkerboard) row["incidence_deg"] = m.fit.incidence_rad / kRadPerDeg;
    found.push_back(std::move(row));
  }
  for (const auto& m : measured.missed)
    missed.push_back(
        {{"station", job.stations[m.station].name}, {"target", job.targets[m.target].name}, {"why", m.why}});
  return {{"found", std::move(found)}, {"missed", std::move(missed)}};
}

json stationRow(const Station& station, const Pose& solved, const Vector3d& shift_m) {
  Pose shown = solved;
  shown.translation += shift_m;
  return {{"name", station.name},
          {"solved_pose", poseToJson(shown)},
          {"true_error_m", (solved.translation - station.true_pose.translation).norm()},
          {"true_turn_error_deg", solved.rotation.angularDistance(station.true_pose.rotation) / kRadPerDeg}};
}

json registrationRows(const Job& job, const TargetRegistration& r, const Vector3d& shift_m) {
  json stations = json::array(), links = json::array();
  for (std::size_t i = 0; i < r.network.stations; ++i) {
    json row = stationRow(job.stations[r.station_of[i]], r.fit.pose[i], shift_m);
    row["held"] = r.network.held && r.network.held->first == i;
    row["sigma_shift_m"] = toJson(r.fit.sigma_shift_m[i]);
    row["sigma_turn_deg"] = toJson(Vector3d(r.fit.sigma_turn_rad[i] / kRadPerDeg));
    stations.push_back(std::move(row));
  }
  double mean = 0, count = 0;
  for (const auto& link : r.links) {
    links.push_back(linkRow(job, r, link));
    mean += link.mean_m * static_cast<double>(link.rows.size()), count += static_cast<double>(link.rows.size());
  }
  return {
      {"stations", std::move(stations)},        {"links", std::move(links)},
      {"targets", targetRows(job, r, shift_m)}, {"mean_target_error_m", count > 0 ? json(mean / count) : json(nullptr)},
      {"sigma_factor", r.fit.sigma_factor},     {"redundancy", r.fit.redundancy},
      {"wrong_matches", r.wrong_matches}};
}

// What people read: links as office software lists them, and what only a simulation can say beside it. Millimetres.
std::string textOf(const json& answer) {
  std::string text;
  const auto mm = [](const json& metres) {
    return metres.is_null() ? std::string("–") : fmt::format("{:.2f}", metres.get<double>() * 1000);
  };
  for (const auto& link : answer.value("links", json::array())) {
    text += fmt::format("{} – {}: {} targets, {} mm RMS, mean {} mm, unbiased {} mm\n", link["from"].get<std::string>(),
                        link["to"].get<std::string>(), link["targets"].get<int>(), mm(link["rms_m"]),
                        mm(link["mean_m"]), mm(link["unbiased_m"]));
    for (const auto& d : link["differences"])
      text += fmt::format("    {:12}  dx {:>7}  dy {:>7}  dz {:>7}  3D {:>7} mm\n", d["target"].get<std::string>(),
                          mm(d["dx_m"]), mm(d["dy_m"]), mm(d["dz_m"]), mm(d["d3_m"]));
  }
  for (const auto& s : answer.at("stations"))
    text += fmt::format("{}: true error {} mm and {:.4f}°\n", s["name"].get<std::string>(), mm(s["true_error_m"]),
                        s["true_turn_error_deg"].get<double>());
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
Result<json> byClouds(Job& job, const TargetMeasurements& measured, std::size_t held, const RegisterOptions& options,
                      const Vector3d& shift_m, Report& report, Progress& progress) {
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
  json stations = json::array({stationRow(job.stations[held], job.stations[held].true_pose, shift_m)});
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
    json row = stationRow(station, fit->to_from, shift_m);
    row["fit"] = toJson(*fit);
    stations.push_back(std::move(row));
    station.solved_pose = fit->to_from;
    placed.push_back({fit->to_from, scan->sample});
  }
  return json{{"stations", std::move(stations)}};
}

Result<json> byTargets(Job& job, const TargetMeasurements& measured, std::size_t held, const RegisterOptions& options,
                       const Vector3d& shift_m, Report& report) {
  RegistrationRequest request;
  request.held = held;
  request.matching = options.by;
  if (!options.control.empty()) {
    TRY_ASSIGN(auto control, readControlPoints(options.control, shift_m));
    request.control = std::move(control);
    job.control_points = request.control;
  }
  TRY_ASSIGN(const auto r, registerByTargets(job, measured, request, report));
  json answer = registrationRows(job, r, shift_m);
  answer["measured"] = measuredRows(job, measured);
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

Result<Outcome> runRegister(const Document& document, const RegisterOptions& options, Progress& progress) {
  const bool cloud = options.cloud;
  if (cloud && !options.control.empty())
    return failure(ErrorKind::usage, "--cloud and --control cannot be combined", "--control");
  if (!cloud && document.job->targets.size() < 3)
    return failure(ErrorKind::usage, fmt::format("the project has {} targets, at least three are required: add targets "
                                                 "with `target` before scanning, or register with --cloud",
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
                   "a single station cannot be registered: specify scans of at least two, or use --control", "files");
  Outcome outcome{document, json::object(), measured.report, {}};
  Job job = *document.job;
  TRY_ASSIGN(const auto held, heldStation(job, measured, options));
  const Vector3d& shift_m = document.georeference->shift_m;
  TRY_ASSIGN(auto answer, cloud ? byClouds(job, measured, held, options, shift_m, outcome.report, progress)
                                : byTargets(job, measured, held, options, shift_m, outcome.report));
  outcome.answer = std::move(answer);
  outcome.text = textOf(outcome.answer);
  if (!written.empty()) {
    TRY(writeRegistered(job, shift_m, request.files, written, outcome.report, progress));
    for (const auto& file : written) outcome.answer["files"].push_back(file.string());
  }
  outcome.description =
      fmt::format("Registered {} stations {}", measured.scans.size(), cloud ? "cloud to cloud" : "by targets");
  outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
