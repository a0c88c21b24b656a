// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "editor/words/words.h"

namespace standpoint {

namespace {

constexpr double kSpeed = 1.8, kFast = 4, kCrouching = 0.9;  // m/s
constexpr double kSlowest = 0.25, kFastest = 4, kSpeedStep = 1.25;
constexpr double kViewAngle_rad = 60 * std::numbers::pi / 180;  // vertical
constexpr double kLookAhead_m = 1;                              // the camera's target is this far before the eyes

}  // namespace

bool Walk::start(std::shared_ptr<const WalkedGround> ground, const Body& body, const StartPlace& place,
                 Camera& camera) {
  Walker walker(ground->obstacles, body, ground->lowest_m);
  if (!walker.stand(place.feet + Eigen::Vector3d(0, 0, 0.05), 0.5)) return false;
  if (!walker_) view_angle_before_rad_ = camera.view_angle_rad;
  walker_ = walker;
  ground_ = std::move(ground);
  body_ = body;
  camera.orthographic = false;
  camera.view_angle_rad = kViewAngle_rad;
  camera.elevation_rad = 0;
  if (place.facing) camera.azimuth_rad = std::atan2(-place.facing->x(), place.facing->y());
  lookFromEyes(camera);
  return true;
}

void Walk::stop(Camera& camera) {
  if (!walker_) return;
  camera.view_angle_rad = view_angle_before_rad_;
  walker_.reset();
  ground_.reset();
}

double Walk::speed_mps(bool fast) const { return (fast ? kFast : kSpeed) * factor_; }

void Walk::changeSpeed(double steps) {
  factor_ = std::clamp(factor_ * std::pow(kSpeedStep, steps), kSlowest, kFastest);
}

void Walk::go(const WalkKeys& keys, double seconds, Camera& camera) {
  if (!walker_) return;
  const Eigen::Vector2d right(std::cos(camera.azimuth_rad), std::sin(camera.azimuth_rad)), ahead(-right.y(), right.x());
  WalkWish wish{Eigen::Vector2d::Zero(), keys.crouch};
  if (!keys.way.isZero()) {
    const double speed = keys.crouch ? kCrouching * factor_ : speed_mps(keys.fast);
    wish.velocity = (right * keys.way.x() + ahead * keys.way.y()).normalized() * speed;
  }
  walker_->go(wish, seconds);
  lookFromEyes(camera);
}

std::string Walk::note() const {
  if (walker_->wasBroughtBack()) return tr("Fell; returned to the last floor");
  if (const auto& headroom = walker_->headroom())
    return trf("headroom {:.2f} m, body {:.2f} m", *headroom, body_.height_m);
  return {};
}

void Walk::lookFromEyes(Camera& camera) const {
  camera.distance_m = kLookAhead_m;
  camera.target = walker_->eyes() + camera.forward() * kLookAhead_m;
}

}  // namespace standpoint
