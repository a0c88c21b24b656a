// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "core/environment.h"
#include "core/progress.h"
#include "optimizer/optimizer.h"

namespace standpoint {

// What can be seen of an environment, by rays with seeded directions: the same answers on any machine, any number of
// threads. Every surface blocks, glass too: what stands behind a window is inside.

// For each product the share of rays from points on its surface towards the sky that get there, 0..1. What no beam
// meets, and what has no surface, has 1: nothing is said against it.
std::vector<double> skyFractions(const Environment& environment, const Progress& progress);

// For each product how much more than on average one sees of it from the walkable surface, per area: hits of rays in
// all directions from eye height, 1.6 m. 0 is never seen, 1 as much as the average.
std::vector<double> walkersView(const Environment& environment, const Mesh& walkable, const Progress& progress);

// Multiplies the weights of all products by what walkersView() says: by its root, between 0.1 and 10, so that error
// goes where nobody looks. Needs an allowance for each product; makes them from the options where there are none.
void weighByView(OptimizeOptions& options, const Environment& environment, const Mesh& walkable,
                 const Progress& progress);

// For each mesh and triangle whether it is hidden in every place where it stands: from neither side of any of its
// points does one of 96 rays run 0.6 m freely (contact faces, the inside of walls, small cavities). An empty list for a
// mesh of which all can be seen.
std::vector<std::vector<bool>> hiddenTriangles(const Environment& environment, const Progress& progress);

}  // namespace standpoint
