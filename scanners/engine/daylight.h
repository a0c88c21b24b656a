// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scanners/engine/embree_scene.h"
#include "scanners/instruments/instrument.h"
#include "scanners/radiometry/sun.h"

namespace standpoint {

// What the sun adds to a receiver's own noise (physics.md §4.11): a variance in units of the dark one, so that σ, the
// part of the range noise that falls with power, and the threshold rise by √(1 + it).
//   of a surface: sun_noise · E / 1000 W/m² · ρ cos θ_sun, where no other surface shades it
//   of the sun itself: its disc is π / Ω_sun times as bright as a white surface that it lights; within the field of
//   view all of that comes in, beside it what the optics scatter: 10⁻³ at 1°, falling with the square of the angle
//   (engineering).
// Immutable.
class Daylight {
 public:
  Daylight(const EmbreeScene& scene, const Instrument& instrument, const Sun& sun, const Eigen::Vector3d& station);
  const Eigen::Vector3d& towards() const { return towards_; }  // unit, local frame
  // Of a surface that nothing shades; `normal` towards the instrument.
  float ofSurface(float reflectance, const Eigen::Vector3f& normal) const;
  // Of a beam's direction, unit, local frame: 0 where the instrument stands in the shade.
  float ofDirection(const Eigen::Vector3d& direction) const;

 private:
  Eigen::Vector3d towards_;
  double white_ = 0;  // of a white surface, head-on
  bool station_lit_ = false;
};

}  // namespace standpoint
