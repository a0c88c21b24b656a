// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/film/camera_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standpoint {

namespace {

using std::numbers::pi;
constexpr double kPace_mps = 1.1;
constexpr double kTurn_radps = 1.4, kTurnEagerness = 3;  // per second of the angle that is left
constexpr double kAhead_m = 1.2;                         // what one looks at on the way
constexpr double kStands_rad = 0.9;                      // who looks so far from his way stands still
constexpr double kRound_m = 0.3, kEvery_m = 0.05;
constexpr double kMoment_s = 1.0 / 60;
constexpr double kViewAngle_rad = 60 * pi / 180;
constexpr int kTurntableTries = 72;

// Places at equal distances along the way.
std::vector<Eigen::Vector3d> evenly(const std::vector<Eigen::Vector3d>& way) {
  std::vector<Eigen::Vector3d> result;
  double next = 0, done = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Eigen::Vector3d leg = way[i] - way[i - 1];
    const double length = leg.norm();
    for (; next <= done + length && length > 0; next += kEvery_m)
      result.push_back(way[i - 1] + leg * ((next - done) / length));
    done += length;
  }
  if (!way.empty()) result.push_back(way.back());
  return result;
}

// Means over what is near on both sides; the ends stay.
std::vector<Eigen::Vector3d> rounded(const std::vector<Eigen::Vector3d>& way) {
  const auto most = static_cast<std::ptrdiff_t>(std::lround(kRound_m / kEvery_m));
  const auto count = static_cast<std::ptrdiff_t>(way.size());
  std::vector<Eigen::Vector3d> result(way.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto reach = std::min({most, i, count - 1 - i});
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (auto k = i - reach; k <= i + reach; ++k) sum += way[static_cast<std::size_t>(k)];
    result[static_cast<std::size_t>(i)] = sum / static_cast<double>(2 * reach + 1);
  }
  return result;
}

double azimuthOf(const Eigen::Vector3d& direction) { return std::atan2(-direction.x(), direction.y()); }

// Near the end there is nothing ahead: as before.
double lookedAt(const std::vector<Eigen::Vector3d>& way, std::size_t at, double before_rad) {
  const auto ahead = std::min(way.size() - 1, at + static_cast<std::size_t>(kAhead_m / kEvery_m));
  const Eigen::Vector3d seen = way[ahead] - way[at];
  return seen.head<2>().norm() < 0.3 ? before_rad : azimuthOf(seen);
}

}  // namespace

Camera turntableAt(const Camera& from, const Bounds& around, double aspect, double share) {
  Camera camera = from;
  double farthest_m = 0;
  for (int i = 0; i < kTurntableTries; ++i) {
    camera.azimuth_rad = from.azimuth_rad + 2 * pi * i / kTurntableTries;
    frame(camera, around, aspect);
    farthest_m = std::max(farthest_m, camera.distance_m);
  }
  camera.azimuth_rad = from.azimuth_rad + 2 * pi * share;
  camera.distance_m = farthest_m;
  return camera;
}

WalkThrough::WalkThrough(const std::vector<Eigen::Vector3d>& way) {
  const auto even = rounded(evenly(way));
  if (even.size() < 2) return;
  length_m_ = kEvery_m * static_cast<double>(even.size() - 1);
  double azimuth = lookedAt(even, 0, 0), along_m = 0;
  const auto eyeAt = [&](double metres) {
    const double steps = std::min(metres / kEvery_m, static_cast<double>(even.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(steps), even.size() - 2);
    return Eigen::Vector3d(even[i] + (even[i + 1] - even[i]) * (steps - static_cast<double>(i)) +
                           Eigen::Vector3d(0, 0, kEye_m));
  };
  while (along_m < length_m_) {
    moments_.push_back({eyeAt(along_m), azimuth});
    const auto at = std::min(static_cast<std::size_t>(along_m / kEvery_m), even.size() - 1);
    const double left = std::remainder(lookedAt(even, at, azimuth) - azimuth, 2 * pi);
    azimuth += std::clamp(left * kTurnEagerness, -kTurn_radps, kTurn_radps) * kMoment_s;
    along_m += kPace_mps * std::max(0.0, 1 - std::abs(left) / kStands_rad) * kMoment_s;
  }
  moments_.push_back({eyeAt(length_m_), azimuth});
}

double WalkThrough::seconds() const { return static_cast<double>(moments_.size()) * kMoment_s; }

Camera WalkThrough::at(double share) const {
  Camera camera;
  camera.view_angle_rad = kViewAngle_rad;
  camera.elevation_rad = 0;
  camera.distance_m = 1;
  if (moments_.empty()) return camera;
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(moments_.size() - 1);
  const auto i = static_cast<std::size_t>(place), next = std::min(i + 1, moments_.size() - 1);
  const double rest = place - static_cast<double>(i);
  camera.azimuth_rad = std::lerp(moments_[i].azimuth_rad, moments_[next].azimuth_rad, rest);
  const Eigen::Vector3d eye = moments_[i].eye + (moments_[next].eye - moments_[i].eye) * rest;
  camera.target = eye + camera.forward();
  return camera;
}

}  // namespace standpoint
