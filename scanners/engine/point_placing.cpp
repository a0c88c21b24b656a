// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/engine/point_placing.h"

#include <algorithm>
#include <cmath>

#include "core/motion/rotation_vector.h"

namespace standpoint {

namespace {

const PoseFunction& solvedOf(const ScanMotion& motion) {
  return motion.solved_pose != nullptr ? *motion.solved_pose : motion.true_pose;
}

}  // namespace

PointPlacing::PointPlacing(const ScanMotion& motion, double rotation_hz)
    : motion_(motion), rotation_hz_(rotation_hz), points_from_local_(inverse(motion.local_from_points)) {}

Pose PointPlacing::exactly(double since_first_s) const {
  return solvedOf(motion_).pose(motion_.from_s + motion_.assumed.clock_ahead_s + since_first_s) *
         motion_.assumed.body_from_device;
}

void PointPlacing::begin(double first_s, double last_s) {
  if (motion_.deskew == Deskew::pulse || motion_.deskew == Deskew::firing) {
    const double from_s = motion_.from_s + motion_.assumed.clock_ahead_s;
    constexpr double kLongestDelay_s = 1e-3;  // of a channel after its firing
    window_.sample(solvedOf(motion_), motion_.assumed.body_from_device, from_s + first_s - kLongestDelay_s,
                   from_s + last_s);
    return;
  }
  turns_.clear();
  const double turn_s = rotation_hz_ > 0 ? 1 / rotation_hz_ : 0;
  const auto number = [&](double time_s) { return std::floor(time_s * rotation_hz_); };
  for (double turn = number(first_s); turn <= number(last_s); ++turn) {
    Turn& of = turns_.emplace_back();
    of.from_s = turn * turn_s;
    of.start = exactly(of.from_s);
    of.before = exactly(of.from_s - turn_s);
  }
}

Pose PointPlacing::at(double pulse_s, double firing_s) const {
  if (motion_.deskew == Deskew::pulse || motion_.deskew == Deskew::firing)
    return points_from_local_ * window_.at(motion_.from_s + motion_.assumed.clock_ahead_s +
                                           (motion_.deskew == Deskew::pulse ? pulse_s : firing_s));
  const double first = std::floor(turns_.front().from_s * rotation_hz_ + 0.5);
  const auto turn = std::clamp(std::floor(pulse_s * rotation_hz_) - first, 0.0, static_cast<double>(turns_.size() - 1));
  const Turn& of = turns_[static_cast<std::size_t>(turn)];
  if (motion_.deskew == Deskew::none || rotation_hz_ <= 0) return points_from_local_ * of.start;
  const double turns = (pulse_s - of.from_s) * rotation_hz_;  // evenly on, as through the turn before
  const Eigen::Vector3d turned = rotationVector(of.before.rotation.conjugate() * of.start.rotation);
  return points_from_local_ * Pose{of.start.rotation * rotationBy(turns * turned),
                                   of.start.translation + turns * (of.start.translation - of.before.translation)};
}

}  // namespace standpoint
