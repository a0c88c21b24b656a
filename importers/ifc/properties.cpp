// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/properties.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "core/presentation_layers.h"
#include "importers/ifc/model/attribute_sets.h"
#include "importers/ifc/model/entities.h"
#include "importers/ifc/product.h"
#include "importers/ifc/property_value.h"

namespace standpoint::ifc {
namespace {

using Properties = std::vector<Property>;

void add(Properties& out, const char* set, const char* name, std::string value) {
  if (!value.empty()) out.push_back({set, name, std::move(value)});
}

void appendProperty(Properties& out, const std::string& set, const Entity& p, const Model& model, int depth) {
  if (out.size() >= kMostProperties) return;
  const std::string_view kind = p.typeName();
  const bool complex = kind == "IFCCOMPLEXPROPERTY";
  if (!complex && kind != "IFCPHYSICALCOMPLEXQUANTITY") {
    if (p) out.push_back({set, p[0].text(), propertyText(p, model), propertyType(p)});
    return;
  }
  if (depth >= kDeepestProperty) return;  // properties that hold each other
  for (const Entity& part : p.refs(complex ? 3 : 2)) {
    if (out.size() >= kMostProperties) return;
    appendProperty(out, set + std::string(kWithinProperty) + p[0].text(), part, model, depth + 1);
  }
}

void appendAttributeSet(Properties& out, const Entity& e, const AttributeSet& set, const Model& model,
                        const std::string& prefix) {
  const std::string own =
      e[0].isText() ? e[2].text() : std::string();  // of a material's set attribute 0 is the material
  const std::string name = prefix + (own.empty() ? schemaSpelling(e.typeName()) : own);
  for (const SetAttribute& a : set.attributes)
    if (std::string text = valueText(e[static_cast<std::size_t>(a.index)], {}, model, a.measure); !text.empty())
      out.push_back({name, a.name, std::move(text)});
}

void appendAttributes(Properties& out, const Entity& e, const Model& model) {
  const EntityName* name = entityName(e.typeName());
  const auto a = e.first<12>();
  add(out, "Attributes", "Description", a[3].text());
  const bool type = name && name->kind == EntityKind::type;
  if (a[4].isText()) add(out, "Attributes", type ? "ApplicableOccurrence" : "ObjectType", a[4].text());
  if (!name) return;
  if (name->kind == EntityKind::project) {
    add(out, "Attributes", "LongName", a[5].text());
    add(out, "Attributes", "Phase", a[6].text());
  } else if (name->kind == EntityKind::spatial || name->kind == EntityKind::space) {
    if (a[7].isText()) add(out, "Attributes", "LongName", a[7].text());
  } else if (name->kind == EntityKind::product && a[7].isText()) {
    add(out, "Attributes", "Tag", a[7].text());
  }
  const std::string_view kind = e.typeName();
  if (kind.starts_with("IFCDOOR") || kind.starts_with("IFCWINDOW")) {
    add(out, "Attributes", "OverallHeight", valueText(a[8], {}, model, "IFCLENGTHMEASURE"));
    add(out, "Attributes", "OverallWidth", valueText(a[9], {}, model, "IFCLENGTHMEASURE"));
  } else if (kind == "IFCBUILDINGSTOREY") {
    add(out, "Attributes", "Elevation", valueText(a[9], {}, model, "IFCLENGTHMEASURE"));
  } else if (kind == "IFCBUILDING" || kind == "IFCSITE") {
    const Entity address = kind == "IFCSITE" ? e.ref(13) : e.ref(11);
    add(out, "Attributes", "Address", address ? referenceText(address) : std::string());
  }
}

// "Ss_25_10 Walls" under the name of the system that it belongs to.
void appendClassification(Properties& out, const Entity& reference) {
  std::string text;
  Entity system = reference;
  if (reference.is("IFCCLASSIFICATIONREFERENCE")) {
    text = reference[1].text();
    const std::string title = reference[2].text();
    if (!title.empty() && title != text) text += (text.empty() ? "" : " ") + title;
    if (text.empty()) text = reference[0].text();
    for (int steps = 0; system.is("IFCCLASSIFICATIONREFERENCE") && steps < 32; ++steps) system = system.ref(3);
  } else if (reference.is("IFCCLASSIFICATIONNOTATION")) {  // IFC2X3: the code in pieces
    for (const Entity& facet : reference.refs(0)) text += facet[0].text();
    system = {};
  }
  const std::string name = system.is("IFCCLASSIFICATION") ? system[3].text() : std::string();
  out.push_back({"Classification", name.empty() ? "Reference" : name, text});
}

void appendAssociations(Properties& out, const Entity& object, const Relations& relations, const Model& model) {
  for (const Id id : relations.classificationsOf(object)) appendClassification(out, model.file.entity(id));
  for (const Id id : relations.documentsOf(object))
    add(out, "Document", "Reference", referenceText(model.file.entity(id)));
}

// Of the object's representations, of their items, and of what is mapped there.
class LayerNames {
 public:
  explicit LayerNames(const Relations& relations) : relations_(relations) {}
  void look(const Entity& representation, int depth = 0) {
    add(representation);
    for (const Entity& item : representation.refs(3)) {
      if (--left_ < 0) return;
      add(item);
      if (item.is("IFCMAPPEDITEM") && depth < 4) look(item.ref(0).ref(1), depth + 1);
    }
  }
  const std::vector<Id>& ids() const { return ids_; }

 private:
  void add(const Entity& e) {
    if (const Id layer = relations_.presentationLayerOf(e);
        layer && std::find(ids_.begin(), ids_.end(), layer) == ids_.end())
      ids_.push_back(layer);
  }
  const Relations& relations_;
  std::vector<Id> ids_;
  int left_ = 1000;  // items that a thousand products share are not walked a thousand times to the end
};

void appendPresentationLayers(Properties& out, const Entity& object, const Relations& relations, const Model& model) {
  if (!relations.hasPresentationLayers()) return;
  LayerNames names(relations);
  for (const Entity& representation : object.ref(6).refs(2)) names.look(representation);
  for (const Id id : names.ids()) add(out, kPresentationLayer, "Name", model.file.entity(id)[0].text());
}

Properties propertiesOfType(const Entity& type, const Relations& relations, const Model& model) {
  Properties found;
  for (const Entity& set : type.refs(5)) appendProperties(found, set, model);
  for (const Id set : relations.propertySetsOf(type)) appendProperties(found, model.file.entity(set), model);
  appendAssociations(found, type, relations, model);
  return found;
}

}  // namespace

void appendProperties(Properties& properties, const Entity& set, const Model& model, const std::string& prefix) {
  if (const AttributeSet* attributes = attributeSet(set.typeName()))
    return appendAttributeSet(properties, set, *attributes, model, prefix);
  const std::string_view kind = set.typeName();
  const bool of_material = kind == "IFCMATERIALPROPERTIES";       // (Name, Description, Properties, Material)
  const bool extended = kind == "IFCEXTENDEDMATERIALPROPERTIES";  // IFC2X3: (Material, Properties, Description, Name)
  const bool quantities = kind == "IFCELEMENTQUANTITY";
  if (!of_material && !extended && !quantities && kind != "IFCPROPERTYSET") return;
  std::string name = set[of_material ? 0 : extended ? 3 : 2].text();
  name = prefix + (name.empty() ? schemaSpelling(kind) : name);
  for (const Entity& p : set.refs(of_material ? 2 : extended ? 1 : quantities ? 5 : 4))
    appendProperty(properties, name, p, model, 0);
}

Properties propertiesOf(const Entity& object, const Relations& relations, const Model& model) {
  Properties properties;
  appendAttributes(properties, object, model);
  if (isType(object))  // imported as a product
    for (const Entity& set : object.refs(5)) appendProperties(properties, set, model);
  for (const Id set : relations.propertySetsOf(object)) appendProperties(properties, model.file.entity(set), model);
  appendAssociations(properties, object, relations, model);
  if (const Entity type = model.file.entity(relations.typeOf(object))) {
    std::set<std::pair<std::string, std::string>> own;
    for (const Property& p : properties) own.emplace(p.set, p.name);
    for (Property& p : propertiesOfType(type, relations, model))
      if (!own.contains({p.set, p.name})) properties.push_back(std::move(p));
  }
  if (properties.size() > kMostProperties) properties.resize(kMostProperties);
  appendPresentationLayers(properties, object, relations, model);  // selectors ask for them: they are not cut
  return properties;
}

}  // namespace standpoint::ifc
