// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "optimizer/simplify/collapses/collapser.h"

namespace standpoint {

// A shape with the planes that hold it: each triangle's own, and an upright one along each edge that shows: borders of
// the mesh, between surfaces, of a texture's charts, and creases of 30° or more. Without loss the latter are bounds,
// too; memoryless they are all there is.
Patch patchOf(const Shape& shape, const CollapseOptions& options);

}  // namespace standpoint
