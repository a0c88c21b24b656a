// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "optimizer/walk/door_leaves.h"
#include "optimizer/walk/obstacles.h"

namespace standpoint {

// Doors that open before whoever walks and close behind. They are a way of looking: neither the document nor what a
// scan sees changes. A leaf is in nobody's way unless it was shut by hand and stands still.
class SwingingDoors {
 public:
  // The leaves are kept as long as this is.
  explicit SwingingDoors(std::shared_ptr<const DoorLeaves> leaves);

  // `going`: unit vector of where the feet go, zero where they stand.
  void follow(const Eigen::Vector3d& feet, const Eigen::Vector2d& going, double seconds);
  // Opens or shuts the nearest door within reach; it stays so until one has gone away. False where there is none, or
  // where one stands in it. `ahead`: where one looks.
  bool toggle(const Eigen::Vector3d& feet, const Eigen::Vector2d& ahead);
  bool anyInReach(const Eigen::Vector3d& feet, const Eigen::Vector2d& ahead) const {
    return inReach(feet, ahead).has_value();
  }

  bool moves() const { return moves_; }
  // As they stand now; null where the model has no door with a leaf.
  const std::shared_ptr<const Environment>& scene() const { return scene_; }
  const Obstacles* shut() const { return shut_.get(); }  // null: none is

 private:
  struct State {
    double opened = 0;  // from -1 to 1, as swung() has it
    int wanted = 0;     // -1, 0 or 1
    double away_s = 0;  // since one has gone away
    bool by_hand = false;
    bool shut() const { return by_hand && wanted == 0 && opened == 0; }
  };
  std::optional<std::size_t> inReach(const Eigen::Vector3d& feet, const Eigen::Vector2d& ahead) const;
  void open(std::size_t door, const Eigen::Vector3d& feet);
  void shutBodies();

  std::shared_ptr<const DoorLeaves> leaves_;
  std::vector<State> states_;
  std::shared_ptr<const Environment> scene_;
  std::unique_ptr<Obstacles> shut_;
  bool moves_ = false;
};

}  // namespace standpoint
