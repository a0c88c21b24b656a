// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/environment.h"
#include "importers/ifc/material.h"
#include "importers/ifc/model/model.h"
#include "importers/ifc/model/relations.h"

namespace standpoint::ifc {

// The records that become products, in the order of their numbers. With `types` those types, too, that bring a shape
// and that no product with a shape or a place is of.
std::vector<Entity> productEntities(const StepFile& file, const Relations& relations, bool types);
bool isType(const Entity& entity);
std::string nameOf(const Entity& product);  // "IfcWall 2O2Fr$t4X7Zf8NOew3FLOH", for messages
// A loss for each place and product that is a part of itself by way of others.
void tellCircles(const Relations& relations, const StepFile& file, Report& report);
// Of a file in which no product has a body: a loss where types, or solids that belong to no product, do.
void tellUnplacedBodies(const Relations& relations, const Model& model, Report& report);
// What a record says of itself: names, class, type, materials, properties. Links are filled by linkProducts.
Product describeProduct(const Entity& entity, bool with_properties, const Relations& relations, const Model& model);
// The tree of project, sites, buildings, storeys and spaces, parents first.
std::vector<SpatialNode> spatialTree(const Model& model, const Relations& relations, Report& report);
// Container, storey and whole of each product.
void linkProducts(std::vector<Product>& products, const std::vector<Entity>& entities,
                  const std::vector<SpatialNode>& spatial, const Relations& relations, const StepFile& file);

}  // namespace standpoint::ifc
