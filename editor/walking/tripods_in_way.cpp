// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/walking/tripods_in_way.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "optimizer/surface/piece.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kRadius_m = 0.2;
constexpr int kSides = 12;
constexpr double kTouch_m = 1e-3;  // a body this deep in something is in it

bool isIn(const Vector3d& feet, const Body& body, const Tripod& tripod) {
  return (feet - tripod.foot).head<2>().norm() < kRadius_m + body.radius_m - kTouch_m &&
         feet.z() < tripod.foot.z() + tripod.height_m && feet.z() + body.height_m > tripod.foot.z();
}

// Around the circle, so that nobody who touches a side is in it.
CollisionShape postOf(const Tripod& tripod) {
  const double corner_m = kRadius_m / std::cos(std::numbers::pi / kSides);
  std::vector<Vector3d> bottom, top;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    bottom.push_back(tripod.foot + corner_m * Vector3d(std::cos(angle), std::sin(angle), 0));
    top.push_back(bottom.back() + Vector3d(0, 0, tripod.height_m));
  }
  return shapeOf(prism(bottom, top, CollisionShapeKind::convex), 0);
}

}  // namespace

void TripodsInWay::follow(const std::vector<Tripod>& tripods, const Vector3d& feet, const Body& body) {
  std::vector<Tripod> met;
  for (const auto& tripod : tripods)
    if (tripod.height_m > 0 && !isIn(feet, body, tripod)) met.push_back(tripod);
  if (met == met_) return;
  met_ = std::move(met);
  std::vector<CollisionShape> posts;
  for (const auto& tripod : met_) posts.push_back(postOf(tripod));
  obstacles_ = posts.empty() ? nullptr : std::make_unique<Obstacles>(posts);
}

}  // namespace standpoint
