// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/environment.h"
#include "importers/ifc/model/model.h"
#include "importers/ifc/model/relations.h"

namespace standpoint::ifc {

// How the layers stand in the product's frame (IfcMaterialLayerSetUsage): they follow each other from `offset_m` on the
// axis, in the direction of `sense`.
struct LayerUsage {
  int axis = 1;         // 0 x, 1 y (walls), 2 z (slabs); y and x are meant across the reference line where there is one
  double sense = 1;     // +1 or −1
  double offset_m = 0;  // of the set's first face from the reference line or plane, along +axis whatever the sense
};

struct ProductMaterials {
  std::vector<std::string> names;                        // in the file's order, each once
  std::vector<Id> ids;                                   // of the IfcMaterials, in step with `names`
  std::vector<std::pair<std::string, Id>> constituents;  // their names and IfcMaterials
  std::vector<MaterialLayer> layers;
  std::vector<Id> material_of_layer;  // in step with `layers`; 0: a layer of air
  std::optional<LayerUsage> usage;
  bool layered = false;  // the first name is the surface's where nothing says more
  Id definition = 0;     // what the file associates: IfcMaterial, IfcMaterialLayerSetUsage, …
};

// From the occurrence, else from its type.
ProductMaterials materialsOf(const Entity& product, const Relations& relations, const Model& model);
// What the file says of them beyond names and thicknesses: sets, usages, constituents, profiles (set "Material"), and
// the materials' own property sets (set "Brick/Pset_MaterialCommon").
void appendMaterialProperties(std::vector<Property>& out, const ProductMaterials& materials, const Relations& relations,
                              const Model& model);

// IfcMaterial → the surface style of its IfcMaterialDefinitionRepresentation.
std::map<Id, Id> stylesOfMaterials(const StepFile& file);

// The set of properties by which a material says which physical material it is (PhysicalMaterial::id, in "Id"): our own
// files have it. By the style that such a material is shown with.
constexpr const char* kPhysicalMaterialSet = "Standpoint_PhysicalMaterial";
std::map<Id, std::string> physicalMaterialsOfStyles(const StepFile& file);

}  // namespace standpoint::ifc
