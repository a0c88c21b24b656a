// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/progress.h"
#include "optimizer/simplify/collapses/collapser.h"

namespace standpoint {

// A patch, and what its vertices are called in the shape that it is a part of.
struct Region {
  Patch patch;
  std::vector<std::uint32_t> names;
};

Region wholeRegion(Patch patch);

// One round of simplification in cells that work side by side, until `enough` triangles are left. Each cell goes
// further than all do together, so that the cheapest steps of all can be chosen. Which cells, and so which steps,
// depends on the region and `cut` only.
struct Round {
  double cut = 0.5;        // where cells meet (partition.h): another one than in the round before
  double fraction = 0.25;  // of the triangles, that is left; all but nothing where the cells are parts of their own …
  std::size_t enough = 0;  // … but no less than these
};

// The steps, cheapest first, named as in the shape, are appended to `log`, and the region becomes what they leave.
void runRound(Region& region, const Round& round, const CollapseOptions& options, const Shape& shape,
              std::vector<Collapse>& log, const Progress& progress);

}  // namespace standpoint
