// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/environment.h"
#include "core/progress.h"
#include "optimizer/surface/deviation.h"
#include "optimizer/surface/placed_surfaces.h"

namespace standpoint {

// What is known beforehand.
struct KnownOfScene {
  std::vector<PlacedSurfaces::Known> meshes;  // trees over those of `before`, where there are some
  std::vector<double> max_before_m,
      max_after_m;  // for each instance: no point of it is further away; infinite: who knows
};

// How far two environments are apart as a whole, whichever product a surface belongs to: sampled by area both ways, the
// maximum also at the vertices. What was dropped counts with its distance from what is left. A mesh that is the same
// object at the same place in both counts 0 without a look. Parallel, the same figures for any number of threads.
Deviation sceneDeviation(const Environment& before, const Environment& after, std::uint32_t samples,
                         const KnownOfScene& known, const Progress& progress);

}  // namespace standpoint
