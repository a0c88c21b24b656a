// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/pose_spline.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/motion/rotation_vector.h"

namespace standpoint {

namespace {

Result<void> checkSamples(const Trajectory& samples) {
  if (samples.pose.empty() || samples.pose.size() != samples.time_s.size())
    return failure(ErrorKind::unusable, "a trajectory needs at least one pose, and a time for each");
  for (std::size_t i = 0; i < samples.pose.size(); ++i) {
    const auto wrong = [&](const char* what) {
      return failure(ErrorKind::unusable, what, fmt::format("sample {}", i));
    };
    const Pose& pose = samples.pose[i];
    if (!std::isfinite(samples.time_s[i]) || !pose.translation.allFinite() || !pose.rotation.coeffs().allFinite())
      return wrong("is not a number");
    if (std::abs(pose.rotation.squaredNorm() - 1) > 2e-3) return wrong("has a quaternion that is not of length 1");
    if (i > 0 && samples.time_s[i] <= samples.time_s[i - 1]) return wrong("is not later than the sample before it");
  }
  return {};
}

Pose poseOf(const std::array<double, 7>& value) {
  return {unitRotation({value[3], value[4], value[5], value[6]}), {value[0], value[1], value[2]}};
}

}  // namespace

Result<PoseSpline> PoseSpline::through(const Trajectory& samples, double gap_s) {
  TRY(checkSamples(samples));
  PoseSpline spline;
  spline.knots_.reserve(samples.pose.size());
  Eigen::Quaterniond before = samples.pose.front().rotation;
  for (std::size_t i = 0; i < samples.pose.size(); ++i) {
    const auto& [rotation, place] = samples.pose[i];
    Eigen::Quaterniond q = unitRotation(rotation);
    if (q.dot(before) < 0) q.coeffs() = -q.coeffs();
    before = q;
    const double time = samples.time_s[i];
    if (i > 0 && time - samples.time_s[i - 1] > gap_s) spline.breaks_.push_back({samples.time_s[i - 1], time});
    spline.knots_.push_back({time, {place.x(), place.y(), place.z(), q.w(), q.x(), q.y(), q.z()}, {}});
  }
  std::size_t begin = 0;
  const auto fillUntil = [&](std::size_t end) {
    fillSlopes<7>(std::span(spline.knots_).subspan(begin, end - begin));
    begin = end;
  };
  for (const auto& gap : spline.breaks_)
    fillUntil(1 + pieceAt<7>(spline.knots_, 0, spline.knots_.size() - 1, gap.from_s));
  fillUntil(spline.knots_.size());
  return spline;
}

Pose PoseSpline::pose(double time_s) const {
  if (!(time_s > first_s())) return poseOf(knots_.front().value);
  if (time_s >= last_s()) return poseOf(knots_.back().value);
  const std::size_t i = pieceAt<7>(knots_, 0, knots_.size() - 1, time_s);
  const auto &from = knots_[i], &to = knots_[i + 1];
  const auto gap = std::lower_bound(breaks_.begin(), breaks_.end(), from.at,
                                    [](const TimeGap& a, double time) { return a.from_s < time; });
  if (gap != breaks_.end() && gap->from_s == from.at)
    return poseBetween(poseOf(from.value), poseOf(to.value), (time_s - from.at) / (to.at - from.at));
  return poseOf(between(from, to, time_s));
}

Result<PoseChords> PoseChords::through(Trajectory samples) {
  TRY(checkSamples(samples));
  for (auto& pose : samples.pose) pose.rotation = unitRotation(pose.rotation);
  return PoseChords(std::move(samples));
}

Pose PoseChords::pose(double time_s) const {
  const auto& times = samples_.time_s;
  if (!(time_s > first_s())) return samples_.pose.front();
  if (time_s >= last_s()) return samples_.pose.back();
  const auto next = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin());
  return poseBetween(samples_.pose[next - 1], samples_.pose[next],
                     (time_s - times[next - 1]) / (times[next] - times[next - 1]));
}

Pose poseBetween(const Pose& from, const Pose& to, double fraction) {
  const Eigen::Vector3d turn = rotationVector(from.rotation.conjugate() * to.rotation);
  return {unitRotation(from.rotation * rotationBy(fraction * turn)),
          from.translation + fraction * (to.translation - from.translation)};
}

}  // namespace standpoint
