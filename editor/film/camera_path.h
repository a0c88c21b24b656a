// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "editor/camera/camera.h"

namespace standpoint {

// What the camera of a film does.

// One turn around the middle of `around`, as `from` looks at it, from so far that all of it is in each picture. `share`
// of the turn is 0 to 1; at 1 it is where it began.
Camera turntableAt(const Camera& from, const Bounds& around, double aspect, double share);

// Somebody who walks along a way, and looks where he goes.
class WalkThrough {
 public:
  static constexpr double kEye_m = 1.60;
  // `way`: places of the feet, no farther apart than a step. Corners are rounded by less than the body's radius of
  // 0.25 m, and whoever has to look elsewhere first turns, then walks on.
  explicit WalkThrough(const std::vector<Eigen::Vector3d>& way);

  double length_m() const { return length_m_; }
  double seconds() const;  // at the pace of somebody who looks around
  Camera at(double share) const;

 private:
  struct Moment {
    Eigen::Vector3d eye;
    double azimuth_rad = 0;
  };
  double length_m_ = 0;
  std::vector<Moment> moments_;  // equally far apart in time
};

}  // namespace standpoint
