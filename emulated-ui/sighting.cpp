// SPDX-License-Identifier: GPL-3.0-or-later
#include "emulated-ui/sighting.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "emulated-ui/device/settings.h"
#include "project/instruments.h"
#include "project/levelling.h"
#include "project/target_measuring.h"

namespace standpoint {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

Eigen::Vector3d placeFrom(const json& row) {
  return {row.at(0).get<double>(), row.at(1).get<double>(), row.at(2).get<double>()};
}

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
  const auto believed =
      believedPose(station, instrument, {.compensator = compensator, .exact = false, .seed = seed}, report);
  if (!believed) return failure(believed.error());
  const double yaw = yawOf(station.true_pose.rotation);
  return Eigen::Quaterniond(Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ())) * believed->rotation;
}

json scanOptions(const std::string& instrument, const SettingValues& values, const std::string& station,
                 std::uint64_t seed, const fs::path& file) {
  json settings = json::array();
  for (const auto& [key, value] : values) settings.push_back(key + "=" + value);
  return {
      {"instrument", instrument}, {"set", settings}, {"stations", station}, {"seed", seed}, {"output", file.string()}};
}

Result<Outcome> targetsIn(const Document& document, const std::string& file, std::uint64_t seed, Progress& progress) {
  MeasuringRequest request;
  request.files = {file};
  request.seed = seed;
  const auto measured = measureTargets(document, request, progress);
  if (!measured) return failure(measured.error());
  Outcome outcome{document, json::array(), measured->report, {}, {}};
  const auto& job = *document.job;
  for (const auto& m : measured->found) {
    const auto& target = job.targets[m.target];
    const auto truth = job.stations[m.station].true_pose.rotation.conjugate() *
                       (target.centre - job.stations[m.station].true_pose.translation);
    outcome.answer.push_back({{"name", target.name},
                              {"kind", target.kind == TargetKind::sphere ? "sphere" : "checkerboard"},
                              {"points", m.fit.points},
                              {"centre", {m.fit.centre.x(), m.fit.centre.y(), m.fit.centre.z()}},
                              {"range_m", m.fit.centre.norm()},
                              {"residual_m", m.fit.residual_m},
                              {"error_m", (m.fit.centre - truth).norm()},
                              {"found", true}});
  }
  for (const auto& m : measured->missed)
    outcome.answer.push_back({{"name", job.targets[m.target].name}, {"found", false}, {"why", m.why}});
  return outcome;
}

Result<Outcome> sightTarget(const Document& document, const SightOrder& order, const fs::path& file, std::uint64_t seed,
                            Progress& progress) {
  const auto* station = stationOf(document, order.station);
  if (station == nullptr) return failure(ErrorKind::usage, "unknown station", order.station);
  const auto& targets = document.job->targets;
  const auto target =
      std::find_if(targets.begin(), targets.end(), [&](const Target& t) { return t.name == order.target; });
  if (target == targets.end()) return failure(ErrorKind::usage, "unknown target", order.target);
  Outcome missed{document,
                 {{"name", target->name}, {"found", false}, {"why", "a different kind of target is at this position"}},
                 {},
                 {},
                 {}};
  if ((target->kind == TargetKind::sphere) != (order.kind == "sphere")) return missed;
  auto instrument = instrumentById(order.instrument);
  if (!instrument) return failure(instrument.error());
  auto options = scanOptions(order.instrument, windowOn(*target, *station, *instrument, order.settings), order.station,
                             seed, file);
  if (!order.compensator) options["compensator"] = "off";
  const auto scanned = runVerb(*findVerb(verbs(), "scan"), document, options, progress);
  std::error_code ignored;
  auto measured = scanned ? targetsIn(document, file.string(), seed, progress) : failure(scanned.error());
  fs::remove(file, ignored);
  if (!measured) return measured;
  const auto level = levelledFromScanner(*station, *instrument, order.compensator, seed);
  if (!level) return failure(level.error());
  for (auto& row : measured->answer) {
    if (row.at("name") != target->name) continue;
    // Whoever aims sees that the target is not there: what was fitted is the wall before it.
    if (row.at("found").get<bool>() && row.at("error_m").get<double>() > target->size_m / 2) {
      missed.answer["why"] = "hidden from this station";
      return missed;
    }
    if (row.at("found").get<bool>()) {
      const Eigen::Vector3d place = *level * placeFrom(row.at("centre"));
      row["levelled"] = {place.x(), place.y(), place.z()};
    }
    return Outcome{document, row, {}, {}, {}};
  }
  missed.answer["why"] = "no points on the target";
  return missed;
}

std::vector<FittedTarget> targetsFrom(const json& rows) {
  std::vector<FittedTarget> targets;
  for (const auto& row : rows) {
    FittedTarget t;
    t.name = row.at("name");
    t.found = row.at("found");
    if (t.found) {
      t.kind = row.at("kind");
      t.points = row.at("points");
      t.range_m = row.at("range_m");
      t.residual_m = row.at("residual_m");
      t.error_m = row.at("error_m");
      if (row.contains("centre")) t.centre_m = placeFrom(row["centre"]);
      if (row.contains("levelled")) t.levelled_m = placeFrom(row["levelled"]);
    } else {
      t.why_not = row.at("why");
    }
    targets.push_back(std::move(t));
  }
  return targets;
}

}  // namespace standpoint
