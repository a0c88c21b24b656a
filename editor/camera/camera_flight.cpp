// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/camera/camera_flight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

double turnFrom(double from_rad, double to_rad) { return std::remainder(to_rad - from_rad, 2 * std::numbers::pi); }

// A step that one has to find one's way after.
bool isFar(const Camera& from, const Camera& to) {
  constexpr double kTurn_rad = 0.2, kShare = 0.3, kFactor = 1.3;
  const double ratio = to.distance_m / from.distance_m;
  return std::abs(turnFrom(from.azimuth_rad, to.azimuth_rad)) > kTurn_rad ||
         std::abs(to.elevation_rad - from.elevation_rad) > kTurn_rad || ratio > kFactor || ratio < 1 / kFactor ||
         (to.target - from.target).norm() > kShare * std::min(from.distance_m, to.distance_m);
}

}  // namespace

Camera between(const Camera& from, const Camera& to, double fraction) {
  Camera camera = to;
  camera.orthographic = from.orthographic && to.orthographic;
  camera.target = from.target + fraction * (to.target - from.target);
  camera.distance_m = from.distance_m * std::pow(to.distance_m / from.distance_m, fraction);
  camera.azimuth_rad = from.azimuth_rad + fraction * turnFrom(from.azimuth_rad, to.azimuth_rad);
  camera.elevation_rad = std::lerp(from.elevation_rad, to.elevation_rad, fraction);
  camera.view_angle_rad = std::lerp(from.view_angle_rad, to.view_angle_rad, fraction);
  return camera;
}

void CameraFlight::step(Camera& camera, double seconds) {
  if (last_ && !(camera == *last_)) {
    flight_.reset();
    if (seconds_ > 0 && isFar(*last_, camera)) flight_ = Flight{*last_, camera, 0};
  }
  if (flight_) {
    flight_->gone_s += seconds;
    const double share = flight_->gone_s / seconds_;
    camera = share < 1 ? between(flight_->from, flight_->to, share * share * (3 - 2 * share)) : flight_->to;
    if (share >= 1) flight_.reset();
  }
  last_ = camera;
}

void CameraFlight::settle(const Camera& camera) {
  if (last_ && camera == *last_) return;
  flight_.reset();
  last_ = camera;
}

}  // namespace standpoint
