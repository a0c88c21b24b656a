// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/units.h"
#include "project/answers.h"
#include "project/survey_verbs.h"

namespace standpoint {

namespace {

using nlohmann::json;

constexpr double kClearance_m = 0.15;     // the instrument's own body
constexpr double kHeadroom_m = 0.3;       // above the tilting axis
constexpr double kFloorSearch_m = 0.5;    // how far a stated floor height may be off

bool flatEnough(const Environment& environment, const RayHit& hit) {
  const auto& instance = environment.instances[hit.instance];
  const auto& mesh = *environment.meshes[instance.mesh];
  const auto& t = mesh.triangles[hit.triangle];
  const Eigen::Vector3d a = instance.world_from_mesh * mesh.positions[t[0]].cast<double>();
  const Eigen::Vector3d b = instance.world_from_mesh * mesh.positions[t[1]].cast<double>();
  const Eigen::Vector3d c = instance.world_from_mesh * mesh.positions[t[2]].cast<double>();
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  return std::abs(normal.z()) > 0.7;  // flat enough for a tripod; the side is decided by the room above it
}

std::vector<double> heightsBelow(const RayScene& scene, double x, double y) {
  const Bounds b = bounds(scene.environment());
  std::vector<double> heights;
  double z = b.max.z() + 1;
  while (true) {
    const auto hit = scene.intersect({x, y, z}, -Eigen::Vector3d::UnitZ(), z - b.min.z() + 1);
    if (!hit) return heights;
    if (flatEnough(scene.environment(), *hit)) heights.push_back(hit->position.z());
    z = hit->position.z() - 1e-4;
    if (heights.size() > 10000) return heights;
  }
}

std::optional<std::string> whyNotAt(const RayScene& scene, const Eigen::Vector3d& centre) {
  for (const double elevation : {-0.6, -0.3, 0.0, 0.3, 0.6, 0.9})
    for (int k = 0; k < 16; ++k) {
      const double azimuth = k * std::numbers::pi / 8 + 0.01;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      if (const auto hit = scene.intersect(centre, direction, kClearance_m)) {
        const auto& p = scene.environment().products[hit->product];
        return fmt::format("the instrument would be {:.0f} mm from {} {} '{}'; it needs {:.0f} mm all round",
                           hit->range_m * 1000, p.ifc_class.empty() ? "object" : p.ifc_class, p.id, p.name,
                           kClearance_m * 1000);
      }
    }
  return std::nullopt;
}

json stationRow(const Station& s, const Georeference& g) {
  json scans = json::array();
  for (const auto& scan : s.scans)
    scans.push_back({{"instrument", scan.instrument}, {"file", scan.file}, {"points", scan.points}});
  return {{"name", s.name},
          {"at", toJson(s.true_pose.translation + g.shift_m)},
          {"instrument_height", s.instrument_height_m},
          {"yaw_deg", 2 * std::atan2(s.true_pose.rotation.z(), s.true_pose.rotation.w()) / kRadPerDeg},
          {"scans", std::move(scans)}};
}

// How much a station would see: the mean distance to what it meets, capped so that neither a long corridor nor the open
// ground outside outweighs a room, and nothing for beams that leave the model.
double view(const RayScene& scene, const Eigen::Vector3d& centre) {
  constexpr int kDirections = 200;
  constexpr double kFar_m = 4;
  double sum = 0;
  for (int i = 0; i < kDirections; ++i) {  // Fibonacci sphere
    const double z = 1 - (2 * i + 1.0) / kDirections;
    const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    if (const auto hit = scene.intersect(centre, {r * std::cos(azimuth), r * std::sin(azimuth), z}, 60))
      sum += std::min(hit->range_m, kFar_m);
  }
  return sum / kDirections;
}

// Floor points to try: the walkable surface where there is one, else a grid over the model.
std::vector<Eigen::Vector3d> placesToTry(const Document& document, const RayScene& scene, double height) {
  std::vector<Eigen::Vector3d> places;
  constexpr std::size_t kMost = 400;
  if (document.collision && !document.collision->walkable.triangles.empty()) {
    const auto& mesh = document.collision->walkable;
    const std::size_t step = mesh.triangles.size() / kMost + 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
      const auto& t = mesh.triangles[i];
      places.emplace_back(((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3).cast<double>());
    }
    return places;
  }
  const Bounds b = bounds(scene.environment());
  for (int j = 1; j < 16; ++j)
    for (int i = 1; i < 16; ++i) {
      const double x = b.min.x() + (b.max.x() - b.min.x()) * i / 16;
      const double y = b.min.y() + (b.max.y() - b.min.y()) * j / 16;
      for (const double z : floorsAt(scene, x, y, height)) places.emplace_back(x, y, z);
    }
  return places;
}

// Points round a box, on its lowest height.
void addPlacesAround(const Bounds& b, int count, std::vector<Eigen::Vector3d>& places) {
  constexpr double kAway_m = 3;
  const Eigen::Vector3d centre = (b.min + b.max) / 2;
  for (int k = 0; k < count; ++k) {
    const double azimuth = 2 * std::numbers::pi * k / count;
    places.emplace_back(centre.x() + ((b.max.x() - b.min.x()) / 2 + kAway_m) * std::cos(azimuth),
                        centre.y() + ((b.max.y() - b.min.y()) / 2 + kAway_m) * std::sin(azimuth), b.min.z());
  }
}

// For models without a floor (a roof, a set of frames, a line of masts): beside the whole and beside some of its products.
std::vector<Eigen::Vector3d> placesAround(const RayScene& scene) {
  constexpr std::size_t kProducts = 40;
  std::vector<Eigen::Vector3d> places;
  addPlacesAround(bounds(scene.environment()), 16, places);
  const auto each = productBounds(scene.environment());
  for (std::size_t p = 0; p < each.size(); p += each.size() / kProducts + 1)
    if (scene.environment().products[p].inScene() && !each[p].empty()) addPlacesAround(each[p], 4, places);
  return places;
}

// Of the places the one that sees most, at least 2.5 m from every station that is there already.
std::optional<Eigen::Vector3d> bestOf(const std::vector<Eigen::Vector3d>& floors, const Document& document,
                                      const RayScene& scene, double height) {
  constexpr double kApart_m = 2.5;
  double best = -1;
  std::optional<Eigen::Vector3d> chosen;
  for (const auto& floor : floors) {
    const Eigen::Vector3d centre = floor + Eigen::Vector3d(0, 0, height);
    const bool apart = std::all_of(document.job->stations.begin(), document.job->stations.end(), [&](const Station& s) {
      return (s.true_pose.translation - centre).norm() >= kApart_m;
    });
    if (!apart || whyNotAt(scene, centre)) continue;
    if (const double seen = view(scene, centre); seen > best) {
      best = seen;
      chosen = centre;
    }
  }
  return chosen;
}

// Where nothing was said.
Result<Eigen::Vector3d> bestPlace(const Document& document, const RayScene& scene, double height, Report& report) {
  if (const auto chosen = bestOf(placesToTry(document, scene, height), document, scene, height)) return *chosen;
  if (const auto beside = bestOf(placesAround(scene), document, scene, height)) {
    report.warn("station", "the model has no free floor for it: the tripod stands beside the model, on its lowest height");
    return *beside;
  }
  return failure(ErrorKind::unusable, "no free place was found for the tripod; say where with --at X,Y,Z or --on X,Y[,Z]");
}

// The instrument's centre in the local frame, from --at or --on.
Result<Eigen::Vector3d> centreFrom(const RayScene& scene, const Georeference& g, const json& options) {
  const double height = options.at("height").get<double>();
  if (options.contains("at")) {
    if (options["at"].size() != 3) return failure(ErrorKind::usage, "--at takes three numbers X,Y,Z in metres");
    return vectorFrom(options["at"]) - g.shift_m;
  }
  const auto& on = options.at("on");
  const double x = on[0].get<double>() - g.shift_m.x();
  const double y = on[1].get<double>() - g.shift_m.y();
  const auto floors = floorsAt(scene, x, y, height);
  if (floors.empty())
    return failure(ErrorKind::unusable,
                   fmt::format("there is no floor at ({}, {}) with {:.2f} m of room for the tripod; choose another place, "
                               "or give the instrument's centre with --at X,Y,Z",
                               on[0].get<double>(), on[1].get<double>(), height + kHeadroom_m));
  if (on.size() == 2) return Eigen::Vector3d(x, y, floors.front() + height);
  const double z = on[2].get<double>() - g.shift_m.z();
  const auto nearest = *std::min_element(floors.begin(), floors.end(),
                                         [z](double a, double b) { return std::abs(a - z) < std::abs(b - z); });
  if (std::abs(nearest - z) > kFloorSearch_m)
    return failure(ErrorKind::unusable,
                   fmt::format("there is no floor within {} m of height {}; the nearest is at {:.3f}", kFloorSearch_m,
                               on[2].get<double>(), nearest + g.shift_m.z()));
  return Eigen::Vector3d(x, y, nearest + height);
}

Result<Station> place(const Document& document, const std::string& name, const json& options, Report& report,
                      Progress& progress) {
  if (options.contains("at") && options.contains("on"))
    return failure(ErrorKind::usage, "say where with either --at X,Y,Z (the instrument's centre) or --on X,Y[,Z] (the floor)");
  auto scene = RayScene::build(document.environment(), progress);
  if (!scene) return failure(scene.error());
  const bool anywhere = !options.contains("at") && !options.contains("on");
  auto centre = anywhere ? bestPlace(document, **scene, options.at("height").get<double>(), report)
                         : centreFrom(**scene, *document.georeference, options);
  if (!centre) return failure(centre.error());
  if (auto why = whyNotAt(**scene, *centre))
    return failure(ErrorKind::unusable, fmt::format("station {} is refused: {}; choose another place", name, *why));
  Station station;
  station.name = name;
  station.instrument_height_m = options.at("height").get<double>();
  station.true_pose.translation = *centre;
  const double yaw = options.at("yaw-deg").get<double>() * kRadPerDeg;
  station.true_pose.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  if (station.true_pose.rotation.w() < 0) station.true_pose.rotation.coeffs() *= -1;
  return station;
}

std::vector<Station>::iterator find(Job& job, const std::string& name) {
  return std::find_if(job.stations.begin(), job.stations.end(), [&](const Station& s) { return s.name == name; });
}

tl::unexpected<Error> noStation(const Job& job, const std::string& name) {
  std::vector<std::string> names;
  for (const auto& s : job.stations) names.push_back(s.name);
  return failure(ErrorKind::usage, fmt::format("there is no station '{}'; there is {}", name,
                                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

}  // namespace

std::vector<double> floorsAt(const RayScene& scene, double x_m, double y_m, double instrument_height_m) {
  const auto heights = heightsBelow(scene, x_m, y_m);  // falling
  std::vector<double> floors;
  for (auto h = heights.rbegin(); h != heights.rend(); ++h)
    if (!scene.intersect({x_m, y_m, *h + 1e-3}, Eigen::Vector3d::UnitZ(), instrument_height_m + kHeadroom_m))
      floors.push_back(*h);
  return floors;
}

Result<Outcome> runStation(const Document& document, const json& options, Progress& progress) {
  progress.stage("Station");
  const int asked = static_cast<int>(options.contains("add")) + static_cast<int>(options.contains("move")) +
                    static_cast<int>(options.contains("remove"));
  if (asked > 1) return failure(ErrorKind::usage, "say one of --add NAME, --move NAME, --remove NAME");
  Outcome outcome{document, json::object(), {}, {}};
  Job job = *document.job;
  const auto& g = *document.georeference;
  if (options.contains("add")) {
    const auto name = options["add"].get<std::string>();
    if (name.empty() || name.find_first_of(",/\\") != std::string::npos)
      return failure(ErrorKind::usage, fmt::format("'{}' cannot be a station's name: no comma or slash, please", name));
    if (find(job, name) != job.stations.end())
      return failure(ErrorKind::usage, fmt::format("there is a station '{}' already; use --move, or another name", name));
    auto station = place(document, name, options, outcome.report, progress);
    if (!station) return failure(station.error());
    outcome.answer["placed"] = stationRow(*station, g);
    outcome.description = "Added station " + name;
    job.stations.push_back(*std::move(station));
  } else if (options.contains("move")) {
    const auto name = options["move"].get<std::string>();
    const auto at = find(job, name);
    if (at == job.stations.end()) return noStation(job, name);
    auto station = place(document, name, options, outcome.report, progress);
    if (!station) return failure(station.error());
    const double distance = (station->true_pose.translation - at->true_pose.translation).norm();
    station->scans = at->scans;
    *at = *std::move(station);
    outcome.answer["placed"] = stationRow(*at, g);
    outcome.description = fmt::format("Moved station {} by {:.2f} m", name, distance);
  } else if (options.contains("remove")) {
    const auto name = options["remove"].get<std::string>();
    const auto at = find(job, name);
    if (at == job.stations.end()) return noStation(job, name);
    job.stations.erase(at);
    outcome.description = "Removed station " + name;
  }
  json rows = json::array();
  for (const auto& s : job.stations) rows.push_back(stationRow(s, g));
  outcome.answer["stations"] = std::move(rows);
  if (asked == 1) outcome.document.job = std::make_shared<const Job>(std::move(job));
  return outcome;
}

}  // namespace standpoint
