// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/fly.h"

#include <algorithm>
#include <cmath>

#include "editor/model/model.h"

namespace standpoint {

namespace {

constexpr double kFlySpeed = 3, kFlyFast = 12;  // m/s
constexpr double kSlowestFly = 0.1, kFastestFly = 10, kFlySpeedStep = 1.25;
constexpr double kFlySpeedUp = 0.1;       // s from standing to full speed, and back
constexpr double kLongestFlyFrame = 0.2;  // s
constexpr double kFlyTarget_m = 1;        // the camera's target is this far before the eye

}  // namespace

void Fly::begin(Camera& camera) {
  const Eigen::Vector3d eye = camera.eye();
  view_angle_before_rad_ = camera.view_angle_rad;
  camera.orthographic = false;
  camera.view_angle_rad = Walk::kUsualViewAngle_rad;
  camera.distance_m = kFlyTarget_m;
  camera.target = eye + camera.forward() * kFlyTarget_m;
  velocity_.setZero();
}

void Fly::end(Camera& camera) { camera.view_angle_rad = view_angle_before_rad_; }

double Fly::speed_mps(bool fast) const { return (fast ? kFlyFast : kFlySpeed) * factor_; }

void Fly::changeSpeed(double steps) {
  factor_ = std::clamp(factor_ * std::pow(kFlySpeedStep, steps), kSlowestFly, kFastestFly);
}

void Fly::go(const FlyKeys& keys, double seconds, Camera& camera) {
  const double time = std::clamp(seconds, 0.0, kLongestFlyFrame);
  Eigen::Vector3d wish = Eigen::Vector3d::Zero();
  if (!keys.way.isZero())
    wish = (camera.right() * keys.way.x() + camera.forward() * keys.way.y() + Eigen::Vector3d::UnitZ() * keys.way.z())
               .normalized() *
           speed_mps(keys.fast);
  const Eigen::Vector3d change = wish - velocity_;
  const double most = std::max(speed_mps(keys.fast), velocity_.norm()) / kFlySpeedUp * time;
  velocity_ = change.norm() <= most ? wish : Eigen::Vector3d(velocity_ + change.normalized() * most);
  camera.target += velocity_ * time;
}

void startFlying(Model& model) {
  if (model.view.tool == Tool::fly) return;
  model.views.push({model.view.camera, model.walk.active() ? std::optional(model.walk.feet()) : std::nullopt,
                    model.visibility.cut_height_m});
  stopWalking(model);
  model.fly.begin(model.view.camera);
  model.view.tool = Tool::fly;
}

void stopFlying(Model& model) {
  if (model.view.tool != Tool::fly) return;
  model.fly.end(model.view.camera);
  model.view.tool = Tool::select;
}

}  // namespace standpoint
