// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/survey.h"

namespace standpoint {

// What somebody walks in the model, as waypoints along which a scanner could be carried.
class WalkRecord {
 public:
  void begin();
  void end() { active_ = false; }  // what was walked stays until it begins anew
  bool active() const { return active_; }
  // Where the feet are, once a frame. Somebody who is suddenly elsewhere has not walked there: false, and it ends.
  bool follow(double now_s, const Eigen::Vector3d& feet);

  double seconds() const;
  double length_m() const;
  double speed_mps() const;  // while they walked; 0: they stood
  // Corners, so that straight legs stray from what was walked by 5 cm; and where they stood for a second or longer,
  // with the time.
  std::vector<Waypoint> waypoints() const;

 private:
  struct Sample {
    double from_s = 0, until_s = 0;  // that they stood there
    Eigen::Vector3d feet;            // local frame
  };
  void keepBetween(std::size_t from, std::size_t to, std::vector<bool>& kept) const;

  bool active_ = false;
  std::vector<Sample> samples_;
};

}  // namespace standpoint
