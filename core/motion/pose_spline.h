// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "core/motion/cubic_spline.h"
#include "core/motion/pose_function.h"
#include "core/result.h"

namespace standpoint {

// From one time to another nothing is known of the pose.
struct TimeGap {
  double from_s = 0, to_s = 0;
};

// The smooth function through time-stamped poses: position, velocity, acceleration and the same of the orientation are
// continuous (C2), and each sample is met. Position and the four parts of the quaternion are cubic splines of time, the
// quaternion then scaled to unit length; of q and -q the one nearer to the sample before is taken, so that a yaw from
// 350° to 10° passes 0°. It needs no function of the C library, and turning the frame or the body turns the curve. Of
// samples that are more than 90° apart it is a guess, as any curve is.
//
// An error of a sine of frequency f sampled F times a second is about A (2πf/F)⁴/384, of chords it is A (1 - cos πf/F):
// a gait of 20 mm and 1.9 Hz has 7 µm and 0.88 mm at 20 Hz.
class PoseSpline : public PoseFunction {
 public:
  // At least one sample, finite, with times that rise and quaternions of unit length within 1e-3; else an error that
  // names the sample, from 0. Between samples more than `gap_s` apart there is a break: each side has a spline of its
  // own, and the pose goes from one to the other evenly.
  static Result<PoseSpline> through(const Trajectory& samples, double gap_s = std::numeric_limits<double>::infinity());

  Pose pose(double time_s) const override;
  double first_s() const override { return knots_.front().at; }
  double last_s() const override { return knots_.back().at; }
  const std::vector<TimeGap>& breaks() const { return breaks_; }

 private:
  std::vector<SplineKnot<7>> knots_;  // x, y, z in metres, then w, x, y, z of the quaternion
  std::vector<TimeGap> breaks_;
};

// Chords: what a reader of the samples has who joins them by straight lines and even turns. For comparison, and for
// files whose users do so.
class PoseChords : public PoseFunction {
 public:
  // Samples as PoseSpline wants them.
  static Result<PoseChords> through(Trajectory samples);

  Pose pose(double time_s) const override;
  double first_s() const override { return samples_.time_s.front(); }
  double last_s() const override { return samples_.time_s.back(); }

 private:
  explicit PoseChords(Trajectory samples) : samples_(std::move(samples)) {}
  Trajectory samples_;
};

// Position evenly along the chord, orientation evenly about one axis by the shorter way; `fraction` from 0 to 1.
Pose poseBetween(const Pose& from, const Pose& to, double fraction);

}  // namespace standpoint
