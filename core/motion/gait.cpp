// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/gait.h"

#include <algorithm>
#include <cmath>

#include "core/motion/rotation_vector.h"
#include "core/units.h"

namespace standpoint {

namespace {

constexpr double kMostSamples = 50e6;

struct Wave {
  double sine, cosine;
};
Wave waveOf(double radians) {
  Wave wave{};
  const double turns = radians / kRadPerTurn;
  portable::sinCos(kRadPerTurn * (turns - std::floor(turns)), wave.sine, wave.cosine);
  return wave;
}

}  // namespace

CarriedPose::CarriedPose(PoseFunctionPtr path, const Carrier& carrier, std::uint64_t seed, std::uint32_t trajectory)
    : path_(carrier.lean.most_rad > 0 ? std::make_shared<const LeaningPose>(std::move(path), carrier.lean)
                                      : std::move(path)),
      gait_(carrier.gait) {
  if (gait_ > 0 && std::isfinite(path_->first_s()) && std::isfinite(path_->last_s()))
    walk({seed, trajectory, MotionProcess::gait});
  for (std::size_t band = 0; band < carrier.shakes.size(); ++band)
    for (int part = 0; part < 6; ++part) {
      const auto& shake = carrier.shakes[band];
      const double amplitude = part < 3 ? shake.position_m[part] : shake.angle_rad[part - 3];
      const auto component = static_cast<std::uint32_t>(6 * band) + static_cast<std::uint32_t>(part);
      if (amplitude <= 0) continue;
      const BandNoise noise({seed, trajectory, MotionProcess::hand, component}, shake.lowest_hz, shake.highest_hz);
      shakes_.push_back({noise, amplitude, part});
    }
}

void CarriedPose::walk(const MotionKey& key) {
  const auto between_degrees = [&](double least, double most, std::uint32_t index) {
    return (least + (most - least) * uniformNumber(key, 2, index)) * kRadPerDeg;
  };
  roll_rad_ = between_degrees(1, 3, 0);
  pitch_rad_ = between_degrees(1, 2, 1);
  yaw_rad_ = between_degrees(2, 4, 2);
  second_rad_ = between_degrees(0, 360, 3);
  fourth_rad_ = between_degrees(0, 360, 4);
  stride_.emplace(*path_, key);
}

// φ turns once in two steps. What the trunk gains on its mean speed, 7 % of it, is A_x = 0.07 v / 2φ' of way.
void CarriedPose::addGait(double time_s, std::array<double, 6>& parts) const {
  const Stride::At stride = stride_->at(time_s);
  const double speed = stride.speed_mps, whole = gait_ * stride.whole;
  if (whole <= 0) return;
  const double phase = kRadPerTurn * (stride.turns - std::floor(stride.turns));
  const Wave one = waveOf(phase), two = waveOf(2 * phase), second = waveOf(2 * phase + second_rad_),
             fourth = waveOf(4 * phase + fourth_rad_);
  const double up_m = 0.5 * (0.027 + 0.023 * (speed - 0.7));
  const double across_m = 0.5 * std::max(0.0, 0.070 - 0.034 * (speed - 0.7));
  const double along_m = 0.07 * speed / (kRadPerTurn * Stride::stepFrequency_hz(speed));
  parts[0] += whole * along_m * second.sine;
  parts[1] += whole * across_m * one.sine;
  parts[2] += whole * up_m * (two.cosine + 0.25 * fourth.cosine);
  parts[3] += whole * roll_rad_ * one.sine;
  parts[4] += whole * pitch_rad_ * two.cosine;
  parts[5] += whole * yaw_rad_ * one.sine;
}

Pose CarriedPose::pose(double time_s) const {
  const double time = std::clamp(time_s, first_s(), last_s());
  std::array<double, 6> parts{};
  if (stride_) addGait(time, parts);
  for (const auto& shake : shakes_) parts[shake.part] += shake.amplitude * shake.noise.at(time);
  const Pose on_path = path_->pose(time);
  Pose pose = on_path * Pose{rotationOf({parts[3], parts[4], parts[5]}), {parts[0], parts[1], parts[2]}};
  pose.rotation = unitRotation(pose.rotation);
  return pose;
}

Result<PoseSpline> sampled(const PoseFunction& function, double hertz) {
  const double first = function.first_s(), seconds = function.last_s() - first;
  if (!std::isfinite(seconds) || !(seconds * hertz <= kMostSamples))
    return failure(ErrorKind::unusable, "a motion without an end, or of more than 50 million samples, is not sampled");
  const auto count = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(seconds * hertz)));
  Trajectory samples;
  for (std::size_t i = 0; i <= count && (i == 0 || seconds > 0); ++i) {
    samples.time_s.push_back(first + seconds * static_cast<double>(i) / static_cast<double>(count));
    samples.pose.push_back(function.pose(samples.time_s.back()));
  }
  return PoseSpline::through(samples);
}

}  // namespace standpoint
