// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"
#include "core/progress.h"
#include "optimizer/deviation.h"
#include "optimizer/placed_surfaces.h"

namespace standpoint {

// How far two environments are apart as a whole, whichever product a surface belongs to: sampled by area both ways, the maximum
// also at the vertices. What was dropped counts with its distance from what is left. A mesh that is the same object at the same place in
// both counts 0 without a look. Parallel, the same figures for any number of threads.
// `known` are trees over the meshes of `before`, where there are some (placed_surfaces.h).
Deviation sceneDeviation(const Environment& before, const Environment& after, std::uint32_t samples, const std::vector<PlacedSurfaces::Known>& known, const Progress& progress);

}  // namespace standpoint
