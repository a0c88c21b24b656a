// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "optimizer/walk/doors.h"

namespace standpoint {

// A part of a door that turns about an upright axis.
struct DoorLeaf {
  std::uint32_t door = 0;  // index into DoorLeaves::doors
  Eigen::Vector3d hinge = Eigen::Vector3d::Zero();
  double turn = 1;  // of a leaf that opens towards Passage::through: 1 is anticlockwise, seen from above
};

struct LeavedDoor {
  std::uint32_t product = 0;
  Passage passage;
};

// All doors of a model that have leaves, cut into what turns and what stands still.
struct DoorLeaves {
  std::vector<LeavedDoor> doors;
  std::vector<DoorLeaf> leaves;
  Environment scene;                           // these doors alone, closed; the products keep their indices
  std::vector<std::int32_t> leaf_of_instance;  // of the scene; -1: stands still
};

// A leaf is what of a door's own mesh is neither its frame, a post, a threshold nor a light above it. Of one leaf the
// hinge is across from the handle, of two each has its own at the side of the opening.
DoorLeaves doorLeaves(const Environment& environment);

// The scene with each door opened: from -1 to 1, that is by up to a quarter of a turn, towards Passage::through where
// it is positive.
Environment swung(const DoorLeaves& leaves, std::span<const double> opened);

}  // namespace standpoint
