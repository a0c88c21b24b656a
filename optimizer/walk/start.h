// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

#include "optimizer/walk/obstacles.h"

namespace standpoint {

// Whoever looks at a model from anywhere and wants to walk in it.
struct Onlooker {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> looked_at;  // what is seen in the middle of the view
};

struct StartPlace {
  Eigen::Vector3d feet = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector2d> facing;  // unit; nothing: as the onlooker does
  bool no_ground_outside = false;         // behind the main entrance, as nobody can come to it from outside
};

// Where walking begins, the first of: the floor at most 3 m below the eye, inside the building; the floor that is
// looked at; before the main entrance, or just behind it; the middle of the largest island. Never on a roof or a
// ceiling, nor on an island of less than 2 m². Nothing where there is no such place. The main entrance is the outer
// door with the largest island behind it, of several that into the room with the most doors.
std::optional<StartPlace> startPlace(const Environment& environment, const CollideResult& collision,
                                     const Obstacles& obstacles, const Body& body, const Onlooker& onlooker);

// In the room of that product: where most is free around, towards the longest view. Nothing where nobody can stand.
std::optional<StartPlace> placeInRoom(const Environment& environment, std::uint32_t product,
                                      const CollideResult& collision, const Obstacles& obstacles, const Body& body);

// Where most is free around on a floor between two heights, under a cover where there is one.
std::optional<StartPlace> placeOnLevel(const Environment& environment, const CollideResult& collision,
                                       const Obstacles& obstacles, const Body& body, double lowest_m, double highest_m);

}  // namespace standpoint
