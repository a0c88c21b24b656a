// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// The items that stand directly in a representation, placed by the mapped items on the way to it.
struct Part {
  Id representation = 0;
  Eigen::Affine3d product_from_items = Eigen::Affine3d::Identity();
  std::uint32_t style = 0;  // of the mapped item, for items without one of their own
};

// What a product is made of: its body, or what 3D representation comes nearest to one. Empty when it has none. A
// reference to nothing on the way is noted as Scope::misread.
Result<std::vector<Part>> partsOfShape(const Entity& product_definition_shape, Scope& scope);
// The body among an IfcTypeProduct's representation maps.
Result<std::vector<Part>> partsOfType(const Entity& type_product, Scope& scope);

// "IFCSPHERICALSURFACE" where only that keeps a product from having a body; empty: there is nothing like a body.
std::string unreadBodyOf(const Entity& product_definition_shape, const Model& model);

// The direct items of a representation in metres, one mesh each, faces tagged with their style.
struct Items {
  std::vector<geometry::PolyMesh> meshes;
  Report report;
  Repairs repairs;
};
Items itemsOf(const Entity& representation, const Model& model);

}  // namespace standpoint::ifc
