// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "scanners/engine/pose_window.h"
#include "scanners/engine/scan_motion.h"

namespace standpoint {

// The poses by which the points of a scanner that moves are placed: those that whoever writes them believes in.
class PointPlacing {
 public:
  // `rotation_hz`: turns of its frames; 0 = the whole scan is one.
  PointPlacing(const ScanMotion& motion, double rotation_hz);
  // For pulses from one time to another, since the first firing.
  void begin(double first_s, double last_s);
  // points_from_device, for a pulse and the firing it belongs to; within what was begun.
  Pose at(double pulse_s, double firing_s) const;

 private:
  // A turn that the window touches, and the pose at its beginning and one turn before.
  struct Turn {
    double from_s = 0;
    Pose start, before;
  };
  Pose exactly(double since_first_s) const;

  const ScanMotion& motion_;
  double rotation_hz_;
  Pose points_from_local_;
  PoseWindow window_;
  std::vector<Turn> turns_;
};

}  // namespace standpoint
