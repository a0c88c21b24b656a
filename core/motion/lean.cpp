// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/lean.h"

#include <algorithm>
#include <cmath>

#include "core/motion/rotation_vector.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;

constexpr double kLeanKnot_s = 0.05;
constexpr double kGravity_mps2 = 9.81;

// In the body's frame.
Vector3d accelerationAt(const PoseFunction& path, double time_s) {
  const Pose here = path.pose(time_s);
  const Vector3d change =
      path.pose(time_s + kLeanKnot_s).translation - 2 * here.translation + path.pose(time_s - kLeanKnot_s).translation;
  return here.rotation.conjugate() * change / (kLeanKnot_s * kLeanKnot_s);
}

double angleOf(double across, double along) { return kRadPerTurn * portable::turnOf(across, along); }

// The mean over a window; what is before the first and after the last is 0.
void smooth(std::vector<SplineKnot<2>>& knots, std::size_t reach) {
  std::vector<std::array<double, 2>> sum(knots.size() + 1);
  for (std::size_t i = 0; i < knots.size(); ++i)
    for (std::size_t k = 0; k < 2; ++k) sum[i + 1][k] = sum[i][k] + knots[i].value[k];
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const std::size_t from = i < reach ? 0 : i - reach, to = std::min(knots.size(), i + reach + 1);
    for (std::size_t k = 0; k < 2; ++k)
      knots[i].value[k] = (sum[to][k] - sum[from][k]) / (2.0 * static_cast<double>(reach) + 1);
  }
}

}  // namespace

LeaningPose::LeaningPose(PoseFunctionPtr path, const Lean& lean)
    : path_(std::move(path)), axis_below_m_(lean.axis_below_m) {
  const double first = path_->first_s(), last = path_->last_s();
  if (lean.most_rad <= 0 || !std::isfinite(first) || !std::isfinite(last) || last <= first) return;
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil((last - first) / kLeanKnot_s)));
  for (std::size_t i = 0; i <= count; ++i) {
    const double time_s = first + (last - first) * static_cast<double>(i) / static_cast<double>(count);
    const Vector3d a = accelerationAt(*path_, time_s);
    const double up = kGravity_mps2 + a.z();
    const double roll = -lean.roll * angleOf(a.y(), std::sqrt(up * up + a.x() * a.x()));
    const double pitch = lean.pitch * angleOf(a.x(), up);
    knots_.push_back(
        {time_s,
         {std::clamp(roll, -lean.most_rad, lean.most_rad), std::clamp(pitch, -lean.most_rad, lean.most_rad)},
         {}});
  }
  // Twice half the window: the lean begins and ends gently.
  const auto reach = static_cast<std::size_t>(lean.response_s / (4 * kLeanKnot_s));
  smooth(knots_, reach);
  smooth(knots_, reach);
  fillSlopes<2>(knots_);
}

Pose LeaningPose::pose(double time_s) const {
  const Pose upright = path_->pose(time_s);
  if (knots_.empty()) return upright;
  const double time = std::clamp(time_s, first_s(), last_s());
  const std::size_t i = pieceAt<2>(knots_, 0, knots_.size() - 1, time);
  const auto [roll, pitch] = between(knots_[i], knots_[i + 1], time);
  const Eigen::Quaterniond leant = rotationOf({roll, pitch, 0});
  const Vector3d lever(0, 0, axis_below_m_);
  Pose pose = upright * Pose{leant, leant * lever - lever};
  pose.rotation = unitRotation(pose.rotation);
  return pose;
}

}  // namespace standpoint
