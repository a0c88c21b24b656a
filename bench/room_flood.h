// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "bench/collision_soup.h"
#include "core/environment.h"
#include "optimizer/optimizer.h"
#include "optimizer/walk/obstacles.h"

namespace standpoint {

// Triangles whose plane comes nearer than its radius to the upright body.
bool meets(const Soup& soup, const TriangleTree& tree, const Body& body, const Eigen::Vector3d& from,
           const Eigen::Vector3d& to);

// What a flood of places 5 cm apart finds of an IfcSpace; without Recast, and without the shapes.
struct FloodedRoom {
  std::uint32_t product = 0;
  double area_m2 = 0;      // on which somebody can stand
  double mainland_m2 = 0;  // of it, what hangs together with the most rooms near the ground
  double entered_m2 =
      0;           // of it, what hangs together with a place behind a door from where no room is, near the ground
  int others = 0;  // how many other rooms hang together with it
};

// Places where a body stands on the model's own triangles and meets none of them above a step's height, joined where
// their floors differ by no more than a step.
std::vector<FloodedRoom> floodRooms(const Environment& environment, const Soup& model, const Body& body);

}  // namespace standpoint
