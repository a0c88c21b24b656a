// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"

namespace standpoint {

enum class LooksOfSplit { kept, left_out };

// Gives all these environments, which share products and surfaces, one list of surfaces with an entry for each pair of
// a look and a physical material that occurs; without looks, for each material. Meshes are shared as long as their
// surfaces are made of the same. Answers each new surface's index into assignment.materials, -1 where nothing is
// assigned.
std::vector<std::int32_t> splitByMaterial(std::span<Environment* const> environments,
                                          const MaterialAssignment& assignment, LooksOfSplit looks);

}  // namespace standpoint
