// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/patterns/scan_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.h"

namespace standpoint {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr std::uint32_t kPulsesPerBlock = 1024;
constexpr std::uint32_t kLeastFirings = 16;  // beams side by side

}  // namespace

ScanPattern::ScanPattern(const MovingHead& head, const ScanSettings& settings)
    : firing_s_(settings.firing_s),
      rotation_hz_(settings.rotation_hz),
      second_rotation_hz_(head.second_rotation_hz),
      start_turns_(head.start_rad / kTurn),
      middle_turns_(head.turn_middle_rad / kTurn),
      half_turns_(head.turn_rad / kTurn / 2),
      beam_radius_m_(head.beam_radius_m) {
  for (std::size_t c = 0; c < head.channel_elevations_rad.size(); ++c) {
    Channel& channel = of_head_.emplace_back();
    portable::sinCos(head.channel_elevations_rad[c], channel.sine, channel.cosine);
    if (!head.channel_heights_m.empty()) channel.height_m = head.channel_heights_m[c];
    channel.delay_s = head.first_channel_s + head.channel_s * static_cast<double>(c);
    if (!head.azimuth_offsets_rad.empty())
      portable::sinCos(head.azimuth_offsets_rad[c % head.azimuth_offsets_rad.size()], channel.offset_sine,
                       channel.offset_cosine);
  }
  for (std::size_t h = 0; h < static_cast<std::size_t>(head.heads); ++h) {
    Head& of = heads_.emplace_back();
    if (!head.tilts_rad.empty()) portable::sinCos(head.tilts_rad[h], of.tilt_sine, of.tilt_cosine);
    if (!head.forward_m.empty()) of.at.x() = head.forward_m[h];
    if (!head.up_m.empty()) of.at.z() = head.up_m[h];
  }
  channels_ = static_cast<std::uint32_t>(of_head_.size() * heads_.size());
  firings_per_block_ = std::max(kLeastFirings, kPulsesPerBlock / channels_);
}

std::uint64_t ScanPattern::blocksUntil(double time_s) const {
  const double firings = time_s / firing_s_;
  return firings > 0 ? static_cast<std::uint64_t>(std::ceil(firings / firings_per_block_)) : 0;
}

Pulse ScanPattern::pulse(std::uint64_t firing, std::uint32_t number) const {
  const Channel& channel = of_head_[number % of_head_.size()];
  const Head& head = heads_[number / of_head_.size()];
  Pulse pulse;
  pulse.channel = number;
  pulse.time_s = firingTime_s(firing) + channel.delay_s;

  // Clockwise seen from above.
  const double turns = start_turns_ - rotation_hz_ * pulse.time_s;
  const double turn = turns - std::floor(turns);
  const double off = turn - middle_turns_;
  pulse.measured = half_turns_ >= 0.5 || std::abs(off - std::nearbyint(off)) <= half_turns_;
  double sine = 0, cosine = 0;
  portable::sinCos(kTurn * turn, sine, cosine);
  const Eigen::Vector3d radius(cosine, sine, 0);
  const double across_sine = sine * channel.offset_cosine - cosine * channel.offset_sine;
  const double across_cosine = cosine * channel.offset_cosine + sine * channel.offset_sine;
  const Eigen::Vector3d in_head(channel.cosine * across_cosine, channel.cosine * across_sine, channel.sine);
  const Eigen::Vector3d from = beam_radius_m_ * (radius - in_head) + Eigen::Vector3d(0, 0, channel.height_m);

  const auto tilted = [&head](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(head.tilt_cosine * v.x() + head.tilt_sine * v.z(), v.y(),
                           head.tilt_cosine * v.z() - head.tilt_sine * v.x());
  };
  pulse.direction = tilted(in_head);
  pulse.origin = tilted(from) + head.at;
  if (second_rotation_hz_ <= 0) return pulse;
  const double second = second_rotation_hz_ * pulse.time_s;
  portable::sinCos(kTurn * (second - std::floor(second)), sine, cosine);
  const auto turned = [sine, cosine](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y(), v.z());
  };
  pulse.direction = turned(pulse.direction);
  pulse.origin = turned(pulse.origin);
  return pulse;
}

}  // namespace standpoint
