// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/trajectories/walked_poses.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/motion/gait.h"
#include "core/motion/pose_spline.h"
#include "core/random.h"
#include "survey/trajectories/carried_motion.h"

namespace standpoint {

namespace {

using Eigen::Vector3d;
using Knot = SplineKnot<8>;

constexpr double kSmoothed_s = 0.1;  // of a walk's poses to either side, and between the knots that are kept of it
constexpr int kSmoothingSteps = 4;
constexpr double kWalkSampled_hz = 200;

// In place, heading along x: ahead, left, up.
const Vector3d kHandFromEyes_m(0.2, 0, -0.3), kBodyFromEyes_m(-0.1, 0, 0.3);

void setSlope(const Knot& before, Knot& knot, const Knot& after) {
  const double a = knot.at - before.at, b = after.at - knot.at;
  for (std::size_t k = 0; k < knot.value.size(); ++k)
    knot.slope[k] = (b * (knot.value[k] - before.value[k]) / a + a * (after.value[k] - knot.value[k]) / b) / (a + b);
}

void setSlopeAtEnd(const Knot& other, Knot& end) {
  for (std::size_t k = 0; k < end.value.size(); ++k)
    end.slope[k] = (end.value[k] - other.value[k]) / (end.at - other.at);
}

Eigen::Quaterniond quaternionOf(const std::array<double, 8>& v) {
  return Eigen::Quaterniond(v[3], v[4], v[5], v[6]).normalized();
}

// The mean of what is near, weighted less the farther away it is.
Pose smoothed(const WalkedPoses& poses, double time_s) {
  Vector3d place = Vector3d::Zero();
  Eigen::Vector4d turn = Eigen::Vector4d::Zero();
  const Eigen::Quaterniond middle = poses.pose(time_s).rotation;
  double weights = 0;
  for (int k = -kSmoothingSteps; k <= kSmoothingSteps; ++k) {
    const double weight = 1 - std::abs(k) / (kSmoothingSteps + 1.0);
    const Pose near = poses.pose(time_s + k * kSmoothed_s / kSmoothingSteps);
    const double side = near.rotation.dot(middle) < 0 ? -1 : 1;
    place += weight * near.translation;
    turn += weight * side * near.rotation.coeffs();
    weights += weight;
  }
  Pose pose;
  pose.translation = place / weights;
  pose.rotation.coeffs() = turn.normalized();
  return pose;
}

}  // namespace

Pose scannerOf(const Camera& camera, const std::string& mount) {
  const Vector3d ahead = camera.forward(), up = camera.up();
  Eigen::Matrix3d axes;
  axes << ahead, up.cross(ahead), up;
  const Vector3d right = camera.right();  // level, whatever the tilt
  const Vector3d& from_eyes = mount == "body" ? kBodyFromEyes_m : kHandFromEyes_m;
  const Vector3d lever = from_eyes.x() * Vector3d(-right.y(), right.x(), 0) + Vector3d(0, 0, from_eyes.z());
  return {Eigen::Quaterniond(axes).normalized(), camera.eye() + lever};
}

const Carrier* carrierOnFoot(const std::string& mount) {
  if (mount != "hand" && mount != "body" && mount != "any") return nullptr;
  return carrierOf(mount == "body" ? "backpack" : "hand");
}

void WalkedPoses::add(const WalkMoment& moment) {
  if (!knots_.empty() && !(moment.time_s > knots_.back().at)) return;
  const Vector3d& p = moment.local_from_scanner.translation;
  Eigen::Quaterniond q = moment.local_from_scanner.rotation;
  if (!knots_.empty() && q.dot(quaternionOf(knots_.back().value)) < 0) q.coeffs() = -q.coeffs();
  knots_.push_back({moment.time_s, {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z(), moment.feet.z()}, {}});
  const std::size_t last = knots_.size() - 1;
  if (last == 0) return;
  setSlopeAtEnd(knots_[last - 1], knots_[last]);
  if (last == 1)
    knots_[0].slope = knots_[1].slope;
  else
    setSlope(knots_[last - 2], knots_[last - 1], knots_[last]);
}

double WalkedPoses::settled_s() const { return knots_.size() < 2 ? knots_.front().at : knots_[knots_.size() - 2].at; }

std::array<double, 8> WalkedPoses::at(double time_s) const {
  if (knots_.size() == 1 || time_s <= knots_.front().at) return knots_.front().value;
  if (time_s >= knots_.back().at) return knots_.back().value;
  const std::size_t i = pieceAt<8>(knots_, 0, knots_.size() - 1, time_s);
  return between(knots_[i], knots_[i + 1], time_s);
}

Pose WalkedPoses::pose(double time_s) const {
  const auto v = at(time_s);
  return {quaternionOf(v), {v[0], v[1], v[2]}};
}

double WalkedPoses::feetHeight_m(double time_s) const { return at(time_s)[kFeet]; }

Result<Trajectory> carriedAlong(std::span<const WalkMoment> moments, const Carrier& carrier, std::uint64_t seed,
                                const std::string& name) {
  WalkedPoses poses;
  for (const auto& moment : moments) poses.add(moment);
  if (poses.empty() || !(poses.last_s() > poses.first_s()))
    return failure(ErrorKind::usage, "the scanner was not carried anywhere", name);
  Trajectory knots;
  const double seconds = poses.last_s() - poses.first_s();
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(seconds / kSmoothed_s - 1e-6)));
  for (std::size_t k = 0; k <= count; ++k) {
    knots.time_s.push_back(k < count ? static_cast<double>(k) * kSmoothed_s : seconds);
    knots.pose.push_back(smoothed(poses, poses.first_s() + knots.time_s.back()));
  }
  TRY_ASSIGN(auto spline, PoseSpline::through(knots));
  const auto path = std::make_shared<const PoseSpline>(std::move(spline));
  const CarriedPose carried(path, carrier, seed, static_cast<std::uint32_t>(stableHash(name.c_str())));
  return evenSamples(carried, kWalkSampled_hz);
}

}  // namespace standpoint
