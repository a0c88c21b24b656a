// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "scanners/instruments/instrument.h"
#include "scanners/math/vector_lanes.h"

namespace standpoint {

// One pulse of a scanner that moves, in the device's frame: x forward, y left, z up.
struct Pulse {
  double time_s = 0;                                     // since the first firing
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();      // from where the range is measured
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // unit
  std::uint32_t channel = 0;                             // of all heads
  bool measured = true;                                  // false in the part of a turn that is not
};

// Sixteen of them side by side.
struct PulseLanes {
  RayLanes rays;
  double time_s[kPacket] = {};
  std::uint32_t measured = 0;  // bits
};

// When and where the heads of a scanner that moves send their pulses: a pure function of the pulse's number, so a scan
// may begin and end anywhere. Pulses come in firings, one of each channel. Formulas: `docs/explanation/mobile.md`.
class ScanPattern {
 public:
  ScanPattern(const MovingHead& head, const ScanSettings& settings);

  std::uint32_t channels() const { return channels_; }  // of all heads
  double firing_s() const { return firing_s_; }
  double firingTime_s(std::uint64_t firing) const { return static_cast<double>(firing) * firing_s_; }
  Pulse pulse(std::uint64_t firing, std::uint32_t channel) const;

  // Firings are traced in blocks, channel by channel: neighbouring beams are neighbouring in memory.
  std::uint32_t firingsPerBlock() const { return firings_per_block_; }
  std::uint32_t pulsesPerBlock() const { return firings_per_block_ * channels_; }
  // Of the slot of a block.
  std::uint64_t firingOf(std::uint32_t block, std::uint32_t slot) const {
    return std::uint64_t{block} * firings_per_block_ + slot % firings_per_block_;
  }
  std::uint32_t channelOf(std::uint32_t slot) const { return slot / firings_per_block_; }
  // Of sixteen slots from one on; lanes beyond the last slot keep what they have, and are not measured.
  void pulses(std::uint32_t block, std::uint32_t first_slot, PulseLanes& pulses) const;
  // How many blocks there are until that time; the last one is begun before it.
  std::uint64_t blocksUntil(double time_s) const;

  struct Sending;  // of the pulses of one channel: scan_pattern.cpp

 private:
  struct Channel {
    double sine = 0, cosine = 1;  // of its elevation
    double height_m = 0, delay_s = 0;
    double offset_sine = 0, offset_cosine = 1;  // of its azimuth, as the turn goes
  };
  struct Head {
    double tilt_sine = 0, tilt_cosine = 1;
    double at[3] = {};
  };

  // What all pulses have in common.
  struct Turning {
    double rotation_hz = 0, second_rotation_hz = 0;
    double start_turns = 0, middle_turns = 0, half_turns = 0.5;
    double beam_radius_m = 0;
  };
  const Channel& channel(std::uint32_t number) const { return of_head_[number % of_head_.size()]; }
  const Head& head(std::uint32_t number) const { return heads_[number / of_head_.size()]; }

  std::vector<Channel> of_head_;
  std::vector<Head> heads_;
  std::uint32_t channels_ = 1, firings_per_block_ = 1;
  double firing_s_ = 0;
  Turning turning_;
};

}  // namespace standpoint
