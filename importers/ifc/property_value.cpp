// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/property_value.h"

#include <vector>

#include "importers/ifc/model/entities.h"
#include "importers/ifc/model/units.h"

namespace standpoint::ifc {
namespace {

std::string unitText(std::string_view measure, const Entity& own_unit, const Model& model) {
  if (own_unit) return unitSymbol(own_unit);
  const auto it = model.units.symbol_of_type.find(unitTypeOf(measure));
  return it == model.units.symbol_of_type.end() ? std::string() : it->second;
}

std::string symbolText(std::string_view symbol) {
  return symbol == "T" ? "true" : symbol == "F" ? "false" : symbol == "U" ? "unknown" : std::string(symbol);
}

std::string boundedText(const Entity& p, const Model& model) {
  const std::string low = valueText(p[3], p.ref(4), model), high = valueText(p[2], p.ref(4), model),
                    set_point = valueText(p[5], p.ref(4), model);
  const std::string range = low.empty() && high.empty() ? std::string() : low + " … " + high;
  return set_point.empty() ? range : range.empty() ? set_point : set_point + " (" + range + ")";
}

std::string tableText(const Entity& p, const Model& model) {
  const Value keys = p[2], values = p[3];
  std::string text;
  auto value = values.begin();
  for (const Value key : keys) {
    if (!text.empty()) text += "; ";
    text += valueText(key, p.ref(5), model) + " → ";
    if (value != values.end()) text += valueText(*value, p.ref(6), model), ++value;
  }
  return text;
}

}  // namespace

std::string valueText(const Value& value, const Entity& own_unit, const Model& model, std::string_view measure) {
  if (!value.present()) return {};
  const Value inner = value.inner();
  if (inner.isText()) return inner.text();
  if (const auto symbol = inner.symbol(); !symbol.empty()) return symbolText(symbol);
  if (inner.isList()) return joinedText(inner, own_unit, model);  // IfcCompoundPlaneAngleMeasure
  if (!inner.number()) return {};
  std::string text(inner.raw());
  while (!text.empty() && (text.back() == ' ' || text.back() == '\n' || text.back() == '\r')) text.pop_back();
  // "400.000000" says no more than 400.
  if (text.find('.') != std::string::npos && text.find_first_of("eE") == std::string::npos)
    while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  const std::string symbol = unitText(measure.empty() ? value.typeName() : measure, own_unit, model);
  return symbol.empty() ? text : text + ' ' + symbol;
}

std::string joinedText(const Value& list, const Entity& own_unit, const Model& model) {
  std::string text;
  for (const Value v : list) {
    const std::string one = v.inner().isList() ? std::string() : valueText(v, own_unit, model);  // lists do not nest
    text += (text.empty() ? "" : ", ") + one;
  }
  return text;
}

std::string referenceText(const Entity& e) {
  if (!e) return {};
  std::string text = schemaSpelling(e.typeName());
  const Value all = e.arguments();
  for (const Value v : all)
    if (v.isText() && !v.text().empty()) text += ' ' + v.text();
  return text;
}

std::string propertyText(const Entity& p, const Model& model) {
  const std::string_view kind = p.typeName();
  if (kind == "IFCPROPERTYSINGLEVALUE") return valueText(p[2], p.ref(3), model);
  if (kind == "IFCPROPERTYENUMERATEDVALUE") return joinedText(p[2], p.ref(3).ref(2), model);
  if (kind == "IFCPROPERTYLISTVALUE") return joinedText(p[2], p.ref(3), model);
  if (kind == "IFCPROPERTYBOUNDEDVALUE") return boundedText(p, model);
  if (kind == "IFCPROPERTYTABLEVALUE") return tableText(p, model);
  if (kind == "IFCPROPERTYREFERENCEVALUE") return referenceText(p.ref(3));
  if (kind.starts_with("IFCQUANTITY")) return valueText(p[3], p.ref(2), model, kind);
  return {};
}

PropertyType propertyType(const Entity& p) {
  const std::string_view kind = p.typeName();
  if (kind == "IFCPROPERTYSINGLEVALUE") return propertyTypeOf(p[2].typeName());
  std::vector<Value> values;
  if (kind == "IFCPROPERTYENUMERATEDVALUE" || kind == "IFCPROPERTYLISTVALUE")
    for (const Value v : p[2]) values.push_back(v);
  if (kind == "IFCPROPERTYBOUNDEDVALUE")
    for (const std::size_t i : {2U, 3U, 5U})
      if (p[i].present()) values.push_back(p[i]);
  if (values.empty()) return propertyTypeOf(kind);
  const std::string_view member = values.front().typeName();
  for (const Value& v : values)
    if (v.typeName() != member || v.inner().text().find(", ") != std::string::npos) return kNoPropertyType;
  return propertyTypeOf(std::string(kind) + "(" + std::string(member) + ")");
}

}  // namespace standpoint::ifc
