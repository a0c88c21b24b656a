// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>

#include "scanners/instruments/instrument.h"

namespace standpoint {

// A beam as rays that share its power (physics.md §4.1): its axis and two rings at 0.4 and 0.8 of the radius w where
// the intensity of a Gaussian beam has fallen to 1/e². The rays are skew lines: they start D0/2 off the axis and lean
// by half of the divergence across it, so that at a range R they are w(R) = ½ √(D0² + (γR)²) apart from it, as the beam
// is.
struct SubRay {
  double cosine, sine;  // of its place on the ring
  double fraction;      // of w
  float weight;         // of the beam's power
};
constexpr double kOuterFraction = 0.8;
constexpr float kAxisWeight = 0.0889F;
constexpr int kProbes = 6;  // the first ones, on the outer ring, tell whether the beam meets anything but one surface
constexpr int kSubRays = 18;
const std::array<SubRay, kSubRays>& subRays();

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
// Where a ray of the beam runs; the direction is not normalised, it is 1 to 10⁻⁷.
struct RayLine {
  Eigen::Vector3d origin, direction;
};
inline RayLine lineOf(const Beam& beam, const SubRay& ray, const Instrument& instrument) {
  const double offset = 0.5 * instrument.exit_diameter_m * ray.fraction;
  const double lean = 0.5 * instrument.divergence_rad * ray.fraction;
  return {beam.origin + offset * (ray.cosine * beam.across + ray.sine * beam.upward),
          beam.direction + lean * (ray.cosine * beam.upward - ray.sine * beam.across)};
}

}  // namespace standpoint
