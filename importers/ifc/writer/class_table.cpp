// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/ifc/writer/class_table.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace standpoint::ifc {
namespace {

struct ProductClass {
  std::string_view name;
  const char* ifc4;  // attributes, separated by spaces; null: not in this schema
  const char* ifc4x3;
  std::string_view words;  // "-" after one: in IFC4 only; "+": in IFC4X3 only
};

constexpr ProductClass kClasses[] = {
#include "importers/ifc/writer/class_table.inc"
};

struct TypeClass {
  std::string_view name;
  const char* ifc4;
  const char* ifc4x3;
};

constexpr TypeClass kTypes[] = {
#include "importers/ifc/writer/type_table.inc"
};

// What took the place of classes that IFC4 and IFC4X3 no longer have.
constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSuccessors{
    {{"IfcElectricDistributionPoint", "IfcElectricDistributionBoard"},
     {"IfcElectricalElement", "IfcDistributionElement"},
     {"IfcEquipmentElement", "IfcDistributionElement"},
     {"IfcBuildingElement", "IfcBuildingElementProxy"},
     {"IfcProxy", "IfcBuildingElementProxy"}}};

template <class Row, std::size_t N>
const Row* find(const Row (&rows)[N], std::string_view name) {
  const auto it = std::lower_bound(std::begin(rows), std::end(rows), name,
                                   [](const Row& row, std::string_view n) { return row.name < n; });
  return it != std::end(rows) && it->name == name ? it : nullptr;
}

template <class Row>
const char* attributes(const Row* row, Schema schema) {
  return row == nullptr ? nullptr : schema == Schema::ifc4 ? row->ifc4 : row->ifc4x3;
}

std::vector<std::string_view> words(std::string_view text) {
  std::vector<std::string_view> all;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find(' ', at), text.size());
    all.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return all;
}

// "IfcWall" of "IfcWallStandardCase".
std::string_view withoutCase(std::string_view name) {
  for (const std::string_view end : {"StandardCase", "ElementedCase"})
    if (name.ends_with(end)) return name.substr(0, name.size() - end.size());
  return name;
}

}  // namespace

bool hasClass(Schema schema, std::string_view name) { return attributes(find(kClasses, name), schema) != nullptr; }

std::string_view classToWrite(Schema schema, std::string_view name) {
  const auto known = [&](std::string_view candidate) -> std::string_view {
    const ProductClass* row = find(kClasses, candidate);
    return attributes(row, schema) != nullptr ? row->name : std::string_view();
  };
  if (const auto same = known(name); !same.empty()) return same;
  if (const auto general = known(withoutCase(name)); !general.empty()) return general;
  for (const auto& [old, successor] : kSuccessors)
    if (name == old) return successor;
  for (const std::string_view of_type : {"Type", "Style"})  // a type that was imported as a product
    if (name.ends_with(of_type))
      if (const auto occurrence = known(name.substr(0, name.size() - of_type.size())); !occurrence.empty())
        return occurrence;
  return "IfcBuildingElementProxy";
}

std::vector<std::string_view> attributesOf(Schema schema, std::string_view name) {
  const char* text = attributes(find(kClasses, name), schema);
  return text == nullptr ? std::vector<std::string_view>() : words(text);
}

bool isPredefined(Schema schema, std::string_view name, std::string_view word) {
  const ProductClass* row = find(kClasses, name);
  if (row == nullptr || word.empty()) return false;
  const char other = schema == Schema::ifc4 ? '+' : '-';
  for (std::string_view known : words(row->words)) {
    const char mark = known.back();
    if (mark == '+' || mark == '-') known.remove_suffix(1);
    if (known == word) return mark != other;
  }
  return false;
}

std::string typeClassOf(Schema schema, std::string_view name) {
  const std::string type = std::string(withoutCase(name)) + "Type";
  if (attributes(find(kTypes, type), schema) != nullptr) return type;
  // Their types are abstract.
  for (const std::string_view general : {"IfcFlow", "IfcDistribution", "IfcEnergyConversionDevice"})
    if (name.starts_with(general)) return "IfcDistributionElementType";
  return "IfcTypeProduct";
}

std::vector<std::string_view> typeAttributesOf(Schema schema, std::string_view type_class) {
  const char* text = attributes(find(kTypes, type_class), schema);
  return text == nullptr ? std::vector<std::string_view>() : words(text);
}

}  // namespace standpoint::ifc
