// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/environment.h"
#include "importers/ifc/material.h"
#include "importers/ifc/model/model.h"
#include "importers/ifc/model/relations.h"

namespace standpoint::ifc {

// The records that become products, in the order of their numbers.
std::vector<Entity> productEntities(const StepFile& file);
// What a record says of itself: names, class, type, materials, properties. Links are filled by linkProducts.
Product describeProduct(const Entity& entity, bool with_properties, const Relations& relations, const Model& model);
// The tree of project, sites, buildings, storeys and spaces, parents first.
std::vector<SpatialNode> spatialTree(const Model& model, const Relations& relations, Report& report);
// Container, storey and whole of each product.
void linkProducts(std::vector<Product>& products, const std::vector<Entity>& entities,
                  const std::vector<SpatialNode>& spatial, const Relations& relations, const StepFile& file);

}  // namespace standpoint::ifc
