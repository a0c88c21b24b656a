// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/mesh.h"
#include "optimizer/simplify/collapses/collapse.h"
#include "optimizer/surface/shape.h"

namespace standpoint {

// What replay() makes of a painted mesh, with its texture coordinates and colours: each corner carries its own, so that
// the two sides of a seam stay apart. With every step, a corner that moves takes the paint that the surface had where
// it is nearest to the new place, on its own side of the seam. `shape` is weld(before).
Mesh transferAttributes(const Mesh& before, const Shape& shape, const std::vector<Collapse>& steps);

}  // namespace standpoint
