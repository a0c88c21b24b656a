// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "core/georeference.h"
#include "emulated-ui/device/walk.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// The map that grows on the screen while a scanner is carried: every 0.3 m of the way, rays of the scene say what is
// seen from there. By the way alone, however long the steps of the clock are.
class WalkMap {
 public:
  // Carried so high above the floor.
  void begin(std::shared_ptr<const RayScene> scene, const Georeference& georeference, double height_m);
  bool ready() const { return scene_ != nullptr; }
  // What of the walk is new since the last call. Null: nothing is.
  std::shared_ptr<const SeenMap> grow(const WalkState& walk);
  // The name of what stands between two places, at the height of the scanner; doors are opened on the way. Empty:
  // nothing, or it is not known before the first look.
  std::string between(const std::array<double, 2>& from, const std::array<double, 2>& to) const;

 private:
  bool look(double x_m, double y_m);  // false: there is no floor

  std::shared_ptr<const RayScene> scene_;
  Eigen::Vector3d shift_m_ = Eigen::Vector3d::Zero();
  SeenMap map_;
  double looked_m_ = -1;  // of the way, at the last look; before the first: less than nothing
  double height_m_ = 0;   // above the floor
  double eye_m_ = 0;      // local height
};

}  // namespace standpoint
