// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimizer/walk/avatar.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStride = 0.05;  // m
constexpr int kMostSlides = 4;    // of one stride: into a corner and out of it
constexpr double kCrack = 0.04;   // m, between two floors, that a foot does not notice
const Vector3d kStepUp(0, 0, kStepHeight);

}  // namespace

// Under the axis itself, so that nobody floats beside a step.
std::optional<double> Avatar::floorUnder(const Vector3d& p, double below_m) const {
  const auto hit = obstacles_->ray(p + kStepUp, p - Vector3d(0, 0, below_m));
  const double least = std::cos(kSteepestSlopeDeg * std::numbers::pi / 180) - 1e-6;
  return hit && hit->normal.z() >= least ? std::optional(hit->point.z()) : std::nullopt;
}

bool Avatar::stand(const Vector3d& p, double reach_m) {
  const auto floor = floorUnder(p, reach_m);
  if (!floor) return false;
  const Vector3d feet(p.x(), p.y(), *floor);
  if (obstacles_->overlap(upper(), feet + kStepUp, 1e-3)) return false;
  feet_ = feet;
  return true;
}

// The feet go to the floor there, unless it is too deep, too high or too low above it.
bool Avatar::moveTo(const Vector3d& place) {
  const auto floor = floorUnder(place, kStepHeight);
  if (!floor) return false;
  const Vector3d feet(place.x(), place.y(), *floor);
  if (obstacles_->sweep(upper(), place + kStepUp, feet + kStepUp)) return false;
  feet_ = feet;
  return true;
}

void Avatar::stride(Vector2d way_m) {
  for (int i = 0; i < kMostSlides && way_m.norm() > 1e-6; ++i) {
    const Vector3d from = feet_ + kStepUp, way(way_m.x(), way_m.y(), 0);
    const auto hit = obstacles_->sweep(upper(), from, from + way);
    const double fraction = hit ? hit->fraction : 1;
    if (fraction > 0 && !moveTo(feet_ + fraction * way)) {
      const Vector3d over = way + kCrack * way.normalized();
      if (!hit && !obstacles_->sweep(upper(), from, from + over)) moveTo(feet_ + over);
      return;
    }
    if (!hit) return;
    const Vector2d across = hit->normal.head<2>();
    if (across.norm() < 1e-3) return;
    way_m *= 1 - fraction;
    way_m -= across.normalized() * std::min(0.0, way_m.dot(across.normalized()));
  }
}

void Avatar::walk(const Vector2d& way_m) {
  const double length = way_m.norm();
  if (!std::isfinite(length)) return;
  const int strides = static_cast<int>(std::ceil(std::min(length, 100.0) / kStride));
  for (int i = 0; i < strides; ++i) stride(way_m / strides);
}

}  // namespace standpoint
