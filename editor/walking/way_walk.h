// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace standpoint {

// Steers whoever walks along a way: from corner to corner, and to the side for a moment where something is met, as
// people do. It only says where to go; what is in the way stops them as ever.
class WayWalk {
 public:
  static constexpr double kLongestStep_s = 1.0 / 60;  // between two questions: corners lie close on a spiral stair

  WayWalk(std::vector<Eigen::Vector3d> corners, double speed_mps) : corners_(std::move(corners)), speed_(speed_mps) {}

  // Where to go for the next `seconds`, m/s; nothing: it is there, or has given up.
  std::optional<Eigen::Vector2d> velocity(const Eigen::Vector3d& feet, double seconds);
  bool arrived() const { return next_ == corners_.size(); }
  // The corner that it has not come nearer to for a moment, and is about to go round to.
  std::optional<Eigen::Vector3d> heldUpBefore() const;

 private:
  std::vector<Eigen::Vector3d> corners_;
  double speed_ = 0;
  std::size_t next_ = 0;
  double nearest_m_ = 1e300;  // to that corner so far
  double waited_s_ = 0;       // without coming nearer
  double side_ = 1;
  int sidesteps_ = 0;  // since it came nearer last
};

}  // namespace standpoint
