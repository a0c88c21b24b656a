// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "scanners/engine/embree.h"

namespace standpoint {

// A sphere in the local frame.
struct PlacedBall {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

// Where the line first meets it, in metres from the origin; from within, where it leaves it. A line that only just
// misses it is answered with the place where it comes nearest: whether a beam meets it is not asked here.
double rangeOnBall(const PlacedBall& ball, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction_unit);

// A geometry of that one sphere, in double from the rays' floats. `ball` must outlive it.
RTCGeometry ballGeometry(RTCDevice device, const PlacedBall& ball);

}  // namespace standpoint
