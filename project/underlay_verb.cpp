// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "pointclouds/formats.h"
#include "project/answers.h"
#include "project/project_json.h"
#include "project/registering.h"
#include "project/underlay_placing.h"
#include "project/underlays.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::array kActions = {"add", "move", "register", "remove", "show", "hide"};

json underlayRow(const Underlay& u) {
  std::error_code ignored;
  return {{"name", u.name},
          {"file", u.file},
          {"file_there", fs::exists(u.file, ignored)},
          {"format", u.format},
          {"points", u.points},
          {"bounds", toJson(u.bounds_cloud_m, Eigen::Vector3d::Zero())},
          {"bounds_in_model", toJson(boundsInFile(u), Eigen::Vector3d::Zero())},
          {"pose", poseToJson(u.file_from_cloud)},
          {"crs", u.crs.empty() ? json(nullptr) : json(u.crs)},
          {"visible", u.visible}};
}

bool posed(const json& options) { return options.contains("at") || options.contains("yaw-deg"); }

// What is not said stays as it is.
Result<Pose> posedBy(const json& options, Pose pose) {
  if (options.contains("at")) {
    if (options["at"].size() != 3)
      return failure(ErrorKind::usage, "--at requires X,Y,Z of the cloud's origin in metres");
    pose.translation = vectorFrom(options["at"]);
  }
  if (options.contains("yaw-deg"))
    pose.rotation = Eigen::AngleAxisd(options["yaw-deg"].get<double>() * kRadPerDeg, Eigen::Vector3d::UnitZ());
  if (pose.rotation.w() < 0) pose.rotation.coeffs() *= -1;
  return pose;
}

std::string freeName(const Underlays& underlays, const std::string& wanted) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(underlays.begin(), underlays.end(), [&](const auto& u) { return u->name == name; });
  };
  std::string name = wanted;
  for (int i = 2; taken(name); ++i) name = fmt::format("{}-{}", wanted, i);
  return name;
}

Result<Underlay> addedUnderlay(const Document& document, const json& options, Report& report, Progress& progress) {
  const fs::path file = fs::absolute(options["add"].get<std::string>()).lexically_normal();
  progress.stage("Reading " + file.filename().string());
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return failure(ErrorKind::file_system, "file not found", file.string());
  const auto extent = measureCloud(file, progress);
  if (!extent) return failure(extent.error());
  if (extent->points == 0) return failure(ErrorKind::unusable, "the point cloud is empty", file.string());
  // Nothing is lost to the project: the points stay in their file.
  for (const auto& issue : extent->report.issues)
    report.issues.push_back({std::min(issue.severity, Severity::warning), issue.source, issue.message});
  Underlay u;
  u.name = freeName(document.underlays, options.value("name", file.stem().string()));
  u.file = file.string();
  u.format = extent->format;
  u.points = extent->points;
  u.bounds_cloud_m = extent->bounds_file_m;
  u.crs = extent->crs;
  if (posed(options)) {
    auto pose = posedBy(options, {});
    if (!pose) return failure(pose.error());
    u.file_from_cloud = *pose;
    return u;
  }
  Bounds model = bounds(*document.imported);
  if (!model.empty()) {
    model.min += document.georeference->shift_m;
    model.max += document.georeference->shift_m;
  }
  u.file_from_cloud = placeCloud({u.name, u.crs, u.bounds_cloud_m}, *document.georeference, model, report);
  return u;
}

Result<Underlay> registeredUnderlay(const Outcome& outcome, const Underlay& underlay, const json& options, json& answer,
                                    Report& report, Progress& progress) {
  RegisterRequest request;
  auto pairs = placePairsFrom(options.value("pairs", json::array()));
  if (!pairs) return failure(pairs.error());
  request.pairs = *std::move(pairs);
  request.to_surface = options.value("icp", false);
  request.reach_m = options.at("reach").get<double>();
  return registered(outcome.document, underlay, request, answer, report, progress);
}

Result<void> change(Outcome& outcome, const char* action, const json& options, Progress& progress) {
  auto& underlays = outcome.document.underlays;
  auto& description = outcome.description;
  const auto name = options[action].get<std::string>();
  const auto at = std::find_if(underlays.begin(), underlays.end(), [&](const auto& u) { return u->name == name; });
  if (at == underlays.end()) {
    std::vector<std::string> names;
    for (const auto& u : underlays) names.push_back(u->name);
    return failure(ErrorKind::usage, fmt::format("unknown underlay '{}'; available: {}", name,
                                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  const std::string_view what = action;
  if (what == "remove") {
    description = "Removed underlay " + name;
    underlays.erase(at);
    return {};
  }
  Underlay changed = **at;
  if (what == "move") {
    if (!posed(options)) return failure(ErrorKind::usage, "specify the new position: --at X,Y,Z, --yaw-deg A");
    auto pose = posedBy(options, changed.file_from_cloud);
    if (!pose) return failure(pose.error());
    const double by_m = (pose->translation - changed.file_from_cloud.translation).norm();
    changed.file_from_cloud = *pose;
    description = fmt::format("Moved underlay {} by {:.3f} m", name, by_m);
  } else if (what == "register") {
    json answer;
    auto done = registeredUnderlay(outcome, changed, options, answer, outcome.report, progress);
    if (!done) return failure(done.error());
    changed = *std::move(done);
    outcome.answer["registered"] = std::move(answer);
    description = fmt::format("Registered underlay {}", name);
  } else {
    changed.visible = what == "show";
    description = fmt::format("{} underlay {}", changed.visible ? "Showed" : "Hid", name);
  }
  *at = std::make_shared<const Underlay>(std::move(changed));
  return {};
}

}  // namespace

Bounds boundsInFile(const Underlay& u) { return moved(u.file_from_cloud, u.bounds_cloud_m); }

Result<Outcome> runUnderlay(const Document& document, const json& options, Progress& progress) {
  progress.stage("Underlay");
  const char* action = nullptr;
  for (const char* each : kActions) {
    if (!options.contains(each)) continue;
    if (action) return failure(ErrorKind::usage, fmt::format("specify one of --{}", fmt::join(kActions, ", --")));
    action = each;
  }
  if (!(action && std::string_view(action) == "register") && (options.contains("pairs") || options.value("icp", false)))
    return failure(ErrorKind::usage, "--pairs and --icp require --register NAME");
  Outcome outcome{document, json::object(), {}, {}};
  auto& underlays = outcome.document.underlays;
  if (action && std::string_view(action) == "add") {
    auto added = addedUnderlay(document, options, outcome.report, progress);
    if (!added) return failure(added.error());
    outcome.answer["placed"] = underlayRow(*added);
    outcome.description = fmt::format("Added underlay {}: {} points", added->name, added->points);
    underlays.push_back(std::make_shared<const Underlay>(*std::move(added)));
  } else if (action) {
    if (auto changed = change(outcome, action, options, progress); !changed) return failure(changed.error());
  }
  json rows = json::array();
  for (const auto& u : underlays) rows.push_back(underlayRow(*u));
  outcome.answer["underlays"] = std::move(rows);
  return outcome;
}

json underlaysToJson(const Underlays& underlays, const fs::path& project_folder) {
  const fs::path folder = fs::absolute(project_folder).lexically_normal();
  json rows = json::array();
  for (const auto& u : underlays) {
    const fs::path relative = fs::path(u->file).lexically_relative(folder);
    const bool near = !relative.empty() && !relative.string().starts_with("../..");
    rows.push_back({{"name", u->name},
                    {"file", near ? relative.string() : u->file},
                    {"format", u->format},
                    {"points", u->points},
                    {"bounds", toJson(u->bounds_cloud_m, Eigen::Vector3d::Zero())},
                    {"pose", poseToJson(u->file_from_cloud)},
                    {"crs", u->crs},
                    {"visible", u->visible}});
  }
  return rows;
}

Underlays underlaysFrom(const json& part, const fs::path& project_folder) {
  Underlays underlays;
  for (const auto& row : part) {
    Underlay u;
    u.name = row.at("name");
    const fs::path file = row.at("file").get<std::string>();
    u.file = (file.is_absolute() ? file : fs::absolute(project_folder) / file).lexically_normal().string();
    u.format = row.at("format");
    u.points = row.at("points");
    u.bounds_cloud_m = {vectorFrom(row.at("bounds").at(0)), vectorFrom(row.at("bounds").at(1))};
    u.file_from_cloud = poseFrom(row.at("pose"));
    u.crs = row.at("crs");
    u.visible = row.at("visible");
    underlays.push_back(std::make_shared<const Underlay>(std::move(u)));
  }
  return underlays;
}

}  // namespace standpoint
