// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "core/random.h"
#include "core/units.h"
#include "project/cloud_to_cloud.h"
#include "project/registered_clouds.h"
#include "project/registering.h"
#include "project/registration.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using nlohmann::json;

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
Result<Pose> laidByHand(Pose pose, const json& options) {
  if (!options.contains("start-offset")) return pose;
  const auto text = options["start-offset"].get<std::string>();
  double x_m = 0, y_m = 0, turn_deg = 0;
  int read = 0;
  const bool whole = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &x_m, &y_m, &turn_deg, &read) == 3 &&
                     static_cast<std::size_t>(read) == text.size();
  if (!whole || !std::isfinite(x_m + y_m + turn_deg))
    return failure(ErrorKind::usage, fmt::format("'{}' must be three numbers: x,y,turn in m and degrees", text),
                   "--start-offset");
  pose.translation += Vector3d(x_m, y_m, 0);
  pose.rotation = Eigen::AngleAxisd(turn_deg * kRadPerDeg, Vector3d::UnitZ()) * pose.rotation;
  return pose;
}

Result<std::size_t> heldStation(const Job& job, const TargetMeasurements& measured, const json& options) {
  if (!options.contains("fix")) return measured.scans.front().station;
  const auto name = options["fix"].get<std::string>();
  for (std::size_t i = 0; i < job.stations.size(); ++i)
    if (job.stations[i].name == name) return i;
  return failure(ErrorKind::usage, fmt::format("unknown station '{}'", name), "--fix");
}

// Station by station, each to all that are placed already; the held one first.
Result<json> byClouds(Job& job, const TargetMeasurements& measured, std::size_t held, const json& options,
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
    const auto start = laidByHand(laidByEye(station, options.at("seed").get<std::uint64_t>()), options);
    if (!start) return failure(start.error());
    const auto fit = fitCloudToClouds(scan->sample, *start, placed, options.at("reach").get<double>(), progress);
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

Result<json> byTargets(Job& job, const TargetMeasurements& measured, std::size_t held, const json& options,
                       const Vector3d& shift_m, Report& report) {
  RegistrationRequest request;
  request.held = held;
  request.matching = options.at("by") == "geometry" ? TargetMatching::by_geometry : TargetMatching::by_names;
  if (options.contains("control")) {
    auto control = readControlPoints(options["control"].get<std::string>(), shift_m);
    if (!control) return failure(control.error());
    request.control = *std::move(control);
    job.control_points = request.control;
  }
  const auto r = registerByTargets(job, measured, request, report);
  if (!r) return failure(r.error());
  json answer = registrationRows(job, *r, shift_m);
  answer["measured"] = measuredRows(job, measured);
  for (std::size_t i = 0; i < r->station_of.size(); ++i) job.stations[r->station_of[i]].solved_pose = r->fit.pose[i];
  return answer;
}

}  // namespace

Result<Outcome> runRegister(const Document& document, const json& options, Progress& progress) {
  const bool cloud = options.value("cloud", false);
  if (cloud && options.contains("control"))
    return failure(ErrorKind::usage, "--cloud and --control cannot be combined", "--control");
  if (!cloud && document.job->targets.size() < 3)
    return failure(ErrorKind::usage, fmt::format("the project has {} targets, at least three are required: add targets "
                                                 "with `target` before scanning, or register with --cloud",
                                                 document.job->targets.size()));
  MeasuringRequest request;
  for (const auto& file : options.at("files")) request.files.emplace_back(file.get<std::string>());
  std::vector<std::filesystem::path> written;
  if (options.contains("output")) {
    auto to = registeredFiles(request.files, options["output"].get<std::string>());
    if (!to) return failure(to.error());
    written = *std::move(to);
  }
  request.seed = options.at("seed").get<std::uint64_t>();
  request.click_m = options.at("click").get<double>();
  request.targets = !cloud, request.sample = cloud;
  const auto measured = measureTargets(document, request, progress);
  if (!measured) return failure(measured.error());
  if (measured->scans.size() < (options.contains("control") ? 1U : 2U))
    return failure(ErrorKind::usage,
                   "a single station cannot be registered: specify scans of at least two, or use --control", "files");
  Outcome outcome{document, json::object(), measured->report, {}};
  Job job = *document.job;
  const auto held = heldStation(job, *measured, options);
  if (!held) return failure(held.error());
  const Vector3d& shift_m = document.georeference->shift_m;
  auto answer = cloud ? byClouds(job, *measured, *held, options, shift_m, outcome.report, progress)
                      : byTargets(job, *measured, *held, options, shift_m, outcome.report);
  if (!answer) return failure(answer.error());
  outcome.answer = *std::move(answer);
  outcome.text = textOf(outcome.answer);
  if (!written.empty()) {
    if (auto ok = writeRegistered(job, shift_m, request.files, written, outcome.report, progress); !ok)
      return failure(ok.error());
    for (const auto& file : written) outcome.answer["files"].push_back(file.string());
  }
  outcome.description =
      fmt::format("Registered {} stations {}", measured->scans.size(), cloud ? "cloud to cloud" : "by targets");
  outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
