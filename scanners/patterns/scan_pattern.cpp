// SPDX-License-Identifier: GPL-3.0-or-later
#include "scanners/patterns/scan_pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/portable_math.h"
#include "scanners/math/target_clones.h"

namespace standpoint {

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr std::uint32_t kPulsesPerBlock = 1024;
constexpr std::uint32_t kLeastFirings = 16;  // beams side by side

}  // namespace

// How the pulses of one channel are sent.
struct ScanPattern::Sending {
  Turning of;
  Channel channel;
  Head head;

  // Clockwise seen from above.
  STANDPOINT_INLINE bool at(double time_s, double* origin, double* direction) const {
    const double turns = of.start_turns - of.rotation_hz * time_s;
    const double turn = turns - std::floor(turns);
    const double off = turn - of.middle_turns;
    double sine = 0, cosine = 0;
    portable::sinCos(kTurn * turn, sine, cosine);
    const double across_sine = sine * channel.offset_cosine - cosine * channel.offset_sine;
    const double across_cosine = cosine * channel.offset_cosine + sine * channel.offset_sine;
    tilt(channel.cosine * across_cosine, channel.cosine * across_sine, channel.sine, direction);
    tilt(of.beam_radius_m * (cosine - channel.cosine * across_cosine),
         of.beam_radius_m * (sine - channel.cosine * across_sine),
         of.beam_radius_m * (0 - channel.sine) + channel.height_m, origin);
    for (int i = 0; i < 3; ++i) origin[i] += head.at[i];
    return std::abs(off - std::nearbyint(off)) <= of.half_turns;
  }

  STANDPOINT_INLINE void turnAgain(double time_s, double* origin, double* direction) const {
    const double turns = of.second_rotation_hz * time_s;
    double sine = 0, cosine = 0;
    portable::sinCos(kTurn * (turns - std::floor(turns)), sine, cosine);
    turn(sine, cosine, origin), turn(sine, cosine, direction);
  }

 private:
  STANDPOINT_INLINE void tilt(double x, double y, double z, double* to) const {
    to[0] = head.tilt_cosine * x + head.tilt_sine * z;
    to[1] = y;
    to[2] = head.tilt_cosine * z - head.tilt_sine * x;
  }
  STANDPOINT_INLINE static void turn(double sine, double cosine, double* v) {
    const double x = cosine * v[0] - sine * v[1], y = sine * v[0] + cosine * v[1];
    v[0] = x, v[1] = y;
  }
};

namespace {

// Where and when a channel sends those of sixteen pulses that are `in`; `first_firing`: the number of the first lane's.
STANDPOINT_CLONES void send(const ScanPattern::Sending& of, double first_firing, double firing_s, double delay_s,
                            const std::uint64_t* in, PulseLanes& pulses, std::uint64_t* measured) {
  const ScanPattern::Sending sending = of;
  auto& [origins, directions] = pulses.rays;
  const auto keep = [in](int k, double value, double& to) { to = in[k] != 0 ? value : to; };
  for (int k = 0; k < kPacket; ++k) {
    const double time_s = (first_firing + k) * firing_s + delay_s;
    double origin[3], direction[3];
    const bool measures = sending.at(time_s, origin, direction);
    measured[k] = measures ? in[k] : 0;
    keep(k, time_s, pulses.time_s[k]);
    keep(k, origin[0], origins.x[k]), keep(k, origin[1], origins.y[k]), keep(k, origin[2], origins.z[k]);
    keep(k, direction[0], directions.x[k]), keep(k, direction[1], directions.y[k]);
    keep(k, direction[2], directions.z[k]);
  }
}

STANDPOINT_CLONES void turnAgain(const ScanPattern::Sending& sending, PulseLanes& pulses) {
  auto& [origins, directions] = pulses.rays;
  for (int k = 0; k < kPacket; ++k) {
    double origin[3] = {origins.x[k], origins.y[k], origins.z[k]};
    double direction[3] = {directions.x[k], directions.y[k], directions.z[k]};
    sending.turnAgain(pulses.time_s[k], origin, direction);
    origins.x[k] = origin[0], origins.y[k] = origin[1], origins.z[k] = origin[2];
    directions.x[k] = direction[0], directions.y[k] = direction[1], directions.z[k] = direction[2];
  }
}

}  // namespace

ScanPattern::ScanPattern(const MovingHead& head, const ScanSettings& settings)
    : firing_s_(settings.firing_s),
      turning_{.rotation_hz = settings.rotation_hz,
               .second_rotation_hz = head.second_rotation_hz,
               .start_turns = head.start_rad / kTurn,
               .middle_turns = head.turn_middle_rad / kTurn,
               .half_turns = head.turn_rad / kTurn / 2,
               .beam_radius_m = head.beam_radius_m} {
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
    if (!head.forward_m.empty()) of.at[0] = head.forward_m[h];
    if (!head.up_m.empty()) of.at[2] = head.up_m[h];
  }
  channels_ = static_cast<std::uint32_t>(of_head_.size() * heads_.size());
  firings_per_block_ = std::max(kLeastFirings, kPulsesPerBlock / channels_);
}

std::uint64_t ScanPattern::blocksUntil(double time_s) const {
  const double firings = time_s / firing_s_;
  return firings > 0 ? static_cast<std::uint64_t>(std::ceil(firings / firings_per_block_)) : 0;
}

Pulse ScanPattern::pulse(std::uint64_t firing, std::uint32_t number) const {
  const Sending sending{turning_, channel(number), head(number)};
  Pulse pulse;
  pulse.channel = number;
  pulse.time_s = firingTime_s(firing) + sending.channel.delay_s;
  pulse.measured = sending.at(pulse.time_s, pulse.origin.data(), pulse.direction.data());
  if (turning_.second_rotation_hz > 0) sending.turnAgain(pulse.time_s, pulse.origin.data(), pulse.direction.data());
  return pulse;
}

void ScanPattern::pulses(std::uint32_t block, std::uint32_t first_slot, PulseLanes& pulses) const {
  pulses.measured = 0;
  const std::uint32_t count = std::min<std::uint32_t>(kPacket, pulsesPerBlock() - first_slot);
  for (std::uint32_t from = 0, to = 0; from < count; from = to) {  // lanes of one channel
    const std::uint32_t number = channelOf(first_slot + from);
    to = std::min(count, (number + 1) * firings_per_block_ - first_slot);
    std::uint64_t in[kPacket] = {}, measured[kPacket];
    std::fill(in + from, in + to, 1U);
    const Sending sending{turning_, channel(number), head(number)};
    // Of the first lane, though it may be another channel's.
    const double first = static_cast<double>(firingOf(block, first_slot + from)) - static_cast<double>(from);
    send(sending, first, firing_s_, sending.channel.delay_s, in, pulses, measured);
    pulses.measured |= bitsOf(measured);
  }
  if (turning_.second_rotation_hz > 0) turnAgain({turning_, of_head_[0], heads_[0]}, pulses);
}

}  // namespace standpoint
