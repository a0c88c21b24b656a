// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "core/physical_material.h"

namespace standpoint {

// A material on its way from a list to a surface.
void dragMaterial(const PhysicalMaterial& material);  // after the list's item
std::optional<std::string> droppedMaterial();         // its id; after the item that takes it

}  // namespace standpoint
