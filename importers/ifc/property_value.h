// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "core/property_type.h"
#include "importers/ifc/model/model.h"

namespace standpoint::ifc {

// A value as text with its unit: the property's own, else the project's for such a measure ("IFCLENGTHMEASURE",
// "IFCQUANTITYAREA"; empty: the measure that the value itself names), else none.
std::string valueText(const Value& value, const Entity& own_unit, const Model& model, std::string_view measure = {});
// The values of a list, separated by commas.
std::string joinedText(const Value& list, const Entity& own_unit, const Model& model);
// Of IfcProperty… other than the complex ones, and of IfcPhysicalSimpleQuantity.
std::string propertyText(const Entity& property, const Model& model);
// Of a single value, a simple quantity, and a list or bounds of one type whose text can be taken apart again.
PropertyType propertyType(const Entity& property);
// What a reference names: "IfcMaterial Brick".
std::string referenceText(const Entity& entity);

}  // namespace standpoint::ifc
