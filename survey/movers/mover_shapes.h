// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/mesh.h"
#include "core/motion/limbs.h"

namespace standpoint {

// A limb of somebody of 1.75 m at rest (core/motion/limbs.h); all triangles of surface 0. Sizes are not sourced.
Mesh limbMesh(Limb limb);

// A passenger car of 4.5 m by 1.8 m by 1.45 m on four wheels, that looks along x, its middle on the ground at the
// origin. Sizes are not sourced.
Mesh vehicleMesh();

}  // namespace standpoint
