// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/motion/carriers.h"
#include "core/motion/pose_function.h"
#include "core/motion/random_walk.h"
#include "core/motion/stride.h"

namespace standpoint {

// A path as a carrier goes it: a walker's gait, the lean of what flies or has springs (lean.h) and the carrier's
// shaking, added in the body frame (mobile.md §3.1).
//
// Steps have the frequency √(v / 0.384 m·s) of a constant walk ratio: 1.91 Hz at 1.4 m/s (Pachi & Ji 2005: 2.0). Peak
// to peak a trunk goes up and down by 27 + 23 (v - 0.7) mm, and sideways by 70 - 34 (v - 0.7) mm, v in m/s; both fade
// out below 0.3 m/s. A walker's own amplitudes of roll, pitch and yaw (1 to 3°, 1 to 2°, 2 to 4°), the shape of the
// steps and how their length varies (2.5 %) are drawn for the trajectory. Phase and speed are sampled from the path
// when this is built and are splines of time; all else is in closed form, so that it is C2 where the path is.
//
// A pose costs some microseconds: sampled() gives what a scan can ask for each pulse.
class CarriedPose : public PoseFunction {
 public:
  CarriedPose(PoseFunctionPtr path, const Carrier& carrier, std::uint64_t seed, std::uint32_t trajectory);

  Pose pose(double time_s) const override;
  double first_s() const override { return path_->first_s(); }
  double last_s() const override { return path_->last_s(); }

 private:
  struct Shake {
    BandNoise noise;
    double amplitude;
    int part;  // x, y, z, roll, pitch, yaw
  };
  void walk(const MotionKey& key);
  void addGait(double time_s, std::array<double, 6>& parts) const;

  PoseFunctionPtr path_;
  double gait_;
  std::optional<Stride> stride_;                       // none: it does not walk
  double roll_rad_ = 0, pitch_rad_ = 0, yaw_rad_ = 0;  // amplitudes
  double second_rad_ = 0, fourth_rad_ = 0;             // phases of the harmonics
  std::vector<Shake> shakes_;
};

// The spline through the function's poses at `hertz` in its own time, or an error where that has no end or would take
// more than 50 million samples. Of a shake of 10 Hz sampled at 200 Hz it leaves a thousandth.
Result<PoseSpline> sampled(const PoseFunction& function, double hertz);

}  // namespace standpoint
