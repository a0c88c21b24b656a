// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/stations/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/ceiling.h"
#include "core/units.h"
#include "optimizer/surface/triangle_tree.h"
#include "survey/scene/bodies.h"

namespace standpoint {

namespace {

// The nearest point of an instance, no farther than `reach_m`, which shrinks.
bool nearestOf(const Environment& environment, const Instance& instance, const Eigen::Vector3d& p, double& reach_m) {
  const auto& mesh = *environment.meshes[instance.mesh];
  bool found = false;
  for (const auto& t : mesh.triangles) {
    const auto corner = [&](int k) -> Eigen::Vector3d {
      return instance.world_from_mesh * mesh.positions[t[k]].cast<double>();
    };
    const Eigen::Vector3d a = corner(0), b = corner(1), c = corner(2);
    if (distanceTo({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)}, p) >= reach_m) continue;
    const double distance = (closestPoint(p, a, b, c) - p).norm();
    if (distance >= reach_m) continue;
    reach_m = distance;
    found = true;
  }
  return found;
}

const Eigen::Vector3d kDown(0, 0, -1);
const Eigen::Vector3d kUp(0, 0, 1);

}  // namespace

std::string plainKind(const Product& product) {
  std::string_view rest = product.ifc_class;
  if (rest.empty()) return "object";
  if (rest.starts_with("Ifc")) rest.remove_prefix(3);
  for (const std::string_view end : {"StandardCase", "ElementedCase", "Type"})
    if (rest.ends_with(end) && rest.size() > end.size()) rest.remove_suffix(end.size());
  std::string kind;
  for (const char c : rest) {
    const bool upper = c >= 'A' && c <= 'Z';
    if (upper && !kind.empty()) kind += ' ';
    kind += upper ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return kind == "building element proxy" ? "object" : kind;
}

std::string someKind(const Product& product) {
  const auto kind = plainKind(product);
  return (std::string_view("aeiou").find(kind.front()) == std::string_view::npos ? "a " : "an ") + kind;
}

double slopeOf(const RayHit& hit) { return std::acos(std::clamp(std::abs(hit.normal.z()), 0.0, 1.0)); }

StationPlacement::StationPlacement(const RayScene& scene, const TripodStand& stand, double trunnion_m)
    : scene_(scene), stand_(stand), trunnion_m_(trunnion_m), instances_(instanceBounds(scene.environment())) {
  for (const auto& each : instances_) all_.extend(each);
}

std::optional<Refusal> StationPlacement::badHeight(double height_m) const {
  if (height_m >= lowest_m() - 1e-9 && height_m <= highest_m() + 1e-9) return std::nullopt;
  return Refusal{fmt::format("a tripod supports instrument heights of {:.2f} to {:.2f} m, not {:.2f} m", lowest_m(),
                             highest_m(), height_m),
                 "change the height, or use the stand 'free' for suspended or handheld instruments",
                 fmt::format("Tripod reaches {:.2f} to {:.2f} m", lowest_m(), highest_m())};
}

std::optional<StationPlacement::Near> StationPlacement::nearest(const Eigen::Vector3d& centre, double reach_m) const {
  const auto& environment = scene_.environment();
  std::optional<Near> found;
  for (std::uint32_t i = 0; i < instances_.size(); ++i)
    if (!instances_[i].empty() && distanceTo(instances_[i], centre) < reach_m &&
        nearestOf(environment, environment.instances[i], centre, reach_m))
      found = Near{reach_m, environment.instances[i].product};
  return found;
}

std::optional<Refusal> StationPlacement::tooNear(const Eigen::Vector3d& centre) const {
  const auto near = nearest(centre, stand_.clearance_m);
  if (!near) return std::nullopt;
  const auto& product = scene_.environment().products[near->product];
  return Refusal{
      fmt::format("the instrument centre would be {:.0f} mm from {}, but needs {:.0f} mm of clearance",
                  near->distance_m * 1000, productText(product), stand_.clearance_m * 1000),
      fmt::format("move it {:.0f} mm away", std::ceil((stand_.clearance_m - near->distance_m) * 1000 - 0.01)),
      // whole ones, as 19.5 cm of the 20 that it needs shall not read as 20; 10 cm are 10 where they are stored
      // as 9.99…
      fmt::format("{:.0f} cm from {}", std::floor(near->distance_m * 100 + 0.05), plainKind(product))};
}

bool StationPlacement::worthTrying(const Eigen::Vector3d& centre) const {
  for (const double elevation : {-0.6, 0.0, 0.6})
    for (int k = 0; k < 8; ++k) {
      const double azimuth = k * std::numbers::pi / 4 + 0.01;
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                      std::sin(elevation));
      if (scene_.intersect(centre, direction, stand_.clearance_m)) return false;
    }
  return !scene_.intersect(centre, kUp, stand_.headroom_m);
}

std::optional<Refusal> StationPlacement::noHeadroom(const Eigen::Vector3d& centre) const {
  const auto above = scene_.intersect(centre, kUp, stand_.headroom_m);
  if (!above) return std::nullopt;
  return Refusal{
      fmt::format("{} is {:.2f} m above the instrument centre, which needs {:.2f} m of headroom",
                  productText(scene_.environment().products[above->product]), above->range_m, stand_.headroom_m),
      fmt::format("lower it by {:.2f} m, or choose another place", stand_.headroom_m - above->range_m),
      fmt::format("{:.0f} cm below {}", above->range_m * 100, someKind(scene_.environment().products[above->product]))};
}

std::optional<Ground> StationPlacement::groundBelow(const Eigen::Vector3d& centre) const {
  if (all_.empty()) return std::nullopt;
  if (const auto hit = scene_.intersect(centre, kDown, centre.z() - all_.min.z() + 1))
    return Ground{hit->position.z(), slopeOf(*hit), productText(scene_.environment().products[hit->product]),
                  isSuspendedCeiling(scene_.environment().products[hit->product]), hit->product};
  if (all_.min.z() > centre.z()) return std::nullopt;
  return Ground{all_.min.z(), 0, {}, false};
}

std::string StationPlacement::steepText(double slope_rad, const Product& product) const {
  return slope_rad > stand_.wall_rad ? "Not a floor: " + plainKind(product)
                                     : fmt::format("On a slope of {:.0f}°", slope_rad / kRadPerDeg);
}

std::optional<Refusal> StationPlacement::badGround(const Eigen::Vector3d& centre) const {
  const auto ground = groundBelow(centre);
  const char* elsewhere = "choose a point on a floor, or use the stand 'free' for suspended or handheld instruments";
  if (!ground)
    return Refusal{"no ground below: the whole model is above the station, or there is no model", elsewhere,
                   "No floor below"};
  if (ground->ceiling)
    return Refusal{fmt::format("the ground below is {}, a suspended ceiling, which bears nobody", ground->product),
                   elsewhere, "On a suspended ceiling"};
  const double height = centre.z() - ground->z;
  if (height > highest_m() + 1e-3)
    return Refusal{
        fmt::format("too high: {} is {:.2f} m below the instrument centre, and a tripod supports up to {:.2f} m",
                    ground->modelled() ? ground->product : "the lowest level of the model", height, highest_m()),
        fmt::format("lower it by at least {:.2f} m, or {}", height - highest_m(), elsewhere),
        fmt::format("{:.2f} m above the ground", height)};
  if (height < lowest_m() - 1e-3)
    return Refusal{
        fmt::format("too low: {} is only {:.2f} m below the instrument centre, and a tripod needs at least {:.2f} m",
                    ground->modelled() ? ground->product : "the lowest level of the model", height, lowest_m()),
        fmt::format("raise it by {:.2f} m, or {}", lowest_m() - height, elsewhere),
        fmt::format("Only {:.2f} m above ground", height)};
  if (ground->slope_rad >= stand_.steepest_rad)
    return Refusal{fmt::format("the ground below is {} of {:.0f} degrees, {}; a tripod needs less than {:.0f} degrees",
                               ground->slope_rad > stand_.wall_rad ? "a wall" : "a slope",
                               ground->slope_rad / kRadPerDeg, ground->product, stand_.steepest_rad / kRadPerDeg),
                   elsewhere, steepText(ground->slope_rad, scene_.environment().products[*ground->index])};
  return noFooting(centre, *ground);
}

// Turned by any of a few angles the three feet must find ground that their legs reach.
std::optional<Refusal> StationPlacement::noFooting(const Eigen::Vector3d& centre, const Ground& ground) const {
  if (!ground.modelled()) return std::nullopt;
  constexpr int kTurns = 12;
  constexpr int kSteps = 3 * kTurns;
  bool stands[kSteps] = {};
  for (int k = 0; k < kSteps; ++k) {
    const double azimuth = 2 * std::numbers::pi * k / kSteps;
    const Eigen::Vector3d from(centre.x() + stand_.foot_radius_m * std::cos(azimuth),
                               centre.y() + stand_.foot_radius_m * std::sin(azimuth), ground.z + stand_.foot_play_m);
    stands[k] = scene_.intersect(from, kDown, 2 * stand_.foot_play_m).has_value();
  }
  for (int k = 0; k < kTurns; ++k)
    if (stands[k] && stands[k + kTurns] && stands[k + 2 * kTurns]) return std::nullopt;
  return Refusal{fmt::format("the tripod feet, {:.2f} m from the centre, have no ground: {} is too small here",
                             stand_.foot_radius_m, ground.product),
                 "move it away from the edge, or use the stand 'free' for suspended or handheld instruments",
                 "No ground under the feet"};
}

std::optional<Refusal> StationPlacement::whyNotOn(const RayHit& hit, double height_m) const {
  const double slope = slopeOf(hit);
  if (slope >= stand_.steepest_rad)
    return Refusal{
        fmt::format("this is {} of {:.0f} degrees, {}; a tripod needs less than {:.0f} degrees",
                    slope > stand_.wall_rad ? "a wall" : "a slope", slope / kRadPerDeg,
                    productText(scene_.environment().products[hit.product]), stand_.steepest_rad / kRadPerDeg),
        "choose a point on a floor", steepText(slope, scene_.environment().products[hit.product])};
  return whyNot(hit.position + Eigen::Vector3d(0, 0, height_m));
}

// In a body that has no class a tripod may stand where all else is well: many draw a room as a single box.
std::optional<Refusal> StationPlacement::whyNot(const Eigen::Vector3d& centre) const {
  const auto& environment = scene_.environment();
  const auto inside = [&](std::uint32_t product) { return "In " + someKind(environment.products[product]); };
  if (auto why = tooNear(centre)) {
    if (const auto around = bodyRound(environment, instances_, centre)) why->brief = inside(*around);
    return why;
  }
  const auto around = bodyRound(environment, instances_, centre);
  const bool solid = around && !environment.products[*around].ifc_class.empty();
  auto why = solid ? std::nullopt : noHeadroom(centre);
  if (!why && !solid) why = badGround(centre);
  if (!solid && !(around && why)) return why;
  return Refusal{fmt::format("the position is inside {}, a closed body", productText(environment.products[*around])),
                 "move it out of the body; if the body models a room, use the stand 'free'", inside(*around)};
}

std::optional<std::string> StationPlacement::remark(const Eigen::Vector3d& centre) const {
  const auto body = bodyRound(scene_.environment(), instances_, centre);
  if (!body) return std::nullopt;
  return fmt::format("inside {}, a closed body, treated as a room modelled as a single shell",
                     productText(scene_.environment().products[*body]));
}

}  // namespace standpoint
