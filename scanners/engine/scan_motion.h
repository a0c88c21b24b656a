// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/motion/pose_function.h"

namespace standpoint {

// How a device sits on what carries it, and how its clock goes.
struct Mounting {
  Pose body_from_device;     // lever arm and boresight: turned with the body
  double clock_ahead_s = 0;  // of the trajectory's clock
};

// By which pose a point is placed: that of its pulse, of its firing, the one that even motion since the turn before
// would give, or that of the beginning of its turn, as a frame is left that nobody sets right.
enum class Deskew { pulse, firing, turn, none };

// The way of a scanner that moves. Rays are cast from `true_pose` and points are written by `solved_pose`: what differs
// between them is the error of the trajectory. Must outlive the scan.
struct ScanMotion {
  const PoseFunction& true_pose;              // local_from_body
  const PoseFunction* solved_pose = nullptr;  // null: the true one
  Mounting truth = {}, assumed = {};          // how it sits, and how whoever writes the points believes that it does
  double from_s = 0, to_s = 0;                // of the trajectory's clock, in which pulses are sent
  Deskew deskew = Deskew::pulse;
  Pose local_from_points = {};  // the frame of the points: near the way, so that single precision is enough
};

}  // namespace standpoint
