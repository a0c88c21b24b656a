// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "optimizer/optimizer.h"
#include "optimizer/walk/obstacles.h"

namespace standpoint {

// Where a door stands and which way leads through it.
struct Passage {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // on its lower edge
  Eigen::Vector3d through = Eigen::Vector3d::UnitX(), across = Eigen::Vector3d::UnitY();
  double half_depth = 0, half_width = 0, height = 0;  // of all that belongs to it
};

// Nothing when the product has no geometry.
std::optional<Passage> passageOf(const Environment& environment, std::uint32_t product);

// Of the feet of an agent that comes straight through, level with the higher floor.
struct FreeWay {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();
};

// The one nearest to the door's middle; nothing where none is free.
std::optional<FreeWay> freeWay(const Environment& environment, const Obstacles& obstacles, const Passage& passage,
                               const CollideOptions& options);

// On how many of its sides there is a floor at the door's lower edge, 0 to 2; a suspended ceiling is none.
int floorSides(const Environment& environment, const Obstacles& obstacles, const Passage& passage,
               const CollideOptions& options);

// For each product the door that it is, or is a part of; -1 for all else.
std::vector<std::int32_t> doorOf(const Environment& environment);

// For each product whether it is a door that stands closed, or a part of one.
std::vector<bool> closedDoors(const Environment& environment, const CollideOptions& options);

// A plate across the door, as thick as a leaf.
CollisionShape doorPlate(const Passage& passage, std::uint32_t product);

// The doors that the agent still passes although they are closed get a plate across, as many have no leaf that closes
// them: it is drawn open, or as a line.
void closeWhatIsOpen(const Environment& environment, const CollideOptions& options, std::vector<CollisionShape>& shapes,
                     Report& report);

// Looks for a floor on both sides of each door and moves the agent's capsule through it, straight and with small
// offsets, between the obstacles. What is wrong goes to the report.
std::vector<Door> checkDoors(const Environment& environment, const std::vector<CollisionShape>& shapes,
                             const CollideOptions& options, Report& report);

}  // namespace standpoint
