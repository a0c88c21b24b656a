// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/environment.h"
#include "core/physical_material.h"
#include "scanners/engine/ray_engine.h"

namespace standpoint {

// How far a material goes that is put on a surface, as the verb `materials` takes it.
struct MaterialScope {
  std::string title;  // "All walls of type 'Ext 36'"
  std::string selector;
  std::size_t products = 0;
};

// From the narrowest to the widest: the face that was hit, as far as it reaches, all that look its way, the product,
// what is made of the same material of the model, its type, its class, its storey's part of that. Scopes that mean no
// more than a narrower one are left out.
std::vector<MaterialScope> materialScopes(const Environment& environment, const RayHit& hit,
                                          const Eigen::Vector3d& shift_m);

// What the face that was hit is made of; null where it is not assigned.
const PhysicalMaterial* materialAt(const Environment& environment, const MaterialAssignment& assignment,
                                   const RayHit& hit);

// "#12" where the model's ids are numbers, else the GlobalId: what selectors understand.
std::string selectorOf(const Product& product);

}  // namespace standpoint
