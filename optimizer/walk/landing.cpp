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

}  // namespace

Landing landingAt(const Obstacles& obstacles, const Body& body, const Vector3d& point, const Vector3d& normal) {
  Landing landing{point, {}};
  const double slope = std::acos(std::clamp(normal.z(), -1.0, 1.0)) * 180 / std::numbers::pi;
  if (slope > kSteepestSlopeDeg + 0.1) {
    landing.why_not = fmt::format("too steep {:.0f}°", slope);
    return landing;
  }
  const Vector3d up(0, 0, 1);
  const auto floor = obstacles.ray(point + 0.1 * up, point - kHighestStep * up);
  if (!floor) {
    landing.why_not = "no floor";
    return landing;
  }
  landing.feet = floor->point;
  const Body low{body.radius_m, std::min(Walker::kCrouched_m, body.height_m)};
  if (const auto above = obstacles.ray(landing.feet + 0.02 * up, landing.feet + low.height_m * up)) {
    landing.why_not = fmt::format("headroom {:.1f} m", above->point.z() - landing.feet.z());
    return landing;
  }
  const Vector3d aside = besideWalls(obstacles, low, landing.feet);
  Avatar avatar(obstacles, low);
  if ((aside - landing.feet).norm() > kAside || !avatar.stand(aside, kHighestStep))
    landing.why_not = "too narrow";
  else
    landing.feet = avatar.feet();
  return landing;
}

}  // namespace standpoint
