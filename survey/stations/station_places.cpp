// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/station_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/ceiling.h"
#include "core/units.h"
#include "survey/scene/bodies.h"
#include "survey/stations/storeys.h"

namespace standpoint {

namespace {

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

constexpr double kFloorSearch_m = 0.5;            // how far a stated height of a floor may be off
constexpr double kNoFloor_rad = 60 * kRadPerDeg;  // a wall; whether it is too steep a floor, StationPlacement says

std::vector<double> heightsBelow(const RayScene& scene, double x, double y) {
  const Bounds b = bounds(scene.environment());
  std::vector<double> heights;
  double z = b.max.z() + 1;
  while (true) {
    const auto hit = scene.intersect({x, y, z}, -Eigen::Vector3d::UnitZ(), z - b.min.z() + 1);
    if (!hit) return heights;
    const bool bears = !isSuspendedCeiling(scene.environment().products[hit->product]);
    if (bears && slopeOf(*hit) < kNoFloor_rad) heights.push_back(hit->position.z());
    z = hit->position.z() - 1e-4;
    if (heights.size() > 10000) return heights;
  }
}

// All floors of the model.
std::vector<Eigen::Vector3d> allFloors(const RayScene& scene, const GroundSearch& search) {
  std::vector<Eigen::Vector3d> places;
  constexpr std::size_t kMost = 400;
  if (search.walkable != nullptr && !search.walkable->triangles.empty()) {
    const auto& mesh = *search.walkable;
    const std::size_t step = mesh.triangles.size() / kMost + 1;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += step) {
      const auto& t = mesh.triangles[i];
      places.emplace_back(((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3).cast<double>());
    }
    return places;
  }
  const Bounds b = bounds(scene.environment());
  if (b.empty()) return places;
  for (int j = 1; j < 16; ++j)
    for (int i = 1; i < 16; ++i) {
      const double x = b.min.x() + (b.max.x() - b.min.x()) * i / 16;
      const double y = b.min.y() + (b.max.y() - b.min.y()) * j / 16;
      for (const double z : floorsAt(scene, x, y, search.height_m)) places.emplace_back(x, y, z);
    }
  return places;
}

// The product that a ground is of.
const Product* productAt(const RayScene& scene, const Eigen::Vector3d& ground) {
  constexpr double kReach_m = 0.3;  // the walkable surface is level, a floor need not be
  const auto hit = scene.intersect(ground + Eigen::Vector3d(0, 0, kReach_m), -Eigen::Vector3d::UnitZ(), 2 * kReach_m);
  return hit ? &scene.environment().products[hit->product] : nullptr;
}

}  // namespace

std::vector<double> floorsAt(const RayScene& scene, double x_m, double y_m, double instrument_height_m) {
  const auto heights = heightsBelow(scene, x_m, y_m);  // falling
  std::vector<double> floors;
  for (auto h = heights.rbegin(); h != heights.rend(); ++h)
    if (isRoomAbove(scene, {x_m, y_m, *h}, instrument_height_m)) floors.push_back(*h);
  return floors;
}

std::optional<BlockedFloor> blockedFloorAt(const RayScene& scene, double x_m, double y_m, double instrument_height_m,
                                           std::optional<double> z_m) {
  auto heights = heightsBelow(scene, x_m, y_m);
  std::reverse(heights.begin(), heights.end());  // rising
  if (z_m)
    std::stable_sort(heights.begin(), heights.end(),
                     [z = *z_m](double a, double b) { return std::abs(a - z) < std::abs(b - z); });
  for (const double h : heights) {
    if (z_m && std::abs(*z_m - h) > kFloorSearch_m) continue;
    const auto above =
        scene.intersect({x_m, y_m, h + 1e-3}, Eigen::Vector3d::UnitZ(), instrument_height_m + kRoomAbove_m);
    if (!above) continue;
    const auto* product = &scene.environment().products[above->product];
    if (product == productAt(scene, {x_m, y_m, h})) continue;  // the underside of what one stands on
    return BlockedFloor{h, above->range_m, above->product};
  }
  return std::nullopt;
}

bool isRoomAbove(const RayScene& scene, const Eigen::Vector3d& floor, double instrument_height_m) {
  return !scene.intersect(floor + Eigen::Vector3d(0, 0, 1e-3), Eigen::Vector3d::UnitZ(),
                          instrument_height_m + kRoomAbove_m);
}

Result<double> chosenFloor(const std::vector<double>& floors, std::optional<double> z_file_m, double shift_z_m) {
  if (!z_file_m) return floors.front();
  const double z = *z_file_m - shift_z_m;
  const double nearest = *std::min_element(floors.begin(), floors.end(),
                                           [z](double a, double b) { return std::abs(a - z) < std::abs(b - z); });
  if (std::abs(nearest - z) <= kFloorSearch_m) return nearest;
  return failure(ErrorKind::unusable, fmt::format("no floor within {} m of height {}; the nearest floor is at {:.3f}",
                                                  kFloorSearch_m, *z_file_m, nearest + shift_z_m));
}

std::vector<std::vector<Eigen::Vector3d>> groundsToTry(const Job& job, const RayScene& scene,
                                                       const GroundSearch& search) {
  std::vector<std::vector<Eigen::Vector3d>> lists;
  if (job.stations.empty())
    for (const auto& storey : storeysFromGround(scene.environment(), search.shift_z_m))
      lists.push_back(placesIn(storey, scene, search.height_m));
  std::vector<Eigen::Vector3d> floors, other;
  for (const auto& ground : allFloors(scene, search)) {
    const auto* product = productAt(scene, ground);
    if (product == nullptr || isSuspendedCeiling(*product)) continue;
    (isMadeForStanding(*product) ? floors : other).push_back(ground);
  }
  lists.push_back(std::move(floors));
  lists.push_back(std::move(other));
  return lists;
}

std::vector<Eigen::Vector3d> groundWithoutFloor(const RayScene& scene) {
  constexpr std::size_t kProducts = 40;
  constexpr int kWithin = 12;
  std::vector<Eigen::Vector3d> places;
  Bounds all;
  for (const auto& box : instanceBounds(scene.environment())) all.extend(box);
  if (all.empty()) return places;
  for (int k = 0; k < kWithin * kWithin; ++k)
    places.emplace_back(all.min.x() + (all.max.x() - all.min.x()) * (k % kWithin + 0.5) / kWithin,
                        all.min.y() + (all.max.y() - all.min.y()) * (k / kWithin + 0.5) / kWithin, all.min.z());
  addPlacesAround(all, 16, places);
  const auto each = productBounds(scene.environment());
  for (std::size_t p = 0; p < each.size(); p += each.size() / kProducts + 1)
    if (scene.environment().products[p].inScene() && !each[p].empty()) addPlacesAround(each[p], 4, places);
  return places;
}

std::optional<Eigen::Vector3d> placeBeside(const Job& job, const StationPlacement& placement, const Station& station) {
  constexpr double kApart_m = 1, kSameFloor_m = 0.5;
  constexpr int kDirections = 16;
  const auto& scene = placement.scene();
  const Eigen::Vector3d& from = station.true_pose.translation;
  const double height = station.instrument_height_m;
  const auto isFree = [&](const Eigen::Vector3d& centre) {
    const Eigen::Vector3d way = centre - from;
    return std::all_of(job.stations.begin(), job.stations.end(),
                       [&](const Station& s) { return (s.true_pose.translation - centre).norm() > kApart_m - 1e-6; }) &&
           !scene.intersect(from, way.normalized(), way.norm()) && placement.worthTrying(centre) &&
           !placement.whyNot(centre);
  };
  for (const double away : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0})
    for (int k = 0; k < kDirections; ++k) {
      const double azimuth = 2 * std::numbers::pi * k / kDirections;
      const double x = from.x() + away * std::cos(azimuth), y = from.y() + away * std::sin(azimuth);
      for (const double floor : floorsAt(scene, x, y, height))
        if (const Eigen::Vector3d centre(x, y, floor + height);
            std::abs(centre.z() - from.z()) < kSameFloor_m && isFree(centre))
          return centre;
    }
  return std::nullopt;
}

double roomAround(const RayScene& scene, const Eigen::Vector3d& centre) {
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

std::optional<Eigen::Vector3d> bestOf(const std::vector<std::vector<Eigen::Vector3d>>& grounds, const Job& job,
                                      const StationPlacement& placement, double height_m,
                                      const std::function<double(const Eigen::Vector3d&)>& worth, Progress& progress) {
  constexpr double kApart_m = 2.5;
  double best = 0;
  std::optional<Eigen::Vector3d> chosen;
  for (const auto& list : grounds) {
    for (std::size_t k = 0; k < list.size() && !progress.cancelled(); ++k) {
      progress.advance(static_cast<double>(k) / static_cast<double>(list.size()));
      const Eigen::Vector3d centre = list[k] + Eigen::Vector3d(0, 0, height_m);
      const bool apart = std::all_of(job.stations.begin(), job.stations.end(), [&](const Station& s) {
        return (s.true_pose.translation - centre).norm() >= kApart_m;
      });
      if (!apart || !placement.worthTrying(centre)) continue;
      if (const double value = worth(centre); value > best && !placement.whyNot(centre)) {
        best = value;
        chosen = centre;
      }
    }
    if (chosen) break;
  }
  return chosen;
}

}  // namespace standpoint
