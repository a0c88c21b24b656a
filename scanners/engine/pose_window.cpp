// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/pose_window.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

void PoseWindow::sample(const PoseFunction& function, const Pose& body_from_device, double from_s, double to_s) {
  constexpr double kStep_s = 1e-3;
  const auto steps = static_cast<int>(std::max(1.0, std::ceil((to_s - from_s) / kStep_s)));
  const double step_s = std::max(to_s - from_s, 1e-6) / steps;
  from_s_ = from_s, per_step_ = 1 / step_s;
  poses_.clear();
  for (int k = -1; k <= steps + 1; ++k) {
    Pose& pose = poses_.emplace_back(function.pose(from_s + k * step_s) * body_from_device);
    if (k >= 0 && pose.rotation.coeffs().dot(poses_[poses_.size() - 2].rotation.coeffs()) < 0)
      pose.rotation.coeffs() = -pose.rotation.coeffs();
  }
}

// Lagrange's cubic through two samples on each side.
Pose PoseWindow::at(double time_s) const {
  const double place = (time_s - from_s_) * per_step_;
  const auto last = static_cast<double>(poses_.size() - 4);
  const double step = std::clamp(std::floor(place), 0.0, last);
  const double u = place - step;
  const Pose* const p = poses_.data() + static_cast<std::size_t>(step);
  const double w[4] = {-u * (u - 1) * (u - 2) / 6, (u + 1) * (u - 1) * (u - 2) / 2, -(u + 1) * u * (u - 2) / 2,
                       (u + 1) * u * (u - 1) / 6};
  Pose pose;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();  // from the second: large coordinates lose nothing
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  for (int k = 0; k < 4; ++k) {
    shift += w[k] * (p[k].translation - p[1].translation);
    turn += w[k] * p[k].rotation.coeffs();
  }
  pose.translation = p[1].translation + shift;
  pose.rotation.coeffs() = turn / std::sqrt(turn.squaredNorm());
  return pose;
}

}  // namespace standpoint
