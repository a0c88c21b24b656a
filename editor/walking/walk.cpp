// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/walking/walk.h"

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
constexpr double kLookAhead_m = 1;  // the camera's target is this far before the eyes

Eigen::Vector2d aheadOf(const Camera& camera) { return {-std::sin(camera.azimuth_rad), std::cos(camera.azimuth_rad)}; }

// On a narrow spiral stair a body meets railing and newel where the surface leads on past them: it takes the step to
// where it has room, at the corner or a little beside it, and never through what somebody slim would not come past.
void stepTo(const Obstacles& obstacles, Walker& walker, const Eigen::Vector3d& corner) {
  constexpr double kStep_m = 0.45, kStandFrom_m = 0.1, kBeside_m = 0.05, kOverTreads_m = 0.3;
  constexpr Body kSlim{0.05, 0.9};
  constexpr int kRings = 4, kAround = 12;
  const Eigen::Vector3d feet = walker.feet();
  if ((corner - feet).norm() > kStep_m) return;
  const double z = std::max(feet.z(), corner.z()) + kOverTreads_m;
  for (int ring = 0; ring < kRings; ++ring)
    for (int i = 0; i < (ring == 0 ? 1 : kAround); ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      const Eigen::Vector3d place = corner + ring * kBeside_m * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      if (obstacles.sweep(kSlim, {feet.x(), feet.y(), z}, {place.x(), place.y(), z})) continue;
      if (walker.stand(place + Eigen::Vector3d(0, 0, kStandFrom_m), 2 * kStandFrom_m)) return;
    }
}

}  // namespace

bool Walk::start(std::shared_ptr<const WalkedGround> ground, const Body& body, const StartPlace& place,
                 Camera& camera) {
  const Body own{body.radius_m, chosen_eyes_m_ ? *chosen_eyes_m_ + Walker::kCrownAboveEyes_m : body.height_m};
  Walker walker(ground->obstacles, own, ground->lowest_m);
  if (!walker.stand(place.feet + Eigen::Vector3d(0, 0, 0.05), 0.5)) return false;
  if (!walker_) view_angle_before_rad_ = camera.view_angle_rad;
  walker_ = walker;
  if (ground_ != ground || !doors_) doors_ = std::make_unique<SwingingDoors>(ground->doors);
  ground_ = std::move(ground);
  way_.reset();
  held_up_ = false;
  body_ = own;
  camera.orthographic = false;
  camera.view_angle_rad = view_angle_rad_;
  camera.elevation_rad = 0;
  if (place.facing) camera.azimuth_rad = std::atan2(-place.facing->x(), place.facing->y());
  lookFromEyes(camera);
  return true;
}

void Walk::stop(Camera& camera) {
  if (!walker_) return;
  camera.view_angle_rad = view_angle_before_rad_;
  walker_.reset();
  way_.reset();
  doors_.reset();
  ground_.reset();
}

void Walk::setUprightEyes(double height_m) {
  chosen_eyes_m_ = std::clamp(height_m, kLowestEyes_m, kHighestEyes_m);
  body_.height_m = *chosen_eyes_m_ + Walker::kCrownAboveEyes_m;
  if (walker_) walker_->setHeight(body_.height_m);
}

double Walk::viewAngle_deg() const { return view_angle_rad_ / kRadPerDeg; }

void Walk::setViewAngle(double angle_deg, Camera& camera) {
  view_angle_rad_ = std::clamp(angle_deg, kNarrowestView_deg, kWidestView_deg) * kRadPerDeg;
  if (walker_) camera.view_angle_rad = view_angle_rad_;
}

bool Walk::toggleDoor(const Camera& camera) { return walker_ && doors_->toggle(feet(), aheadOf(camera)); }

bool Walk::doorInReach(const Camera& camera) const { return walker_ && doors_->anyInReach(feet(), aheadOf(camera)); }

double Walk::speed_mps(bool fast) const { return (fast ? kFast : kSpeed) * factor_; }

void Walk::changeSpeed(double steps) {
  factor_ = std::clamp(factor_ * std::pow(kSpeedStep, steps), kSlowest, kFastest);
}

void Walk::go(const WalkKeys& keys, double seconds, Camera& camera) {
  if (!walker_) return;
  clock_s_ += seconds;
  if (!keys.way.isZero() || keys.crouch) {
    way_.reset();
    held_up_ = false;
  }
  if (way_) return follow(seconds, camera);
  const Eigen::Vector2d right(std::cos(camera.azimuth_rad), std::sin(camera.azimuth_rad)), ahead(-right.y(), right.x());
  WalkWish wish{Eigen::Vector2d::Zero(), keys.crouch};
  if (!keys.way.isZero()) {
    const double speed = keys.crouch ? kCrouching * factor_ : speed_mps(keys.fast);
    wish.velocity = (right * keys.way.x() + ahead * keys.way.y()).normalized() * speed;
  }
  move(wish, seconds);
  lookFromEyes(camera);
}

void Walk::move(const WalkWish& wish, double seconds) {
  doors_->follow(feet(), wish.velocity.normalized(), seconds);
  tripods_in_way_.follow(tripods_, feet(), body_);
  walker_->alsoMeet(doors_->shut(), tripods_in_way_.obstacles());
  walker_->go(wish, seconds);
}

void Walk::follow(double seconds, Camera& camera) {
  constexpr double kTurn_s = 0.2;  // for most of a turn of the head
  for (double left = seconds; way_ && left > 0; left -= WayWalk::kLongestStep_s) {
    const double step = std::min(left, WayWalk::kLongestStep_s);
    const auto velocity = way_->velocity(feet(), step);
    if (!velocity) {
      held_up_ = !way_->arrived();
      way_.reset();
      break;
    }
    if (const auto corner = way_->heldUpBefore()) stepTo(ground_->obstacles, *walker_, *corner);
    const double off =
        std::remainder(std::atan2(-velocity->x(), velocity->y()) - camera.azimuth_rad, 2 * std::numbers::pi);
    camera.azimuth_rad = std::remainder(camera.azimuth_rad + off * std::min(1.0, step / kTurn_s), 2 * std::numbers::pi);
    move({*velocity, false}, step);
  }
  lookFromEyes(camera);
}

std::string Walk::note() const {
  if (walker_->wasBroughtBack()) return tr("Fell; returned to the last floor");
  if (const auto& headroom = walker_->headroom())
    return trf("headroom {:.2f} m, body {:.2f} m", *headroom, body_.height_m);
  if (held_up_) return tr("Stopped: something is in the way");
  return {};
}

void Walk::lookFromEyes(Camera& camera) const {
  camera.distance_m = kLookAhead_m;
  camera.target = walker_->eyes() + camera.forward() * kLookAhead_m;
}

}  // namespace standpoint
