// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/walk_record.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kLeastStep_m = 0.02, kJump_m = 1.5;
constexpr double kStray_m = 0.05;  // of straight legs from what was walked
constexpr double kStop_s = 1, kSameWaypoint_m = 0.1;

double fromLeg(const Vector3d& p, const Vector3d& from, const Vector3d& to) {
  const Vector3d leg = to - from;
  const double length = leg.squaredNorm();
  const double along = length > 0 ? std::clamp((p - from).dot(leg) / length, 0.0, 1.0) : 0;
  return (p - from - along * leg).norm();
}

}  // namespace

void WalkRecord::begin() {
  samples_.clear();
  active_ = true;
}

bool WalkRecord::follow(double now_s, const Vector3d& feet) {
  if (samples_.empty()) {
    samples_.push_back({now_s, now_s, feet});
    return true;
  }
  Sample& last = samples_.back();
  const double moved = (feet - last.feet).norm();
  if (moved > kJump_m) {
    active_ = false;
    return false;
  }
  if (moved < kLeastStep_m)
    last.until_s = now_s;
  else
    samples_.push_back({now_s, now_s, feet});
  return true;
}

double WalkRecord::seconds() const { return samples_.empty() ? 0 : samples_.back().until_s - samples_.front().from_s; }

double WalkRecord::length_m() const {
  double length = 0;
  for (std::size_t i = 1; i < samples_.size(); ++i) length += (samples_[i].feet - samples_[i - 1].feet).norm();
  return length;
}

double WalkRecord::speed_mps() const {
  double walked_s = seconds();
  for (const Sample& sample : samples_)
    if (sample.until_s - sample.from_s >= kStop_s) walked_s -= sample.until_s - sample.from_s;
  return walked_s > 0 ? length_m() / walked_s : 0;
}

// Douglas and Peucker's way, without recursion.
void WalkRecord::keepBetween(std::size_t from, std::size_t to, std::vector<bool>& kept) const {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{from, to}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    std::size_t farthest = a;
    double most = kStray_m;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double off = fromLeg(samples_[i].feet, samples_[a].feet, samples_[b].feet);
      if (off > most) most = off, farthest = i;
    }
    if (farthest == a) continue;
    kept[farthest] = true;
    open.push_back({a, farthest});
    open.push_back({farthest, b});
  }
}

std::vector<Waypoint> WalkRecord::waypoints() const {
  if (samples_.size() < 2) return {};
  std::vector<bool> kept(samples_.size());
  kept.front() = kept.back() = true;
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (samples_[i].until_s - samples_[i].from_s >= kStop_s) kept[i] = true;
  for (std::size_t from = 0, to = 1; to < samples_.size(); ++to)
    if (kept[to]) keepBetween(from, to, kept), from = to;
  std::vector<Waypoint> waypoints;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const double stood_s = samples_[i].until_s - samples_[i].from_s;
    const bool near = !waypoints.empty() && (samples_[i].feet - waypoints.back().floor_m).norm() < kSameWaypoint_m;
    if (!kept[i] || (near && stood_s < kStop_s)) continue;
    if (near) waypoints.pop_back();
    waypoints.push_back({samples_[i].feet, stood_s >= kStop_s ? std::round(10 * stood_s) / 10 : 0, {}});
  }
  return waypoints;
}

}  // namespace standpoint
