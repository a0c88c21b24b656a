// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/sighting.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/settings.h"
#include "project/survey/survey_verbs.h"
#include "survey/instruments.h"
#include "survey/stations/levelling.h"
#include "survey/targets/target_measuring.h"

namespace standpoint {

namespace fs = std::filesystem;

namespace {

// A window about the target, as large as it looks from there and a little more.
SettingValues windowOn(const Target& target, const Station& station, const Instrument& instrument,
                       SettingValues settings) {
  const Eigen::Vector3d p = station.true_pose.rotation.conjugate() * (target.centre - station.true_pose.translation);
  const double half = std::atan((target.size_m + 0.1) / std::max(0.5, p.norm())) / kRadPerDeg;
  const double azimuth = -std::atan2(p.y(), p.x()) / kRadPerDeg,
               elevation = std::atan2(p.z(), p.head<2>().norm()) / kRadPerDeg;
  const double wide = half / std::max(0.05, std::cos(elevation * kRadPerDeg));
  const auto round = [](double degrees) { return degrees - 360 * std::floor(degrees / 360); };
  for (const auto& [key, value] :
       {std::pair{"horizontal_from", round(azimuth - wide)},
        {"horizontal_to", round(azimuth + wide)},
        {"vertical_from", std::max(instrument.min_elevation_rad / kRadPerDeg, elevation - half)},
        {"vertical_to", std::min(instrument.max_elevation_rad / kRadPerDeg, elevation + half)}})
    settings = withSetting(settings, key, fmt::format("{:.4f}", value));
  return settings;
}

// Key of the word for it.
std::string wordOf(NoFit reason) {
  switch (reason) {
    case NoFit::few_points: return "no_fit.few_points";
    case NoFit::other_radius: return "no_fit.other_radius";
    case NoFit::mixed: return "no_fit.mixed";
    case NoFit::parts: return "no_fit.parts";
    case NoFit::no_pattern: return "no_fit.no_pattern";
    case NoFit::no_intensity: return "no_fit.no_intensity";
    case NoFit::two: return "no_fit.two";
    case NoFit::none: break;
  }
  return "no_fit.none";
}

constexpr double kStandsBefore_m = 0.05;  // as a tripod's leg or a post does; a board's own tilt and noise are less
constexpr const char* kOtherKind = "no_fit.other_kind";

const Target* targetOf(const Document& document, const std::string& name) {
  const auto& targets = document.job->targets;
  const auto found = std::find_if(targets.begin(), targets.end(), [&](const Target& t) { return t.name == name; });
  return found == targets.end() ? nullptr : &*found;
}

}  // namespace

const Station* stationOf(const Document& document, const std::string& name) {
  if (!document.job) return nullptr;
  const auto found = std::find_if(document.job->stations.begin(), document.job->stations.end(),
                                  [&](const Station& s) { return s.name == name; });
  return found == document.job->stations.end() ? nullptr : &*found;
}

ControlList controlOf(const Document& document) {
  ControlList control;
  if (document.georeference) control.shift_m = document.georeference->shift_m;
  if (!document.job) return control;
  for (const auto& t : document.job->targets) {
    const auto& points = document.job->control_points;
    const auto point =
        std::find_if(points.begin(), points.end(), [&](const ControlPoint& p) { return p.name == t.name; });
    control.targets.push_back({t.name, point == points.end() ? t.centre : point->position});
  }
  for (const auto& s : document.job->stations)
    control.stations.push_back({s.name, s.true_pose.translation - Eigen::Vector3d(0, 0, s.instrument_height_m)});
  return control;
}

Result<Eigen::Quaterniond> levelledFromScanner(const Station& station, const Instrument& instrument, bool compensator,
                                               std::uint64_t seed) {
  Report report;
  TRY_ASSIGN(const auto believed,
             believedPose(station, instrument, {.compensator = compensator, .exact = false, .seed = seed}, report));
  const double yaw = yawOf(station.true_pose.rotation);
  return Eigen::Quaterniond(Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ())) * believed.rotation;
}

Result<std::vector<FittedTarget>> targetsIn(const Document& document, const fs::path& file, std::uint64_t seed,
                                            Progress& progress) {
  MeasuringRequest request;
  request.files = {file};
  request.seed = seed;
  TRY_ASSIGN(const auto measured, measureTargets(*document.job, request, progress));
  std::vector<FittedTarget> targets;
  const auto& job = *document.job;
  for (const auto& m : measured.found) {
    const auto& target = job.targets[m.target];
    const auto truth = job.stations[m.station].true_pose.rotation.conjugate() *
                       (target.centre - job.stations[m.station].true_pose.translation);
    FittedTarget t;
    t.name = target.name;
    t.kind = target.kind == TargetKind::sphere ? "sphere" : "checkerboard";
    t.points = static_cast<int>(m.fit.points);
    t.range_m = m.fit.centre.norm();
    t.residual_m = m.fit.residual_m;
    t.error_m = (m.fit.centre - truth).norm();
    t.found = true;
    t.centre_m = m.fit.centre;
    targets.push_back(std::move(t));
  }
  for (const auto& m : measured.missed) {
    FittedTarget t;
    t.name = job.targets[m.target].name;
    t.why_not = wordOf(m.reason);
    targets.push_back(std::move(t));
  }
  return targets;
}

Result<FittedTarget> pickedTarget(const Document& document, const PickOrder& order, std::uint64_t seed,
                                  Progress& progress) {
  FittedTarget picked;
  picked.name = order.name;
  picked.why_not = "no_fit.none";
  if (!document.job) return picked;
  TRY_ASSIGN(const auto all, targetsIn(document, order.file, seed, progress));
  const double aimed_m = order.spot_m.norm();
  double nearest_rad = 1e9;
  for (const auto& t : all) {
    if (!t.found) continue;
    const double radius_m = targetOf(document, t.name)->size_m / 2;
    // The cross is on something before it, or what was fitted is the wall that hides it.
    if (aimed_m < t.range_m - radius_m - kStandsBefore_m || t.error_m > radius_m) continue;
    const double off_rad = std::acos(std::clamp(order.spot_m.dot(t.centre_m) / (aimed_m * t.range_m), -1.0, 1.0));
    const double seen_rad = std::atan(radius_m / std::max(0.1, t.range_m));
    if (off_rad > seen_rad + order.reach_rad || off_rad > nearest_rad) continue;
    nearest_rad = off_rad;
    const bool told = t.kind == order.kind;
    picked = told ? t : FittedTarget{};
    picked.name = order.name;
    if (!told) picked.why_not = kOtherKind;
  }
  return picked;
}

Result<FittedTarget> sightTarget(const Document& document, const SightOrder& order, const fs::path& file,
                                 std::uint64_t seed, Progress& progress) {
  const auto* station = stationOf(document, order.station);
  if (station == nullptr) return failure(ErrorKind::usage, "unknown station", order.station);
  const auto* target = targetOf(document, order.target);
  if (target == nullptr) return failure(ErrorKind::usage, "unknown target", order.target);
  FittedTarget missed;
  missed.name = target->name;
  missed.why_not = kOtherKind;
  if ((target->kind == TargetKind::sphere) != (order.kind == "sphere")) return missed;
  TRY_ASSIGN(auto instrument, instrumentById(order.instrument));
  ScanVerbOptions options;
  options.instrument = order.instrument;
  options.settings = windowOn(*target, *station, instrument, order.settings);
  options.stations.names = {order.station};
  options.seed = seed;
  options.output = file;
  if (!order.compensator) options.compensator = Switch::off;
  const auto scanned = runScan(document, options, progress);
  std::error_code ignored;
  auto measured =
      scanned ? targetsIn(document, file, seed, progress) : Result<std::vector<FittedTarget>>(failure(scanned.error()));
  fs::remove(file, ignored);
  if (!measured) return failure(measured.error());
  TRY_ASSIGN(const auto level, levelledFromScanner(*station, instrument, order.compensator, seed));
  for (auto& t : *measured) {
    if (t.name != target->name) continue;
    // The operator sees that the target is not there: what was fitted is the wall before it.
    if (t.found && t.error_m > target->size_m / 2) {
      missed.why_not = "no_fit.hidden";
      return missed;
    }
    if (t.found) t.levelled_m = level * t.centre_m;
    return t;
  }
  missed.why_not = "no_fit.few_points";
  return missed;
}

}  // namespace standpoint
