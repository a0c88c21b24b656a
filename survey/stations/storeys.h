// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/environment.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// Slabs, floorings, stairs, ramps, terrain and what has no class: what people stand on by right, and not because it
// happens to be level, as tables, ducts and roofs are.
bool isMadeForStanding(const Product& product);

// A storey as far as people stand in it.
struct StoreyFloor {
  std::string name;
  double floor_m = 0;                // its height, local frame
  std::size_t rooms = 0;             // IfcSpaces; doors where the model has no IfcSpace
  std::vector<std::uint32_t> doors;  // products
  std::vector<std::uint32_t> spaces;
  Bounds box;  // of its rooms, else of all that it contains
};

// In the order in which a first station is looked for: of those at ground level the one with most rooms, what is above,
// then what is below the ground. Ground level is the storey about the height 0 of the file's frame that has an outer
// door, else the lowest with one; in a model that says of no door whether it is an outer one the storey at 0, else the
// one with most rooms.
std::vector<StoreyFloor> storeysFromGround(const Environment& environment, double shift_z_m);

// A grid of places on what is made for standing at the floor of the storey, with room for an instrument: those in its
// rooms, where there are any.
std::vector<Eigen::Vector3d> placesIn(const StoreyFloor& storey, const RayScene& scene, double height_m);

}  // namespace standpoint
