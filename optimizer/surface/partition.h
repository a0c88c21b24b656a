// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/mesh.h"

namespace standpoint {

// Triangles in cells that can be simplified side by side. A part that hangs together is split only where it has more
// than `most` triangles, at planes; where such cells meet, their common vertices are shared.
struct Partition {
  std::vector<std::vector<std::uint32_t>> cells;  // triangle indices, near ones close to each other
  std::vector<std::uint8_t> shared;               // for each vertex: whether several cells have it
  bool any_shared = false;
};

// `cut` moves the planes: the share of a cell that lies before them, so that two partitions do not meet at the same
// places. Depends on its arguments only, never on the number of threads.
Partition partition(std::span<const Eigen::Vector3d> positions, std::span<const Triangle> triangles, std::size_t most,
                    double cut);

}  // namespace standpoint
