// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/environment.h"
#include "importers/ifc/model.h"
#include "importers/ifc/relations.h"

namespace standpoint::ifc {

struct ProductMaterials {
  std::vector<std::string> names;          // in the file's order, each once
  std::vector<Id> ids;                     // of the IfcMaterials, in step with `names`
  std::vector<MaterialLayer> layers;
  bool layered = false;                    // the first name is the surface's
};

// From the occurrence, else from its type.
ProductMaterials materialsOf(const Entity& product, const Relations& relations, const Model& model);

// IfcMaterial → the surface style of its IfcMaterialDefinitionRepresentation.
std::map<Id, Id> stylesOfMaterials(const StepFile& file);

}  // namespace standpoint::ifc
