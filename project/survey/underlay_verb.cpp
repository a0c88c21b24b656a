// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/units.h"
#include "pointclouds/formats.h"
#include "project/answers.h"
#include "project/survey/file_places.h"
#include "project/survey/underlays.h"
#include "survey/registration/underlay_placing.h"

namespace standpoint {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::array kActions = {"add", "move", "register", "rename", "remove", "show", "hide"};
enum class Action { add, move, fit, rename, remove, show, hide };  // of kActions

bool posed(const UnderlayOptions& options) { return options.at || options.yaw_deg; }

// What is not said stays as it is.
Pose posedBy(const UnderlayOptions& options, Pose pose) {
  if (options.at) pose.translation = *options.at;
  if (options.yaw_deg) pose.rotation = Eigen::AngleAxisd(*options.yaw_deg * kRadPerDeg, Eigen::Vector3d::UnitZ());
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

Result<void> change(Answered<UnderlayAnswer>& outcome, Action what, const std::string& name,
                    const UnderlayOptions& options, Progress& progress) {
  auto& underlays = outcome.document.underlays;
  auto& description = outcome.description;
  const auto at = std::find_if(underlays.begin(), underlays.end(), [&](const auto& u) { return u->name == name; });
  if (at == underlays.end()) {
    std::vector<std::string> names;
    for (const auto& u : underlays) names.push_back(u->name);
    return failure(ErrorKind::usage, fmt::format("unknown underlay '{}'; available: {}", name,
                                                 names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }
  if (what == Action::remove) {
    description = "Removed underlay " + name;
    underlays.erase(at);
    return {};
  }
  Underlay changed = **at;
  if (what == Action::move) {
    if (!posed(options)) return failure(ErrorKind::usage, "specify the new position: --at X,Y,Z, --yaw-deg A");
    const auto pose = posedBy(options, changed.file_from_cloud);
    const double by_m = (pose.translation - changed.file_from_cloud.translation).norm();
    changed.file_from_cloud = pose;
    description = fmt::format("Moved underlay {} by {:.3f} m", name, by_m);
  } else if (what == Action::fit) {
    UnderlayRegistration came_of_it;
    TRY_ASSIGN(auto done, registered(outcome.document, changed, options, came_of_it, outcome.report, progress));
    changed = std::move(done);
    outcome.answer.registered = std::move(came_of_it);
    description = fmt::format("Registered underlay {}", name);
  } else if (what == Action::rename) {
    if (options.name.empty()) return failure(ErrorKind::usage, "an underlay needs a name");
    if (options.name != name && freeName(underlays, options.name) != options.name)
      return failure(ErrorKind::usage, fmt::format("underlay '{}' already exists; use another name", options.name));
    changed.name = options.name;
    description = fmt::format("Renamed underlay {} to {}", name, options.name);
  } else {
    changed.visible = what == Action::show;
    description = fmt::format("{} underlay {}", changed.visible ? "Showed" : "Hid", name);
  }
  *at = std::make_shared<const Underlay>(std::move(changed));
  return {};
}

}  // namespace

Bounds boundsInFile(const Underlay& u) { return moved(u.file_from_cloud, u.bounds_cloud_m); }

Bounds siteInFile(const Document& document) {
  if (document.hasModel()) return fileBounds(bounds(*document.imported), document.georeference->shift_m);
  Bounds all;
  for (const auto& u : document.underlays)
    if (const Bounds b = boundsInFile(*u); !b.empty()) all.extend(b);
  return all;
}

UnderlayRow underlayRow(const Underlay& u) {
  std::error_code ignored;
  return {u.name,           u.file,          fs::exists(u.file, ignored), u.format, u.points,
          u.bounds_cloud_m, boundsInFile(u), u.file_from_cloud,           u.crs,    u.visible};
}

Result<Underlay> readUnderlay(const Document& document, const UnderlayOptions& options, Report& report,
                              Progress& progress) {
  const fs::path file = fs::absolute(*options.add).lexically_normal();
  progress.stage("Reading " + file.filename().string());
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return failure(ErrorKind::file_system, "file not found", file.string());
  TRY_ASSIGN(const auto extent, measureCloud(file, progress));
  if (extent.points == 0) return failure(ErrorKind::unusable, "the point cloud is empty", file.string());
  // Nothing is lost to the project: the points stay in their file.
  for (const auto& issue : extent.report.issues)
    report.issues.push_back({std::min(issue.severity, Severity::warning), issue.source, issue.message});
  Underlay u;
  u.name = freeName(document.underlays, options.name.empty() ? file.stem().string() : options.name);
  u.file = file.string();
  u.format = extent.format;
  u.points = extent.points;
  u.bounds_cloud_m = extent.bounds_file_m;
  u.crs = extent.crs;
  if (posed(options)) {
    u.file_from_cloud = posedBy(options, {});
    return u;
  }
  u.file_from_cloud =
      placeCloud({u.name, u.crs, u.bounds_cloud_m}, *document.georeference, siteInFile(document), report);
  return u;
}

const Fields<UnderlayOptions>& underlayFields() {
  using O = UnderlayOptions;
  static const Fields<O> fields = {
      {"add", &O::add, "cloud file (.e57, .las, .ply, .ptx, .pts, .xyz)"},
      {"name", &O::name, "name of what is added (default: the file's), or the new name"},
      {"move", &O::move, "name of the underlay to move"},
      {"register", &O::fit, "name of the underlay to register to the model, by --pairs, --icp, or both in this order"},
      {"pairs", &O::pairs, "three or more x,y,z=X,Y,Z: a place in the cloud's file, and in the model's"},
      {"icp", &O::to_surface, "fit the cloud to the model's surface, starting at its present place"},
      {"reach",
       &O::reach_m,
       "maximum distance of a point from its surface for --icp",
       {.unit = "m", .minimum = 0.01, .maximum = 100}},
      {"rename", &O::rename, "name of the underlay to rename"},
      {"remove", &O::remove, "name of the underlay to remove"},
      {"show", &O::show, "name of the underlay to show"},
      {"hide", &O::hide, "name of the underlay to hide"},
      {"at",
       &O::at,
       "X,Y,Z of the cloud's origin in the file's frame (default: by the map conversion, else as the cloud is)",
       {.unit = "m"}},
      {"yaw-deg",
       &O::yaw_deg,
       "angle from the file's X axis to the cloud's, counter-clockwise",
       {.unit = "deg", .minimum = -360, .maximum = 360}}};
  return fields;
}

const AnswerFields<UnderlayRow>& answerFields(const UnderlayRow*) {
  using A = UnderlayRow;
  static const AnswerFields<A> fields = {{"name", &A::name},
                                         {"file", &A::file},
                                         {"file_there", &A::file_there},
                                         {"format", &A::format},
                                         {"points", &A::points},
                                         {"bounds", &A::bounds_cloud_m},
                                         {"bounds_in_model", &A::bounds_file_m},
                                         {"pose", &A::file_from_cloud},
                                         {"crs", &A::crs, answers::nullWhereEmpty},
                                         {"visible", &A::visible}};
  return fields;
}

const AnswerFields<UnderlayAnswer>& answerFields(const UnderlayAnswer*) {
  using A = UnderlayAnswer;
  static const AnswerFields<A> fields = {
      {"placed", &A::placed, kLeftOut}, {"registered", &A::registered, kLeftOut}, {"underlays", &A::underlays}};
  return fields;
}

Result<Answered<UnderlayAnswer>> runUnderlay(const Document& document, const UnderlayOptions& options,
                                             Progress& progress) {
  progress.stage("Underlay");
  const auto added_file = options.add ? std::optional(options.add->string()) : std::nullopt;
  const std::array said = {&added_file,     &options.move, &options.fit, &options.rename,
                           &options.remove, &options.show, &options.hide};
  std::optional<Action> action;
  for (std::size_t i = 0; i < said.size(); ++i) {
    if (!said[i]->has_value()) continue;
    if (action) return failure(ErrorKind::usage, fmt::format("specify one of --{}", fmt::join(kActions, ", --")));
    action = static_cast<Action>(i);
  }
  if (action != Action::fit && (!options.pairs.empty() || options.to_surface))
    return failure(ErrorKind::usage, "--pairs and --icp require --register NAME");
  Answered<UnderlayAnswer> outcome{document};
  auto& underlays = outcome.document.underlays;
  if (action == Action::add) {
    TRY_ASSIGN(auto added, readUnderlay(document, options, outcome.report, progress));
    outcome.answer.placed = underlayRow(added);
    outcome.description = fmt::format("Added underlay {}: {} points", added.name, added.points);
    underlays.push_back(std::make_shared<const Underlay>(std::move(added)));
  } else if (action) {
    const auto& name = **said[static_cast<std::size_t>(*action)];
    TRY(change(outcome, *action, name, options, progress));
  }
  for (const auto& u : underlays) outcome.answer.underlays.push_back(underlayRow(*u));
  return outcome;
}

json underlaysToJson(const Underlays& underlays, const fs::path& project_folder) {
  json rows = json::array();
  for (const auto& u : underlays)
    rows.push_back({{"name", u->name},
                    {"file", storedPlace(u->file, project_folder)},
                    {"format", u->format},
                    {"points", u->points},
                    {"bounds", toJson(u->bounds_cloud_m)},
                    {"pose", poseToJson(u->file_from_cloud)},
                    {"crs", u->crs},
                    {"visible", u->visible}});
  return rows;
}

Underlays underlaysFrom(const json& part, const fs::path& project_folder) {
  Underlays underlays;
  for (const auto& row : part) {
    Underlay u;
    u.name = row.at("name");
    u.file = placeOf(row.at("file").get<std::string>(), project_folder).string();
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
