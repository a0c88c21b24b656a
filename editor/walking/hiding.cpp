// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/walking/hiding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kGrid_m = 0.4;  // between places that are tried
constexpr std::size_t kMostWays = 80;
constexpr double kNearestBeside_m = 0.6, kFarthestBeside_m = 1.3;
constexpr double kPace_mps = 1.2;

bool isMet(const RayScene& scene, const Vector3d& eye, const Vector3d& place) {
  constexpr int kMostPanes = 16;
  constexpr double kStep_m = 1e-3;
  const Vector3d way = place - eye;
  const double range = way.norm();
  double travelled = 0;
  for (int pane = 0; pane < kMostPanes && travelled < range; ++pane) {
    const auto hit = scene.intersect(eye + way * (travelled / range), way / range, range - travelled);
    if (!hit) return true;
    const auto& surface = scene.environment().surfaces[hit->surface];
    if (surface.colour.a >= 1 && surface.transmission.value_or(0) <= 0) return false;
    travelled += hit->range_m + kStep_m;
  }
  return true;
}

// In the middle of equal parts of each rectangle that can be walked to, nearest first.
std::vector<Vector3d> placesAround(const WalkableMap& map, const Vector3d& feet) {
  const auto start = map.at(feet);
  if (!start) return {};
  std::vector<Vector3d> places;
  for (std::uint32_t i = 0; i < map.size(); ++i) {
    if (map.islandOf(i) != map.islandOf(*start)) continue;
    const auto& box = map.box(i);
    const Vector3d size = box.max - box.min;
    const int nx = std::max(1, static_cast<int>(std::ceil(size.x() / kGrid_m))),
              ny = std::max(1, static_cast<int>(std::ceil(size.y() / kGrid_m)));
    for (int x = 0; x < nx; ++x)
      for (int y = 0; y < ny; ++y)
        places.emplace_back(box.min.x() + (x + 0.5) / nx * size.x(), box.min.y() + (y + 0.5) / ny * size.y(),
                            box.max.z());
  }
  std::stable_sort(places.begin(), places.end(),
                   [&](const auto& a, const auto& b) { return (a - feet).squaredNorm() < (b - feet).squaredNorm(); });
  return places;
}

// The one with the shortest way to it; no way is shorter than the straight one.
std::optional<WalkAim> nearest(const WalkableMap& map, const Vector3d& feet,
                               const std::function<bool(const Vector3d&)>& wanted) {
  std::optional<WalkAim> best;
  std::size_t ways = 0;
  for (const auto& place : placesAround(map, feet)) {
    if (best && (place - feet).norm() >= best->way_m) break;
    if (!wanted(place)) continue;
    if (++ways > kMostWays) break;
    const auto way = map.way(feet, place);
    if (way.empty()) continue;
    double length = (way.front() - feet).norm();
    for (std::size_t i = 1; i < way.size(); ++i) length += (way[i] - way[i - 1]).norm();
    if (!best || length < best->way_m) best = {place, length};
  }
  return best;
}

}  // namespace

bool isInBeam(const RayScene& scene, const Vector3d& eye, const Vector3d& feet, const Body& body) {
  Vector3d aside = Vector3d::UnitZ().cross(feet - eye);
  aside = aside.norm() > 1e-6 ? Vector3d(aside.normalized() * body.radius_m) : Vector3d(body.radius_m, 0, 0);
  const std::array heights = {0.1, 0.3 * body.height_m, 0.6 * body.height_m, 0.8 * body.height_m, body.height_m - 0.05};
  for (const double height : heights)
    for (const int side : {0, -1, 1})
      if (isMet(scene, eye, feet + Vector3d(0, 0, height) + side * aside)) return true;
  return false;
}

std::optional<WalkAim> nearestHiding(const WalkableMap& map, const RayScene& scene, const Vector3d& eye,
                                     const Vector3d& feet, const Body& body) {
  return nearest(map, feet, [&](const Vector3d& place) { return !isInBeam(scene, eye, place, body); });
}

std::optional<WalkAim> nearestBeside(const WalkableMap& map, const Vector3d& foot, const Vector3d& feet) {
  return nearest(map, feet, [&](const Vector3d& place) {
    const double away_m = (place - foot).head<2>().norm();
    return away_m >= kNearestBeside_m && away_m <= kFarthestBeside_m && std::abs(place.z() - foot.z()) < 1;
  });
}

double walkingTime_s(double way_m) { return way_m / kPace_mps; }

}  // namespace standpoint
