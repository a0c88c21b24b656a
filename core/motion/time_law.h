// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "core/motion/cubic_spline.h"

namespace standpoint {

// Where along a path something is at each time, by limits of its speed: from standing to standing, with `stops`.
struct TimeLaw {
  struct Stop {
    std::size_t place = 0;  // of the grid
    double hold_s = 0;
  };
  // `fastest_mps` at each place of a grid with `step_m` between them, positive; the stops in their order, one at most
  // at a place. O(n).
  TimeLaw(std::span<const double> fastest_mps, double step_m, std::span<const Stop> stops, double acceleration_mps2,
          double jerk_mps3);

  double duration_s() const { return knots_.back().at + window_s_; }
  // The way from the beginning after a time, in metres: continuous with its first two derivatives.
  double way_m(double time_s) const;
  double reached_s(double way_m) const;  // the first time

 private:
  double integral(double time_s) const;
  double window_s_;
  std::vector<SplineKnot<1>> knots_;  // way and speed over time, of even accelerations
  std::vector<double> integral_;      // of the way, from the first knot to each
};

}  // namespace standpoint
