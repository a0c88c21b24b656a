// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/pose_window.h"

#include <algorithm>
#include <cmath>

#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

// Four poses that follow each other. Places are from the second: large coordinates lose nothing.
struct FourPoses {
  double shift[4][3], turn[4][4], second[3];

  explicit FourPoses(const Pose* poses) {
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < 3; ++i) shift[k][i] = poses[k].translation[i] - poses[1].translation[i];
      for (int i = 0; i < 4; ++i) turn[k][i] = poses[k].rotation.coeffs()[i];
    }
    for (int i = 0; i < 3; ++i) second[i] = poses[1].translation[i];
  }

  // Lagrange's cubic through them, `u` of a step after the second.
  STANDPOINT_INLINE void at(double u, double* place, double* quaternion) const {
    const double w[4] = {-u * (u - 1) * (u - 2) / 6, (u + 1) * (u - 1) * (u - 2) / 2, -(u + 1) * u * (u - 2) / 2,
                         (u + 1) * u * (u - 1) / 6};
    for (int i = 0; i < 3; ++i)
      place[i] = second[i] + (w[0] * shift[0][i] + w[1] * shift[1][i] + w[2] * shift[2][i] + w[3] * shift[3][i]);
    for (int i = 0; i < 4; ++i)
      quaternion[i] = w[0] * turn[0][i] + w[1] * turn[1][i] + w[2] * turn[2][i] + w[3] * turn[3][i];
    const double length = std::sqrt((quaternion[0] * quaternion[0] + quaternion[2] * quaternion[2]) +
                                    (quaternion[1] * quaternion[1] + quaternion[3] * quaternion[3]));
    for (int i = 0; i < 4; ++i) quaternion[i] /= length;
  }
};

STANDPOINT_INLINE double stepOf(double place, double last) { return std::clamp(std::floor(place), 0.0, last); }

STANDPOINT_CLONES void stepsOf(const double* times_s, double from_s, double per_step, double last, double* steps,
                               double* after) {
  for (int k = 0; k < kPacket; ++k) {
    const double place = (times_s[k] - from_s) * per_step;
    steps[k] = stepOf(place, last), after[k] = place - steps[k];
  }
}

STANDPOINT_CLONES void between(const FourPoses& four, const double* after, const std::uint64_t* in, PoseLanes& poses) {
  VectorLanes& to = poses.translation;
  for (int k = 0; k < kPacket; ++k) {
    double place[3], quaternion[4];
    four.at(after[k], place, quaternion);
    to.x[k] = in[k] != 0 ? place[0] : to.x[k];
    to.y[k] = in[k] != 0 ? place[1] : to.y[k];
    to.z[k] = in[k] != 0 ? place[2] : to.z[k];
    poses.qx[k] = in[k] != 0 ? quaternion[0] : poses.qx[k];
    poses.qy[k] = in[k] != 0 ? quaternion[1] : poses.qy[k];
    poses.qz[k] = in[k] != 0 ? quaternion[2] : poses.qz[k];
    poses.qw[k] = in[k] != 0 ? quaternion[3] : poses.qw[k];
  }
}

}  // namespace

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

double PoseWindow::lastStep() const { return static_cast<double>(poses_.size() - 4); }

Pose PoseWindow::at(double time_s) const {
  const double place = (time_s - from_s_) * per_step_, step = stepOf(place, lastStep());
  Pose pose;
  FourPoses(poses_.data() + static_cast<std::size_t>(step))
      .at(place - step, pose.translation.data(), pose.rotation.coeffs().data());
  return pose;
}

void PoseWindow::at(const double* times_s, std::uint32_t lanes, PoseLanes& poses) const {
  double steps[kPacket], after[kPacket];
  stepsOf(times_s, from_s_, per_step_, lastStep(), steps, after);
  while (lanes != 0) {
    const double step = steps[std::countr_zero(lanes)];
    std::uint64_t in[kPacket] = {};
    forLanes(lanes, [&](std::uint32_t k) {
      if (steps[k] == step) in[k] = 1, lanes &= ~(1U << k);
    });
    between(FourPoses(poses_.data() + static_cast<std::size_t>(step)), after, in, poses);
  }
}

}  // namespace standpoint
