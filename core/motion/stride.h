// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/motion/cubic_spline.h"
#include "core/motion/pose_function.h"
#include "core/motion/random_walk.h"

namespace standpoint {

// How far a walker is in the stride, which turns once in two steps, along a path that has an end. Steps have the
// frequency √(v / 0.384 m·s) of a constant walk ratio, which varies by 2.5 % (mobile.md §3.1). Sampled every 50 ms, a
// spline of time.
class Stride {
 public:
  Stride(const PoseFunction& path, const MotionKey& key);
  struct At {
    double turns = 0, speed_mps = 0;
    double whole = 0;  // of the gait: 0 to 1, below 0.3 m/s it fades out
  };
  At at(double time_s) const;
  static double stepLength_m(double speed_mps);
  static double stepFrequency_hz(double speed_mps);

 private:
  std::vector<SplineKnot<2>> knots_;
};

}  // namespace standpoint
