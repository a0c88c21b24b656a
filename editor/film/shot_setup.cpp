// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/film/shot_setup.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/readable_name.h"
#include "core/units.h"
#include "optimizer/walk/walkable_map.h"
#include "survey/stations/levelling.h"

namespace standpoint {

namespace {

constexpr double kWide_rad = 65 * kRadPerDeg;  // vertical: a room from inside
constexpr double kStoreyCosts = 5;             // a room above is farther than it looks: there are stairs in between

struct Stop {
  std::string name;
  Eigen::Vector3d feet;
};

Result<std::vector<Stop>> stationStops(const Document& document, const std::vector<std::string>& names) {
  std::vector<Stop> stops;
  const auto add = [&](const Station& s) {
    stops.push_back({s.name, s.true_pose.translation - Eigen::Vector3d(0, 0, s.instrument_height_m)});
  };
  static const std::vector<Station> none;
  const auto& stations = document.job ? document.job->stations : none;
  for (const auto& name : names) {
    const auto at = std::find_if(stations.begin(), stations.end(), [&](const Station& s) { return s.name == name; });
    if (at == stations.end()) return failure(ErrorKind::usage, fmt::format("unknown station '{}'", name));
    add(*at);
  }
  if (names.empty()) std::for_each(stations.begin(), stations.end(), add);
  return stops;
}

std::vector<Stop> roomStops(const WalkedGround& ground) {
  std::vector<Stop> left, stops;
  for (const auto& room : ground.collision->rooms)
    if (room.reached) left.push_back({readableName(ground.environment->products[room.product]), room.position});
  while (!left.empty()) {
    const auto far = [&](const Stop& s) {
      if (stops.empty()) return 0.0;
      const Eigen::Vector3d way = s.feet - stops.back().feet;
      return way.head<2>().norm() + kStoreyCosts * std::abs(way.z());
    };
    const auto next =
        std::min_element(left.begin(), left.end(), [&](const Stop& a, const Stop& b) { return far(a) < far(b); });
    stops.push_back(*next);
    left.erase(next);
  }
  return stops;
}

// Of the rectangle that it stands on or near; none: no floor to walk on.
std::optional<Eigen::Vector3d> onFloor(const WalkableMap& floor, const Eigen::Vector3d& feet) {
  const auto rectangle = floor.at(feet);
  if (!rectangle) return std::nullopt;
  const auto& box = floor.box(*rectangle);
  return Eigen::Vector3d(feet.cwiseMax(box.min).cwiseMin(box.max));
}

// A way by its corners, as places no farther apart than a step, at the height of the floor.
void append(std::vector<Eigen::Vector3d>& way, const std::vector<Eigen::Vector3d>& corners, const WalkableMap& floor) {
  constexpr double kPace_m = 0.1;
  for (const auto& corner : corners) {
    const Eigen::Vector3d from = way.back();
    const auto paces = std::max(1, static_cast<int>(std::ceil((corner - from).head<2>().norm() / kPace_m)));
    for (int k = 1; k <= paces; ++k) {
      Eigen::Vector3d next = from + (corner - from) * k / paces;
      next.z() = way.back().z();
      if (const auto rectangle = floor.under(next)) next.z() = floor.box(*rectangle).min.z();
      way.push_back(k == paces ? corner : next);
    }
  }
}

// Whoever walks opens doors; in a film they are left out instead.
std::shared_ptr<const HiddenProducts> withoutDoors(const Model& model) {
  auto hidden = *model.visibility.shared();
  const auto& environment = model.shown();
  if (!environment) return model.visibility.shared();
  hidden.resize(environment->products.size(), 0);
  for (std::size_t p = 0; p < hidden.size(); ++p)
    if (environment->products[p].ifc_class.starts_with("IfcDoor")) hidden[p] = 1;
  return std::make_shared<const HiddenProducts>(std::move(hidden));
}

// Whoever looks from a station, or walks from one to the next, would be inside of them.
void leaveOutInstruments(ViewState& view) {
  view.instruments.reset();
  view.under_way.reset();
  view.working.reset();
}

}  // namespace

ShotRequest shotOf(const Model& model, ShotKind kind) {
  ShotRequest request;
  request.kind = kind;
  request.width = rowOf(kind).width;
  request.height = rowOf(kind).height;
  request.view = model.viewState();
  request.around = model.buildingBounds();
  if (kind == ShotKind::picture) return request;
  static const auto kNothing = std::make_shared<const std::vector<std::uint32_t>>();
  request.view.selected = kNothing;
  request.view.camera.orthographic = false;
  if (kind != ShotKind::turntable) leaveOutInstruments(request.view);
  if (kind != ShotKind::walk_through) return request;
  request.view.hidden = withoutDoors(model);
  request.view.cut_height_m.reset();
  request.view.grid = false;
  return request;
}

Result<void> lookFrom(const Model& model, const ShotPlace& place, ShotRequest& request) {
  auto& camera = request.view.camera;
  if (place.station.empty() && !place.eye) return {};
  leaveOutInstruments(request.view);
  camera.orthographic = false;
  camera.elevation_rad = 0;
  camera.view_angle_rad = kWide_rad;
  camera.distance_m = 1;
  Eigen::Vector3d eye = place.eye ? Eigen::Vector3d(*place.eye - model.shift_m()) : Eigen::Vector3d::Zero();
  if (!place.station.empty()) {
    static const std::vector<Station> none;
    const auto& job = model.session.document().job;
    const auto& stations = job ? job->stations : none;
    const auto at =
        std::find_if(stations.begin(), stations.end(), [&](const Station& s) { return s.name == place.station; });
    if (at == stations.end()) return failure(ErrorKind::usage, fmt::format("unknown station '{}'", place.station));
    camera.azimuth_rad = yawOf(at->true_pose.rotation) - std::numbers::pi / 2;
    if (!place.eye) eye = at->true_pose.translation;
  }
  camera.target = eye + camera.forward();
  request.view.cut_height_m.reset();  // whoever stands inside sees all
  return {};
}

Result<std::vector<Eigen::Vector3d>> wayThrough(const Document& document, const WalkedGround& ground,
                                                const WalkStops& stops, Report& report, Progress& progress) {
  std::vector<Stop> all;
  if (stops.rooms) {
    all = roomStops(ground);
  } else {
    TRY_ASSIGN(all, stationStops(document, stops.stations));
  }
  const WalkableMap floor(ground.collision->walkable);
  std::vector<Eigen::Vector3d> way;
  const Stop* last = nullptr;
  for (std::size_t i = 0; i < all.size(); ++i) {
    progress.advance(static_cast<double>(i) / static_cast<double>(all.size()));
    TRY(progress.check());
    const auto there = onFloor(floor, all[i].feet);
    if (!there) {
      report.warn(all[i].name, "left out of the walk: no floor to walk on beside it");
      continue;
    }
    if (last == nullptr) {
      way = {*there};
      last = &all[i];
      continue;
    }
    const auto corners = floor.way(way.back(), *there);
    if (corners.empty()) {
      report.warn(all[i].name, "left out of the walk: cannot be reached on foot from " + last->name);
      continue;
    }
    append(way, corners, floor);
    last = &all[i];
  }
  return way;
}

}  // namespace standpoint
