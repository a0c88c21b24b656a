// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/motion/cubic_spline.h"
#include "core/motion/pose_function.h"

namespace standpoint {

// How a body leans as its way bends and its speed changes, in parts of the angle at which nothing on it would be pushed
// aside, atan(a / g): 1 as what flies must, into the bend and nose down to go faster; below 0 as what has springs, out
// of the bend and nose up.
struct Lean {
  double roll = 0, pitch = 0;
  double most_rad = 0;      // either; 0: it does not lean
  double response_s = 0.5;  // it takes as long to lean in full
  double axis_below_m = 0;  // of the body's origin: what it leans about
};

// A path of upright poses with that lean. Accelerations are those of the path, sampled every 50 ms where it has an end;
// the lean is a spline of time, so that it is C2 where the path is.
class LeaningPose final : public PoseFunction {
 public:
  LeaningPose(PoseFunctionPtr path, const Lean& lean);
  Pose pose(double time_s) const override;
  double first_s() const override { return path_->first_s(); }
  double last_s() const override { return path_->last_s(); }

 private:
  PoseFunctionPtr path_;
  double axis_below_m_;
  std::vector<SplineKnot<2>> knots_;  // roll and pitch; none: it has no end, and no lean
};

}  // namespace standpoint
