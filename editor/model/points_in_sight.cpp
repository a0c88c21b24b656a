// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/points_in_sight.h"

#include <algorithm>
#include <bitset>
#include <optional>
#include <vector>

#include "editor/model/model.h"
#include "editor/words/words.h"

namespace standpoint {

namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr std::size_t kAcross = 16, kDown = 9;

// An even part of the points that are drawn, which is enough to know where they are.
std::vector<Vector3d> someOf(const Cloud& cloud, const KeptPlace& kept) {
  constexpr std::size_t kMost = 20000;
  const std::size_t step = cloud.points.size() / kMost + 1;
  const Vector3d origin = cloud.pointsOrigin_m();
  std::vector<Vector3d> places;
  for (std::size_t i = 0; i < cloud.points.size(); i += step) {
    const auto& p = cloud.points[i].position_m;
    const Vector3d place = origin + Vector3d(p[0], p[1], p[2]);
    if (kept(place)) places.push_back(place);
  }
  return places;
}

// The centres of the instruments that measured it; none where they were carried, or the project has no such station.
std::vector<const Station*> stationsOf(const Model& model, const Cloud& cloud) {
  std::vector<const Station*> stations;
  const auto& job = model.session.document().job;
  for (const auto& measured : cloud.header.stations)
    for (std::size_t i = 0; job && i < job->stations.size(); ++i)
      if (job->stations[i].name == measured.name) stations.push_back(&job->stations[i]);
  return stations;
}

// Above the highest floor that they stand on, if there is a ceiling over it. Local frame.
std::optional<double> cutOver(const Model& model, const std::vector<const Station*>& stations) {
  const auto scene = model.picker.scene();
  if (!scene) return std::nullopt;
  std::optional<double> cut;
  for (const Station* station : stations) {
    const Vector3d& centre = station->true_pose.translation;
    constexpr double kHighest_m = 100;
    if (!scene->intersect(centre, Vector3d::UnitZ(), kHighest_m)) continue;
    const double height = centre.z() - station->instrument_height_m + kCutAboveFloor_m;
    cut = std::max(height, cut.value_or(height));
  }
  return cut;
}

}  // namespace

double shareWithPoints(const Cloud& cloud, const Camera& camera, const Vector2d& size_px, const KeptPlace& kept) {
  std::bitset<kAcross * kDown> filled;
  for (const auto& place : someOf(cloud, kept)) {
    const auto pixel = project(camera, place, size_px);
    if (!pixel || (pixel->array() < 0).any() || (pixel->array() >= size_px.array()).any()) continue;
    const Vector2d part = pixel->cwiseQuotient(size_px).cwiseProduct(Vector2d(kAcross, kDown));
    filled.set(static_cast<std::size_t>(part.y()) * kAcross + static_cast<std::size_t>(part.x()));
  }
  return static_cast<double>(filled.count()) / static_cast<double>(filled.size());
}

Bounds boundsOfMost(const Cloud& cloud, const KeptPlace& kept) {
  constexpr double kStray = 0.03;  // at either end of each axis
  auto places = someOf(cloud, kept);
  Bounds most;
  if (places.empty()) return most;
  const auto few = static_cast<std::ptrdiff_t>(kStray * static_cast<double>(places.size()));
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = [&](std::ptrdiff_t index) {
      const auto nth = places.begin() + index;
      std::nth_element(places.begin(), nth, places.end(),
                       [&](const Vector3d& a, const Vector3d& b) { return a[axis] < b[axis]; });
      return (*nth)[axis];
    };
    most.min[axis] = at(few);
    most.max[axis] = at(static_cast<std::ptrdiff_t>(places.size()) - 1 - few);
  }
  return most;
}

void bringPointsIntoView(Model& model) {
  constexpr double kEnough = 0.1, kElevation_rad = 0.85, kRoomAround = 1.2;
  const auto cloud = model.cloud();
  if (!cloud || cloud->points.empty() || model.proof || model.preview.isOpen()) return;
  auto& view = model.view;
  const auto& cut = model.visibility.cut_height_m;
  const auto clipped_in = [&](const Vector3d& place) { return !view.clip.box || view.clip.box->contains(place); };
  const auto kept = [&](const Vector3d& place) { return (!cut || place.z() <= *cut) && clipped_in(place); };
  Bounds around = boundsOfMost(*cloud, clipped_in);
  if (around.empty()) return;
  if (shareWithPoints(*cloud, view.camera, view.size, kept) >= kEnough) return;
  rememberView(model);
  stopWalking(model);
  stopFlying(model);
  model.visibility.cutForSight(cutOver(model, stationsOf(model, *cloud)));
  if (cut) around.max.z() = std::max(around.min.z(), std::min(around.max.z(), *cut));
  view.camera.orthographic = false;
  view.camera.view_angle_rad = Camera().view_angle_rad;
  view.camera.elevation_rad = kElevation_rad;
  model.bringIntoView(around);
  view.camera.distance_m *= kRoomAround;
  model.say(tr("The view has gone to the points of the scan. Alt+Left leads back."));
}

}  // namespace standpoint
