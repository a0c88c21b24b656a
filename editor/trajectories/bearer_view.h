// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "editor/camera/camera.h"
#include "editor/trajectories/trajectory_ways.h"

namespace standpoint {

// A camera that goes along with what is carried, behind it on its own way and a little above: where the carrier has
// just been is room for it, too.
class BearerView {
 public:
  // Whether nothing stands between two places.
  using Sees = std::function<bool(const Eigen::Vector3d& from, const Eigen::Vector3d& to)>;

  // It comes from where `camera` is, within a moment.
  void begin(const Camera& camera);
  void end() { from_.reset(); }
  bool active() const { return from_.has_value(); }
  // Whether somebody has moved the camera since follow().
  bool isMoved(const Camera& camera) const;
  // Once a frame: `after_s` since the way begins.
  void follow(const TrajectoryWay& way, const std::string& carrier, double after_s, double passed_s, const Sees& sees,
              Camera& camera);

 private:
  std::optional<Camera> from_;
  std::optional<Camera> last_;  // as it was left
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero(), target_ = Eigen::Vector3d::Zero();
  double gone_s_ = 0;
};

}  // namespace standpoint
