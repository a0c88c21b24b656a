// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/material.h"

#include <algorithm>

#include "importers/ifc/model/style.h"
#include "importers/ifc/properties.h"
#include "importers/ifc/property_value.h"

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
    found.material_of_layer.push_back(material.id());
    found.layers.push_back(
        {material ? material[0].text() : layer[3].text(), layer[1].number(0) * model.units.length_m});
  }
}

// Lists, constituents and profiles: sets whose members name a material.
void addMembers(ProductMaterials& found, const Entity& set, std::size_t list, std::size_t material) {
  for (const Entity& member : set.refs(list))
    addMaterial(found, member.is("IFCMATERIAL") ? member : member.ref(material));
}

LayerUsage usageOf(const Entity& e, const Model& model) {
  const std::string_view axis = e[1].symbol();
  return {axis == "AXIS1"   ? 0
          : axis == "AXIS3" ? 2
                            : 1,
          e[2].symbol() == "NEGATIVE" ? -1.0 : 1.0, e[3].number(0) * model.units.length_m};
}

void add(ProductMaterials& found, Entity m, const Model& model) {
  found.definition = m.id();
  if (m.is("IFCMATERIALLAYERSETUSAGE")) found.usage = usageOf(m, model);
  if (m.is("IFCMATERIALLAYERSETUSAGE") || m.is("IFCMATERIALPROFILESETUSAGE") ||
      m.is("IFCMATERIALPROFILESETUSAGETAPERING"))
    m = m.ref(0);
  if (m.is("IFCMATERIALCONSTITUENTSET"))
    for (const Entity& constituent : m.refs(2))
      found.constituents.emplace_back(constituent[0].text(), constituent.ref(2).id());
  if (m.is("IFCMATERIAL"))
    addMaterial(found, m);
  else if (m.is("IFCMATERIALLIST"))
    addMembers(found, m, 0, 0);
  else if (m.is("IFCMATERIALLAYERSET"))
    addLayers(found, m, model);
  else if (m.is("IFCMATERIALCONSTITUENTSET") || m.is("IFCMATERIALPROFILESET"))
    addMembers(found, m, 2, 2);
  else if (m.is("IFCMATERIALCONSTITUENT") || m.is("IFCMATERIALPROFILE"))
    addMaterial(found, m.ref(2));
  else if (m.is("IFCMATERIALLAYER"))
    addMaterial(found, m.ref(0));
}

}  // namespace

ProductMaterials materialsOf(const Entity& product, const Relations& relations, const Model& model) {
  ProductMaterials found;
  const StepFile& file = model.file;
  add(found, file.entity(relations.materialOf(product)), model);
  if (found.names.empty() && found.layers.empty())
    add(found, file.entity(relations.materialOf(file.entity(relations.typeOf(product)))), model);
  return found;
}

namespace {

void tell(std::vector<Property>& out, const std::string& name, const std::string& value) {
  if (!value.empty()) out.push_back({"Material", name, value});
}

// "Oak, Frame, 0.3": the material, what the constituent is for, its share.
void tellMembers(std::vector<Property>& out, const Entity& set, const char* kind, const Model& model) {
  tell(out, std::string(kind) + "Set", set[0].text());
  const bool constituents = set.is("IFCMATERIALCONSTITUENTSET");
  for (const Entity& member : set.refs(2)) {
    std::string value = member.ref(2)[0].text();
    if (!constituents && member.ref(3)) value += (value.empty() ? "" : ", ") + member.ref(3)[1].text();
    for (const std::size_t more : {constituents ? 4U : 5U, 3U})
      if (const Value v = member[more]; v.present() && !v.isReference())
        value += (value.empty() ? "" : ", ") + valueText(v, {}, model);
    const std::string name = member[0].text();
    tell(out, name.empty() ? kind : name, value);
  }
}

void tellDefinition(std::vector<Property>& out, const Entity& m, const Model& model) {
  if (m.is("IFCMATERIAL")) return tell(out, "Category", m[2].text()), tell(out, "Description", m[1].text());
  if (m.is("IFCMATERIALCONSTITUENTSET")) return tellMembers(out, m, "Constituent", model);
  if (m.is("IFCMATERIALPROFILESET")) return tellMembers(out, m, "Profile", model);
  if (m.is("IFCMATERIALLAYERSET")) return tell(out, "LayerSet", m[1].text());
  if (m.is("IFCMATERIALLAYERSETUSAGE")) {
    tellDefinition(out, m.ref(0).is("IFCMATERIALLAYERSET") ? m.ref(0) : Entity(), model);
    tell(out, "LayerSetDirection", std::string(m[1].symbol()));
    tell(out, "DirectionSense", std::string(m[2].symbol()));
    tell(out, "OffsetFromReferenceLine", valueText(m[3], {}, model, "IFCLENGTHMEASURE"));
  } else if (m.is("IFCMATERIALPROFILESETUSAGE") || m.is("IFCMATERIALPROFILESETUSAGETAPERING")) {
    tellDefinition(out, m.ref(0).is("IFCMATERIALPROFILESET") ? m.ref(0) : Entity(), model);
    tell(out, "CardinalPoint", valueText(m[1], {}, model));
  }
}

}  // namespace

void appendMaterialProperties(std::vector<Property>& out, const ProductMaterials& materials, const Relations& relations,
                              const Model& model) {
  tellDefinition(out, model.file.entity(materials.definition), model);
  for (std::size_t i = 0; i < materials.ids.size(); ++i)
    for (const Id set : relations.propertiesOfMaterial(model.file.entity(materials.ids[i])))
      appendProperties(out, model.file.entity(set), model, materials.names[i] + "/");
}

std::map<Id, Id> stylesOfMaterials(const StepFile& file) {
  std::map<Id, Id> styles;
  for (const Entity& definition : file.all("IFCMATERIALDEFINITIONREPRESENTATION"))
    for (const Entity& representation : definition.refs(2))
      for (const Entity& item : representation.refs(3))
        if (const Id style = item.is("IFCSTYLEDITEM") ? surfaceStyleOf(item) : 0)
          styles.emplace(definition[3].reference(), style);
  return styles;
}

std::map<Id, std::string> physicalMaterialsOfStyles(const StepFile& file) {
  std::map<Id, std::string> of_material;
  for (const Entity& set : file.all("IFCMATERIALPROPERTIES"))
    if (set[0].text() == kPhysicalMaterialSet)
      for (const Entity& property : set.refs(2))
        if (property.is("IFCPROPERTYSINGLEVALUE") && property[0].text() == "Id")
          of_material.emplace(set[3].reference(), property[2].inner().text());
  std::map<Id, std::string> of_style;
  if (of_material.empty()) return of_style;
  for (const Entity& definition : file.all("IFCMATERIALDEFINITIONREPRESENTATION")) {
    const auto known = of_material.find(definition[3].reference());
    if (known == of_material.end()) continue;
    for (const Entity& representation : definition.refs(2))
      for (const Entity& item : representation.refs(3))
        if (const Id style = item.is("IFCSTYLEDITEM") ? surfaceStyleOf(item) : 0)
          of_style.emplace(style, known->second);
  }
  return of_style;
}

}  // namespace standpoint::ifc
