// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/motion/stride.h"

#include <algorithm>
#include <cmath>

namespace standpoint {

namespace {

constexpr double kStrideKnot_s = 0.05;
constexpr double kWalkRatio_ms = 0.384;  // step length over step frequency
constexpr double kUnevenness = 0.025;    // of the step frequency
constexpr double kWalking_mps = 0.3;     // from here on a gait is whole

// From 0 to 1 with two derivatives that begin and end at 0.
double faded(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * x * (10 + x * (6 * x - 15));
}

}  // namespace

Stride::Stride(const PoseFunction& path, const MotionKey& key) {
  const BandNoise unevenness(key, 0.05, 0.3);
  const double first = path.first_s(), last = path.last_s();
  const auto count = static_cast<std::size_t>(std::ceil((last - first) / kStrideKnot_s));
  double turns = 0, before = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const double time = i == count ? last : first + static_cast<double>(i) * kStrideKnot_s;
    const double speed = velocity(path, time).linear_mps.norm();
    const double frequency = 0.5 * std::sqrt(speed / kWalkRatio_ms) * (1 + kUnevenness * unevenness.at(time));
    if (i > 0) turns += 0.5 * (before + frequency) * (time - knots_.back().at);
    before = frequency;
    knots_.push_back({time, {turns, speed}, {}});
  }
  fillSlopes<2>(knots_);
}

Stride::At Stride::at(double time_s) const {
  if (knots_.size() < 2) return {};
  const std::size_t i = pieceAt<2>(knots_, 0, knots_.size() - 1, time_s);
  const auto [turns, speed_or_less] = between(knots_[i], knots_[i + 1], time_s);
  const double speed = std::max(speed_or_less, 0.0);
  return {turns, speed, faded(speed / kWalking_mps)};
}

double Stride::stepLength_m(double speed_mps) { return std::sqrt(kWalkRatio_ms * speed_mps); }
double Stride::stepFrequency_hz(double speed_mps) { return std::sqrt(speed_mps / kWalkRatio_ms); }

}  // namespace standpoint
