// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/landing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "optimizer/walk/avatar.h"
#include "optimizer/walk/walker.h"

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kAside = 0.30;  // m that a place moves away from walls
constexpr int kPushes = 6;
constexpr double kPush = 0.05;       // m at a time, from an edge
constexpr double kEdgeSlack = 0.02;  // m
constexpr int kSteps = 8;            // directions in which a step is tried
constexpr int kAround = 16;          // directions in which an edge is looked for

// The floor there, away from what stands too near.
Vector3d besideWalls(const Obstacles& obstacles, const Body& low, Vector3d feet) {
  const Vector3d step(0, 0, kHighestStep);
  const Body upper{low.radius_m, low.height_m - kHighestStep};
  for (int i = 0; i < kPushes; ++i) {
    double deepest = -1e-4;
    Vector2d away = Vector2d::Zero();
    obstacles.near(upper, feet + step, 0, [&](const Contact& contact, double gap) {
      const Vector2d side = contact.normal.head<2>();
      if (gap >= deepest || side.norm() < 0.7) return;
      deepest = gap;
      away = side.normalized() * (-gap + 1e-3);
    });
    if (away.isZero()) break;
    feet.head<2>() += away;
  }
  return feet;
}

// Away from where the floor ends within the body's radius: there one may walk, but is put by nobody.
Vector3d besideEdges(const Obstacles& obstacles, double radius_m, Vector3d feet) {
  const Vector3d step(0, 0, kHighestStep);
  for (int i = 0; i < kPushes; ++i) {
    Vector2d away = Vector2d::Zero();
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      const Vector3d aside = (radius_m - kEdgeSlack) * Vector3d(std::cos(angle), std::sin(angle), 0);
      if (!obstacles.ray(feet + aside + step, feet + aside - step)) away -= aside.head<2>();
    }
    if (away.isZero()) return feet;
    if (away.norm() < 0.1 * radius_m) break;  // it ends on opposite sides
    feet.head<2>() += kPush * away.normalized();
    if (const auto floor = obstacles.ray(feet + step, feet - step)) feet.z() = floor->point.z();
  }
  return feet + Vector3d(2 * kAside, 0, 0);  // too far to be meant
}

// Whether one can make a step from there: on what is smaller nobody is put, and the walkable surface has no island.
bool hasRoomForAStep(const Obstacles& obstacles, const Body& low, const Vector3d& feet) {
  for (int k = 0; k < kSteps; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSteps;
    Avatar avatar(obstacles, low);
    if (!avatar.stand(feet + low.radius_m * Vector3d(std::cos(angle), std::sin(angle), 0), kHighestStep)) continue;
    if ((besideEdges(obstacles, low.radius_m, avatar.feet()) - avatar.feet()).norm() < kPush / 2) return true;
  }
  return false;
}

}  // namespace

Landing landingAt(const Obstacles& obstacles, const Body& body, const Vector3d& point, const Vector3d& normal) {
  Landing landing{point, {}};
  const double slope = std::acos(std::clamp(normal.z(), -1.0, 1.0)) * 180 / std::numbers::pi;
  if (slope > kSteepestSlopeDeg + 0.1) {
    landing.why_not = fmt::format("too steep: {:.0f}°, at most {:.0f}°", slope, kSteepestSlopeDeg);
    return landing;
  }
  const Vector3d up(0, 0, 1);
  const auto floor = obstacles.ray(point + 0.1 * up, point - kHighestStep * up);
  if (!floor) {
    landing.why_not = "no floor here";
    return landing;
  }
  landing.feet = floor->point;
  landing.product = floor->product;
  const Body low{body.radius_m, std::min(Walker::kCrouched_m, body.height_m)};
  const auto over = [&] { return obstacles.ray(landing.feet + 0.02 * up, landing.feet + low.height_m * up); };
  auto above = over();
  if (above && above->point.z() - landing.feet.z() < kHighestStep)  // one stands on what is over it, as on a step
    if (const auto top = obstacles.ray(landing.feet + kHighestStep * up, landing.feet)) {
      landing.feet = top->point;
      landing.product = top->product;
      above = over();
    }
  if (above) {
    landing.why_not =
        fmt::format("no headroom: {:.2f} m, at least {:.2f} m", above->point.z() - landing.feet.z(), low.height_m);
    return landing;
  }
  const Vector3d aside = besideEdges(obstacles, low.radius_m, besideWalls(obstacles, low, landing.feet));
  Avatar avatar(obstacles, low);
  if ((aside - landing.feet).norm() > kAside || !avatar.stand(aside, kHighestStep))
    landing.why_not = fmt::format("too narrow: somebody is {:.2f} m wide", 2 * low.radius_m);
  else if (!hasRoomForAStep(obstacles, low, avatar.feet()))
    landing.why_not = "too small to stand on";
  else
    landing.feet = avatar.feet();
  return landing;
}

}  // namespace standpoint
