// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"
#include "project/project_json.h"
#include "project/registration.h"

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

}  // namespace

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

}  // namespace standpoint
