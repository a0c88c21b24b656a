// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/environment.h"
#include "optimizer/walk/spaces.h"

namespace standpoint {

// An IfcSpace as the plan names it.
struct RoomLabel {
  std::uint32_t product = 0;
  std::string number;        // IfcSpace.Name, which is a number more often than not; may be empty
  std::string name;          // IfcSpace.LongName, else Name
  Eigen::Vector3d anchor;    // within the room, as far from its walls as can be, a metre above its floor; local frame
  double floor_area_m2 = 0;  // of its bounding box
};

// Of all spaces that have geometry and are not excluded, the largest first.
std::vector<RoomLabel> roomLabels(const Environment& environment);

// A stair with all its flights, as whoever walks is told of it.
struct StairLabel {
  std::uint32_t product = 0;
  Bounds box;  // local frame
};
// Those that lead up by half a storey or more.
std::vector<StairLabel> stairLabels(const Environment& environment);

// Those of one environment, made when first asked for.
class RoomLabels {
 public:
  const std::vector<RoomLabel>& of(const std::shared_ptr<const Environment>& environment) const;
  const std::vector<StairLabel>& stairsOf(const std::shared_ptr<const Environment>& environment) const;
  // The room that the place is in, or that begins within half a metre of it, as at its walls and its floor; null: none.
  const SpaceBody* roomAt(const std::shared_ptr<const Environment>& environment, const Eigen::Vector3d& place) const;

 private:
  void follow(const std::shared_ptr<const Environment>& environment) const;
  mutable std::shared_ptr<const Environment> environment_;
  mutable std::vector<RoomLabel> labels_;
  mutable std::vector<StairLabel> stairs_;
  mutable std::vector<SpaceBody> spaces_;
};

}  // namespace standpoint
