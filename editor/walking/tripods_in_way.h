// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "optimizer/walk/obstacles.h"

namespace standpoint {

// Where a tripod stands, and how high above that its instrument is.
struct Tripod {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();
  double height_m = 0;
  bool operator==(const Tripod&) const = default;
};

// Tripods are in the way of whoever walks, as posts about as wide as their instruments: legs are stepped between. One
// that was put up where somebody stands, or where somebody was put, is in nobody's way until they have left it.
class TripodsInWay {
 public:
  // Once a frame.
  void follow(const std::vector<Tripod>& tripods, const Eigen::Vector3d& feet, const Body& body);
  const Obstacles* obstacles() const { return obstacles_.get(); }  // null: none is in the way

 private:
  std::vector<Tripod> met_;
  std::unique_ptr<Obstacles> obstacles_;  // these
};

}  // namespace standpoint
