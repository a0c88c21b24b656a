// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "scanners/instruments/instrument.h"
#include "scanners/math/vector_lanes.h"

namespace standpoint {

// A beam as rays that share its power (physics.md §4.1), in a pattern that no two pulses have alike: a fixed one would
// sort the points of an edge into layers. In units of w, the radius where the intensity of a Gaussian beam has fallen
// to 1/e². The rays are skew lines: they start D0/2 off the axis and lean by half of the divergence across it, so that
// at a range R they are w(R) = ½ √(D0² + (γR)²) apart from it, as the beam is.
struct SubRay {
  double across, upward;
  float weight;  // of the beam's power; of a pattern they add up to 1
};
constexpr double kBeamEdge = 1.5;  // that far out rays are sent, in w: 1.1 % of the power is farther out
constexpr int kSubRays = 16;       // one packet
constexpr double kGoldenTurns = 0.6180339887498949;  // the golden angle, of a turn
constexpr int kReferenceSubRays = 64;                // where accuracy is worth any time
constexpr std::uint32_t kFootprintChannel = 9;       // of Philox

// The pattern of one pulse from its own random numbers (core/random.h): `count` rays, at most kReferenceSubRays, one in
// each ring of a spiral that is turned as a whole, moved along itself and stretched by chance; weights follow
// exp(-2r²). The share beyond a straight edge is ½ erfc(√2 x/w) in the mean over pulses, within 0.005; that of one
// pulse strays from it by σ ≤ 0.057 of 16 rays, 0.02 of 64.
void drawFootprint(const std::array<std::uint32_t, 4>& draw, int count, SubRay* rays);

inline double beamRadius(const Instrument& instrument, double range_m) {
  const double spread = instrument.divergence_rad * range_m;
  return 0.5 * std::sqrt(instrument.exit_diameter_m * instrument.exit_diameter_m + spread * spread);
}

// How far a place may lie off a surface, along the beam, and still be taken for a part of it.
inline double edgeTolerance(const Instrument& instrument, double range_m) {
  return 0.005 + 0.5 * beamRadius(instrument, range_m);
}

// A beam that a pulse sends: local frame, right-handed axes.
struct Beam {
  Eigen::Vector3d origin, direction, across, upward;
};
// Sixteen beams side by side.
struct BeamLanes {
  RayLanes axes;
  VectorLanes across, upward;

  Beam at(std::uint32_t lane) const {
    return {axes.origin.at(lane), axes.direction.at(lane), across.at(lane), upward.at(lane)};
  }
  void set(std::uint32_t lane, const Beam& beam) {
    axes.origin.set(lane, beam.origin), axes.direction.set(lane, beam.direction);
    across.set(lane, beam.across), upward.set(lane, beam.upward);
  }
};
// Where a ray of the beam runs; the direction is not normalised, it is 1 to 10⁻⁷.
struct RayLine {
  Eigen::Vector3d origin, direction;
};
// At (across, upward) of the beam, in w. Linear in them: the ray of a mean place is the mean of the rays.
inline RayLine lineOf(const Beam& beam, double across, double upward, const Instrument& instrument) {
  const double offset = 0.5 * instrument.exit_diameter_m, lean = 0.5 * instrument.divergence_rad;
  return {beam.origin + offset * (across * beam.across + upward * beam.upward),
          beam.direction + lean * (across * beam.upward - upward * beam.across)};
}

}  // namespace standpoint
