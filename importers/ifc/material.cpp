// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/material.h"

#include <algorithm>

#include "importers/ifc/style.h"

namespace standpoint::ifc {
namespace {

void addMaterial(ProductMaterials& found, const Entity& material) {
  const std::string name = material[0].text();
  if (!material || std::find(found.names.begin(), found.names.end(), name) != found.names.end()) return;
  found.names.push_back(name);
  found.ids.push_back(material.id());
}

void addLayers(ProductMaterials& found, const Entity& layer_set, const Model& model) {
  found.layered = true;
  for (const Entity& layer : layer_set.refs(0)) {
    const Entity material = layer.ref(0);
    addMaterial(found, material);
    found.layers.push_back({material ? material[0].text() : layer[3].text(), layer[1].number(0) * model.units.length_m});
  }
}

// Lists, constituents and profiles: sets whose members name a material.
void addMembers(ProductMaterials& found, const Entity& set, std::size_t list, std::size_t material) {
  for (const Entity& member : set.refs(list)) addMaterial(found, member.is("IFCMATERIAL") ? member : member.ref(material));
}

void add(ProductMaterials& found, Entity m, const Model& model) {
  if (m.is("IFCMATERIALLAYERSETUSAGE") || m.is("IFCMATERIALPROFILESETUSAGE") || m.is("IFCMATERIALPROFILESETUSAGETAPERING")) m = m.ref(0);
  if (m.is("IFCMATERIAL")) addMaterial(found, m);
  else if (m.is("IFCMATERIALLIST")) addMembers(found, m, 0, 0);
  else if (m.is("IFCMATERIALLAYERSET")) addLayers(found, m, model);
  else if (m.is("IFCMATERIALCONSTITUENTSET") || m.is("IFCMATERIALPROFILESET")) addMembers(found, m, 2, 2);
  else if (m.is("IFCMATERIALCONSTITUENT") || m.is("IFCMATERIALPROFILE")) addMaterial(found, m.ref(2));
  else if (m.is("IFCMATERIALLAYER")) addMaterial(found, m.ref(0));
}

}  // namespace

ProductMaterials materialsOf(const Entity& product, const Relations& relations, const Model& model) {
  ProductMaterials found;
  const StepFile& file = model.file;
  add(found, file.entity(relations.materialOf(product)), model);
  if (found.names.empty() && found.layers.empty()) add(found, file.entity(relations.materialOf(file.entity(relations.typeOf(product)))), model);
  return found;
}

std::map<Id, Id> stylesOfMaterials(const StepFile& file) {
  std::map<Id, Id> styles;
  for (const Entity& definition : file.all("IFCMATERIALDEFINITIONREPRESENTATION"))
    for (const Entity& representation : definition.refs(2))
      for (const Entity& item : representation.refs(3))
        if (const Id style = item.is("IFCSTYLEDITEM") ? surfaceStyleOf(item) : 0) styles.emplace(definition[3].reference(), style);
  return styles;
}

}  // namespace standpoint::ifc
