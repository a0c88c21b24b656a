// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/targets/target_placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "survey/scene/bodies.h"
#include "survey/scene/model_surface.h"
#include "survey/stations/station_places.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
constexpr double kSurfaceSearch_m = 0.5;  // of --on-surface
constexpr double kPlate_m = 0.002;        // a plate in front of its wall
constexpr double kTallestPole_m = 2.5;
constexpr double kTouch = 0.98;  // of its radius: what it stands on touches it

// The environment's instances whose product reaches into the ball: a search there need not build a tree of the whole.
Environment around(const Environment& environment, const Vector3d& place, double radius_m) {
  Environment part = environment;
  const auto each = productBounds(environment);
  std::erase_if(part.instances, [&](const Instance& i) {
    const Bounds& b = each[i.product];
    return b.empty() || (place - place.cwiseMax(b.min).cwiseMin(b.max)).norm() > radius_m;
  });
  return part;
}

bool stationSees(const Job& job, const RayScene& scene, const Vector3d& place) {
  return std::any_of(job.stations.begin(), job.stations.end(), [&](const Station& s) {
    const Vector3d way = place - s.true_pose.translation;
    return !scene.intersect(s.true_pose.translation, way.normalized(), way.norm() - 1e-3);
  });
}

// The side of a surface on which a target stuck to it is: where the place lies; of a place right on the surface where a
// station stands, else where the face looks.
Vector3d freeSide(const Job& job, const RayScene& scene, const Vector3d& place, const SurfaceTouch& touch) {
  const double off = touch.normal.dot(place - touch.position);
  if (std::abs(off) > 1e-3) return off > 0 ? touch.normal : Vector3d(-touch.normal);
  constexpr double kBefore_m = 0.02;
  const bool front = stationSees(job, scene, touch.position + kBefore_m * touch.normal);
  const bool back = stationSees(job, scene, touch.position - kBefore_m * touch.normal);
  return back && !front ? Vector3d(-touch.normal) : touch.normal;
}

// What cuts the target's body: rays over its sphere, or along its plate.
std::optional<RayHit> whatCuts(const RayScene& scene, const Target& t) {
  const double reach = t.size_m / 2 * kTouch;
  constexpr int kRays = 128;
  const Vector3d u = t.normal.unitOrthogonal(), v = t.normal.cross(u);
  for (int i = 0; i < kRays; ++i) {
    const double azimuth = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double z = t.kind == TargetKind::sphere ? 1 - (2 * i + 1.0) / kRays : 0;
    const Vector3d direction = z * t.normal + std::sqrt(1 - z * z) * (std::cos(azimuth) * u + std::sin(azimuth) * v);
    if (const auto hit = scene.intersect(t.centre, direction, reach)) return hit;
  }
  return std::nullopt;
}

Result<void> fits(const Job& job, const RayScene& scene, const Target& t) {
  const auto& products = scene.environment().products;
  if (const auto solid = bodyRound(scene.environment(), instanceBounds(scene.environment()), t.centre);
      solid && !stationSees(job, scene, t.centre))
    return failure(ErrorKind::unusable,
                   fmt::format("cannot place target {}: the position is inside {}; choose a free position", t.name,
                               productText(products[*solid])));
  if (const auto hit = whatCuts(scene, t))
    return failure(ErrorKind::unusable,
                   fmt::format("cannot place target {}: {} is {:.0f} mm from its centre, {:.0f} mm required; choose a "
                               "position farther away, or attach it to the surface",
                               t.name, productText(products[hit->product]), hit->range_m * 1000, t.size_m * 500));
  return {};
}

Result<double> floorFor(const RayScene& scene, const FloorPlace& on, const Vector3d& shift, double height) {
  const auto floors = floorsAt(scene, on.x_m - shift.x(), on.y_m - shift.y(), height);
  if (!floors.empty()) return chosenFloor(floors, on.z_m, shift.z());
  return failure(ErrorKind::unusable, fmt::format("no floor at ({}, {}) with {:.2f} m of free height for the target "
                                                  "tripod; choose another place or a smaller height",
                                                  on.x_m, on.y_m, height));
}

// A plate on a tripod is turned and tilted to the nearest station.
Vector3d towardsNearestStation(const Job& job, const Vector3d& centre) {
  const auto& stations = job.stations;
  if (stations.empty()) return Vector3d::UnitX();
  const auto nearest = std::min_element(stations.begin(), stations.end(), [&](const Station& a, const Station& b) {
    return (a.true_pose.translation - centre).norm() < (b.true_pose.translation - centre).norm();
  });
  const Vector3d way = nearest->true_pose.translation - centre;
  return way.norm() > 1e-6 ? Vector3d(way.normalized()) : Vector3d::UnitX();
}

Result<void> stick(const Job& job, const RayScene& scene, const Vector3d& place, double stand_off_m, Target& t,
                   std::string& stands, Report& report) {
  const ModelSurface surface(around(scene.environment(), place, kSurfaceSearch_m));
  const SurfaceTouch touch = surface.empty() ? SurfaceTouch{} : surface.nearest(place, kSurfaceSearch_m);
  if (touch.normal.isZero())
    return failure(
        ErrorKind::unusable,
        fmt::format("cannot place target {}: no surface within {} m; place it on a tripod", t.name, kSurfaceSearch_m));
  const Vector3d out = freeSide(job, scene, place, touch);
  t.normal = out;
  t.centre = touch.position + out * (stand_off_m + (t.kind == TargetKind::sphere ? t.size_m / 2 : kPlate_m));
  const auto behind = scene.intersect(t.centre, -out, t.size_m + stand_off_m);
  stands = behind ? productText(scene.environment().products[behind->product]) : "a surface";
  if (t.kind == TargetKind::sphere) return {};
  const Vector3d u = t.normal.unitOrthogonal(), v = t.normal.cross(u);
  const double deep = stand_off_m + kPlate_m + 0.005;
  for (const auto& [a, b] : std::array{std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}})
    if (!scene.intersect(t.centre + 0.5 * kTouch * t.size_m * (a * u + b * v), -out, deep)) {
      report.warn(t.name, "the plate crosses an edge or a curved surface: treated as flat");
      break;
    }
  return {};
}

bool isHeld(const RayScene& scene, const Target& t) {
  if (scene.intersect(t.centre, -Vector3d::UnitZ(), kTallestPole_m)) return true;
  for (int i = 0; i < 6; ++i) {
    Vector3d axis = Vector3d::Zero();
    axis[i / 2] = i % 2 == 0 ? 1 : -1;
    if (scene.intersect(t.centre, axis, t.size_m / 2 + 0.05)) return true;
  }
  return false;
}

}  // namespace

Result<Target> placedTarget(const Job& job, const Vector3d& shift, const RayScene& scene, Target t,
                            const TargetPlace& asked, std::string& stands, Report& report) {
  const int ways = static_cast<int>(asked.at.has_value()) + static_cast<int>(asked.on.has_value()) +
                   static_cast<int>(asked.on_surface.has_value());
  if (ways != 1)
    return failure(ErrorKind::usage,
                   "specify one of --at X,Y,Z (target centre), --on X,Y[,Z] (floor below its tripod), --on-surface "
                   "X,Y,Z (attach to the nearest surface)");
  if (asked.on) {
    const double height = asked.height_m;
    TRY_ASSIGN(const auto floor, floorFor(scene, *asked.on, shift, height));
    t.centre = {asked.on->x_m - shift.x(), asked.on->y_m - shift.y(), floor + height};
    t.normal = towardsNearestStation(job, t.centre);
    stands = fmt::format("a tripod of {:.2f} m", height);
  } else {
    t.centre = (asked.at ? *asked.at : *asked.on_surface) - shift;
  }
  if (asked.on_surface) {
    const Vector3d place = t.centre;
    TRY(stick(job, scene, place, asked.stand_off_m, t, stands, report));
  } else if (asked.normal) {
    if (asked.normal->norm() < 1e-9)
      return failure(ErrorKind::usage, "the normal requires three numbers, not all zero");
    t.normal = asked.normal->normalized();
  }
  TRY(fits(job, scene, t));
  if (asked.at && !isHeld(scene, t))
    report.warn(t.name, fmt::format("floating: no adjacent surface, and no floor within {} m below", kTallestPole_m));
  return t;
}

}  // namespace standpoint
