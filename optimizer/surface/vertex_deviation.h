// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "core/environment.h"
#include "core/progress.h"
#include "core/result.h"

namespace standpoint {

// How far one placed mesh is from the other environment, for a colour map (distance_m at each vertex) and a histogram
// (distance_m, each value counted with its area_m2).
struct InstanceDeviation {
  std::vector<float> distance_m;  // one for each position of the instance's mesh, in world metres, never negative
  std::vector<float>
      area_m2;  // a third of the triangles around the position, as placed; they sum to the instance's area
};

// The picture of a loss: for each instance of `from` (same index), how far each vertex is from the surfaces that the
// same product has in `to`; where the product has none there (it was dropped), from whatever of `to` is nearest. Call
// it both ways: (original, lighter) shows what was lost, also where a lighter surface has no vertex; (lighter,
// original) shows where what is left stands off. Products are matched by index. A mesh that is the same object at the
// same place in both is 0 throughout. Where `to` has no triangle at all, every distance is infinite. Copies that stand
// alike share one result. Parallel, the same values for any number of threads; about 1 µs a vertex of each distinct
// mesh and thread, plus the trees (about 150 bytes a triangle of each distinct mesh of `to` while it runs).
Result<std::vector<std::shared_ptr<const InstanceDeviation>>> vertexDeviation(const Environment& from,
                                                                              const Environment& to,
                                                                              Progress& progress);

}  // namespace standpoint
