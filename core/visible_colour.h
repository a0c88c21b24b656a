// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/environment.h"
#include "core/physical_material.h"

namespace standpoint {

// About what a material looks like, by its reflectance in the visible: for lists, MTL files and pictures, not for
// physics. Our libraries begin in the green, so blue is a guess from green and red.
Colour visibleColour(const PhysicalMaterial& material);

}  // namespace standpoint
