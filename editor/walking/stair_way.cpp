// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/walking/stair_way.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "optimizer/walk/avatar.h"
#include "optimizer/walk/walker.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kLevel_m = 0.45;     // a floor may be as far from its storey's level
constexpr double kOffStair_m = 0.35;  // of who has left it, beside its box …
constexpr double kNearStair_m = 2;    // … and is not elsewhere
constexpr double kOntoFloor_m = 0.8;  // from the last step
constexpr double kSampled_m = 0.1;

Vector3d nearestIn(const Bounds& box, const Vector3d& p) { return p.cwiseMax(box.min).cwiseMin(box.max); }

double besideBox_m(const Bounds& box, const Vector3d& p) { return (p - nearestIn(box, p)).head<2>().norm(); }

std::vector<Vector3d> wayOn(const WalkableMap& map, const Vector3d& feet, const Bounds& stair, double elevation_m) {
  const auto start = map.at(feet);
  if (!start) return {};
  const Vector3d from = nearestIn(map.box(*start), feet);
  const auto wanted = [&](std::uint32_t i) {
    if (std::abs(map.box(i).max.z() - elevation_m) > kLevel_m) return false;
    const double beside_m = besideBox_m(stair, map.middle(i));
    return beside_m > kOffStair_m && besideBox_m(map.box(i), nearestIn(stair, map.middle(i))) < kNearStair_m;
  };
  const auto rough =
      map.cheapestWay(std::span(&from, 1), wanted, [](const Vector3d& a, const Vector3d& b) { return (b - a).norm(); });
  if (rough.empty()) return {};
  // The way ends on the rim of the floor, which it shares with a tread: a little farther one has left the stair.
  std::optional<std::uint32_t> floor;
  const auto away_m = [&](std::uint32_t i) { return (nearestIn(map.box(i), rough.back()) - rough.back()).norm(); };
  for (std::uint32_t i = 0; i < map.size(); ++i)
    if (wanted(i) && (!floor || away_m(i) < away_m(*floor))) floor = i;
  Vector3d goal = nearestIn(map.box(*floor), rough.back());
  const Vector3d on = map.middle(*floor) - goal;
  goal += on * std::min(1.0, kOntoFloor_m / std::max(on.norm(), 1e-9));
  if (elevation_m > feet.z()) return map.way(from, goal);
  auto corners = map.way(goal, from);  // what leads up leads down: from above a way cuts the corners of a spiral
  std::reverse(corners.begin(), corners.end());
  return corners;
}

bool isOfStair(const Environment& environment, std::uint32_t product) {
  return environment.products[product].ifc_class.starts_with("IfcStair");
}

// The first tread from there over which nobody has room, of a stair that may lie under a slab.
std::optional<LowPlace> firstLowPlace(const WalkedGround& ground, const Vector3d& feet, const Bounds& stair) {
  constexpr int kMostLayers = 8;
  constexpr double kClear_m = 0.02, kOver_m = 3, kLevel = 0.9;
  std::optional<LowPlace> first;
  for (double x = stair.min.x() + kSampled_m / 2; x < stair.max.x(); x += kSampled_m)
    for (double y = stair.min.y() + kSampled_m / 2; y < stair.max.y(); y += kSampled_m) {
      Vector3d from(x, y, stair.max.z() + kOver_m);
      for (int layer = 0; layer < kMostLayers; ++layer) {
        const auto hit = ground.obstacles.ray(from, {x, y, stair.min.z() - kClear_m});
        if (!hit) break;
        from.z() = hit->point.z() - kClear_m;
        if (!isOfStair(*ground.environment, hit->product) || hit->normal.z() < kLevel) continue;
        // What is nearer is the next tread, on to which one steps.
        if (const auto over = ground.obstacles.ray(hit->point + Vector3d(0, 0, kHighestStep),
                                                   hit->point + Vector3d(0, 0, Walker::kCrouched_m)))
          if (!first || std::abs(hit->point.z() - feet.z()) < std::abs(first->tread.z() - feet.z()))
            first = LowPlace{hit->point, over->point.z() - hit->point.z()};
        break;
      }
    }
  return first;
}

}  // namespace

StairWay stairWay(const WalkedGround& ground, const Vector3d& feet, const Bounds& box, double elevation_m) {
  for (const auto* map : {&ground.map, &ground.crouched_map})
    if (auto corners = wayOn(*map, feet, box, elevation_m); !corners.empty()) return {std::move(corners), {}};
  return {{}, firstLowPlace(ground, feet, box)};
}

}  // namespace standpoint
