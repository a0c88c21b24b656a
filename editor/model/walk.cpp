// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/model/walk.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace standpoint {

namespace {

constexpr double kEyes = 0.92;             // of the height
constexpr double kSpeed = 1.4, kFast = 4;  // m/s
constexpr double kLongestFrame_s = 0.2;    // a picture that took longer does not make one run
constexpr double kLookAhead_m = 1;         // the camera's target is this far before the eyes
constexpr std::size_t kMostTries = 200;

}  // namespace

bool Walk::start(std::shared_ptr<const CollideResult> collision, const Body& body, const Eigen::Vector3d& place,
                 Camera& camera) {
  stop();
  struct Start {
    double distance;
    Eigen::Vector3d at;
  };
  std::vector<Start> starts;
  const auto& mesh = collision->walkable;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d at = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]).cast<double>() / 3;
    starts.push_back({(at - place).squaredNorm(), at});
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.distance < b.distance; });
  auto obstacles = std::make_unique<Obstacles>(collision->shapes);
  Avatar avatar(*obstacles, body);
  for (std::size_t i = 0; i < std::min(starts.size(), kMostTries); ++i) {
    if (!avatar.stand(starts[i].at, 0.5)) continue;
    collision_ = std::move(collision);
    obstacles_ = std::move(obstacles);
    avatar_ = avatar;
    body_ = body;
    camera.orthographic = false;
    camera.elevation_rad = 0;
    lookFromEyes(camera);
    return true;
  }
  return false;
}

void Walk::stop() {
  avatar_.reset();
  obstacles_.reset();
  collision_.reset();
}

void Walk::go(const Eigen::Vector2d& keys, bool fast, double seconds, Camera& camera) {
  if (!avatar_ || keys.isZero()) return;
  const Eigen::Vector2d right(std::cos(camera.azimuth_rad), std::sin(camera.azimuth_rad)), ahead(-right.y(), right.x());
  const Eigen::Vector2d way = (right * keys.x() + ahead * keys.y()).normalized();
  avatar_->walk(way * ((fast ? kFast : kSpeed) * std::clamp(seconds, 0.0, kLongestFrame_s)));
  lookFromEyes(camera);
}

void Walk::lookFromEyes(Camera& camera) const {
  camera.distance_m = kLookAhead_m;
  camera.target = avatar_->feet() + Eigen::Vector3d(0, 0, kEyes * body_.height_m) + camera.forward() * kLookAhead_m;
}

}  // namespace standpoint
