// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/properties.h"

#include <algorithm>
#include <array>
#include <string>

#include "importers/ifc/units.h"

namespace standpoint::ifc {
namespace {

struct MeasureUnit {
  const char* measure;
  const char* unit;
};
constexpr std::array<MeasureUnit, 13> kMeasureUnits{{{"IFCLENGTHMEASURE", "LENGTHUNIT"},
                                                     {"IFCPOSITIVELENGTHMEASURE", "LENGTHUNIT"},
                                                     {"IFCNONNEGATIVELENGTHMEASURE", "LENGTHUNIT"},
                                                     {"IFCQUANTITYLENGTH", "LENGTHUNIT"},
                                                     {"IFCAREAMEASURE", "AREAUNIT"},
                                                     {"IFCQUANTITYAREA", "AREAUNIT"},
                                                     {"IFCVOLUMEMEASURE", "VOLUMEUNIT"},
                                                     {"IFCQUANTITYVOLUME", "VOLUMEUNIT"},
                                                     {"IFCPLANEANGLEMEASURE", "PLANEANGLEUNIT"},
                                                     {"IFCPOSITIVEPLANEANGLEMEASURE", "PLANEANGLEUNIT"},
                                                     {"IFCMASSMEASURE", "MASSUNIT"},
                                                     {"IFCQUANTITYWEIGHT", "MASSUNIT"},
                                                     {"IFCPOWERMEASURE", "POWERUNIT"}}};

std::string unitText(std::string_view measure, const Entity& own_unit, const Model& model) {
  if (own_unit) return unitSymbol(own_unit);
  for (const auto& [name, unit] : kMeasureUnits)
    if (measure == name) {
      const auto it = model.units.symbol_of_type.find(unit);
      return it == model.units.symbol_of_type.end() ? std::string() : it->second;
    }
  return {};
}

std::string valueText(const Value& value, const Entity& unit, const Model& model, std::string_view measure = {}) {
  if (!value.present()) return {};
  const Value inner = value.inner();
  if (inner.isText()) return inner.text();
  if (const auto symbol = inner.symbol(); !symbol.empty()) return symbol == "T" ? "true" : symbol == "F" ? "false" : symbol == "U" ? "unknown" : std::string(symbol);
  if (!inner.number()) return {};
  std::string text(inner.raw());
  while (!text.empty() && (text.back() == ' ' || text.back() == '\n' || text.back() == '\r')) text.pop_back();
  if (!text.empty() && text.back() == '.') text.pop_back();
  const std::string symbol = unitText(measure.empty() ? value.typeName() : measure, unit, model);
  return symbol.empty() ? text : text + ' ' + symbol;
}

std::string joined(const Value& list, const Entity& unit, const Model& model) {
  std::string text;
  for (const Value v : list) text += (text.empty() ? "" : ", ") + valueText(v, unit, model);
  return text;
}

void appendProperty(std::vector<Property>& out, const std::string& set, const Entity& p, const Model& model, int depth) {
  const std::string_view kind = p.typeName();
  const std::string name = p[0].text();
  if (kind == "IFCPROPERTYSINGLEVALUE") out.push_back({set, name, valueText(p[2], p.ref(3), model)});
  else if (kind == "IFCPROPERTYENUMERATEDVALUE") out.push_back({set, name, joined(p[2], {}, model)});
  else if (kind == "IFCPROPERTYLISTVALUE") out.push_back({set, name, joined(p[2], p.ref(3), model)});
  else if (kind == "IFCPROPERTYBOUNDEDVALUE")
    out.push_back({set, name, valueText(p[3], p.ref(4), model) + " … " + valueText(p[2], p.ref(4), model)});
  else if (kind.starts_with("IFCQUANTITY")) out.push_back({set, name, valueText(p[3], p.ref(2), model, kind)});
  else if ((kind == "IFCCOMPLEXPROPERTY" || kind == "IFCPHYSICALCOMPLEXQUANTITY") && depth < 8)
    for (const Entity& part : p.refs(kind == "IFCCOMPLEXPROPERTY" ? 3 : 2)) appendProperty(out, set + "/" + name, part, model, depth + 1);
}

}  // namespace

void appendProperties(std::vector<Property>& properties, const Entity& set, const Model& model) {
  if (set.is("IFCPROPERTYSETDEFINITIONSET")) return;
  const bool quantities = set.is("IFCELEMENTQUANTITY");
  if (!quantities && !set.is("IFCPROPERTYSET")) return;
  const std::string name = set[2].text();
  for (const Entity& p : set.refs(quantities ? 5 : 4)) appendProperty(properties, name, p, model, 0);
}

std::vector<Property> propertiesOf(const Entity& product, const Relations& relations, const Model& model) {
  std::vector<Property> properties;
  for (const Id set : relations.propertySetsOf(product)) appendProperties(properties, model.file.entity(set), model);
  const std::size_t own = properties.size();
  std::vector<Property> of_type;
  for (const Entity& set : model.file.entity(relations.typeOf(product)).refs(5)) appendProperties(of_type, set, model);
  for (Property& p : of_type) {
    const auto end = properties.begin() + static_cast<std::ptrdiff_t>(own);
    if (std::none_of(properties.begin(), end, [&](const Property& q) { return q.set == p.set && q.name == p.name; })) properties.push_back(std::move(p));
  }
  return properties;
}

}  // namespace standpoint::ifc
