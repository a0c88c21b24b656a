// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "optimizer/optimizer.h"

namespace standpoint {

inline constexpr double kStepHeight = 0.25;  // m that an agent climbs: a stair's riser is at most about 0.2 (DIN 18065)
inline constexpr double kSteepestSlopeDeg = 45;

struct Walkable {
  double area_m2 = 0;  // where the agent's axis may stand: its radius away from walls and ledges
  double cell_m = 0;   // of the grid that it was found on
  Mesh mesh;
  std::vector<std::uint32_t> island_of_triangle;  // triangles of one island can be walked to from each other
};

// By Recast's voxels over the collision shapes, of which convex ones are solid. Islands smaller than the agent do not
// count. `overhead`: for each product whether it is a roof or a ceiling, which nobody walks on; empty: none is.
Result<Walkable> walkableSurface(const std::vector<CollisionShape>& shapes, const std::vector<bool>& overhead,
                                 const CollideOptions& options, Progress& progress);

}  // namespace standpoint
