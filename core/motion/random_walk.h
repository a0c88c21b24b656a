// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace standpoint {

// What of a motion a random number is for. Processes with several components take as many numbers from theirs on; far
// from the channels of a scan's own noise (scanners/noise), whose generator is the same.
enum class MotionProcess : std::uint32_t {
  drift = 0x4D000000,        // six: position along, across and up, roll, pitch, heading
  first_error = 0x4D000100,  // seven
  within_scan = 0x4D000200,  // six
  constraint = 0x4D000300,   // six, by the constraint's two knots
  gait = 0x4D000400,         // one
  hand = 0x4D000500,         // six of each band
};

// Whose random numbers they are. One number belongs to (seed; trajectory, process, level, index), never to a thread or
// to what was asked before.
struct MotionKey {
  std::uint64_t seed = 0;
  std::uint32_t trajectory = 0;  // its place in the job
  MotionProcess process = MotionProcess::drift;
  std::uint32_t component = 0;  // of the process
};

// A standard normal number by the Box-Muller transform, and a uniform one in (0, 1); the same bits on every processor.
double normalNumber(const MotionKey& key, std::uint32_t level, std::uint32_t index);
double uniformNumber(const MotionKey& key, std::uint32_t level, std::uint32_t index);

// A Brownian walk on the knots 0 to 2^20, W(0) = 0, with increments of variance 1: by midpoints (Lévy's construction),
// so that any knot can be asked for in any order, in 20 steps, and a longer walk begins like a shorter one.
class RandomWalk {
 public:
  static constexpr int kLevels = 20;
  static constexpr std::uint32_t kLastKnot = 1U << 20U;

  explicit RandomWalk(const MotionKey& key) : key_(key) {}
  double at(std::uint32_t knot) const;
  // W(0) to W(count - 1), the same bits as at() of each in a tenth of the time; count <= kLastKnot + 1.
  std::vector<double> first(std::uint32_t count) const;

 private:
  double middle(double low, double high, int level, std::uint32_t knot) const;
  void fill(std::uint32_t low, int level, double at_low, double at_high, std::vector<double>& knots) const;
  MotionKey key_;
};

// A Gauss-Markov (Ornstein-Uhlenbeck) process of variance 1 on the knots 0 to 2^20, whose correlation over n knots is
// exp(-n step/τ): by midpoints, too.
class GaussMarkov {
 public:
  // `step_per_tau` > 0: the time between two knots in correlation times.
  GaussMarkov(const MotionKey& key, double step_per_tau);
  double at(std::uint32_t knot) const;

 private:
  MotionKey key_;
  std::array<double, RandomWalk::kLevels + 1> correlation_{};  // over 2^level knots
};

// Noise of standard deviation 1 whose frequencies lie in a band: sixteen sinusoids of equal strength, one in each
// sixteenth of the band, with frequency and phase drawn. A smooth function of time without state. It costs 0.1 µs;
// a dozen of them are sampled before a scan rather than asked for each pulse.
class BandNoise {
 public:
  BandNoise(const MotionKey& key, double lowest_hz, double highest_hz);
  double at(double time_s) const;

 private:
  static constexpr int kCount = 16;
  std::array<double, kCount> hertz_{}, phase_turns_{};
};

}  // namespace standpoint
