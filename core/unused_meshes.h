// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"

namespace standpoint {

// Lets go of the meshes that no instance shows; the others keep their order.
void dropUnusedMeshes(Environment& environment);

}  // namespace standpoint
