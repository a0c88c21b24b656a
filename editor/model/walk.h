// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "editor/model/camera.h"
#include "optimizer/walk/avatar.h"

namespace standpoint {

// Somebody in the model through whose eyes the camera looks.
class Walk {
 public:
  // Stands up on the walkable surface as near to `place` as there is room, and looks level the way the camera looked.
  bool start(std::shared_ptr<const CollideResult> collision, const Body& body, const Eigen::Vector3d& place,
             Camera& camera);
  void stop();
  bool active() const { return avatar_.has_value(); }
  // Whether it walks between these shapes, and not between some that were computed again since.
  bool isIn(const std::shared_ptr<const CollideResult>& collision) const { return collision == collision_; }

  // Goes for this long to the right (x) and ahead (y) of where the camera looks, each -1, 0 or 1.
  void go(const Eigen::Vector2d& keys, bool fast, double seconds, Camera& camera);
  const Eigen::Vector3d& feet() const { return avatar_->feet(); }

 private:
  void lookFromEyes(Camera& camera) const;

  std::shared_ptr<const CollideResult> collision_;
  std::unique_ptr<Obstacles> obstacles_;
  std::optional<Avatar> avatar_;
  Body body_;
};

}  // namespace standpoint
