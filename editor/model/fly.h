// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "editor/camera/camera.h"

namespace standpoint {

struct Model;

// Keys that are held: right, ahead and up, each -1, 0 or 1.
struct FlyKeys {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  bool fast = false;
};

// Moves the camera where it looks, through walls and without weight.
class Fly {
 public:
  void begin(Camera& camera);
  void end(Camera& camera);
  void go(const FlyKeys& keys, double seconds, Camera& camera);
  void changeSpeed(double steps);  // from a tenth of the usual one to ten times
  double speed_mps(bool fast) const;
  bool moves() const { return !velocity_.isZero(); }

 private:
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  // m/s
  double factor_ = 1;
  double view_angle_before_rad_ = 0;
};

// From where one looks, or walks; stopFlying() leaves the view where it is.
void startFlying(Model& model);
void stopFlying(Model& model);

}  // namespace standpoint
