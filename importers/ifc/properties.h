// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "core/environment.h"
#include "importers/ifc/model/model.h"
#include "importers/ifc/model/relations.h"

namespace standpoint::ifc {

// All that the file says of an object besides its shape, as text, in this order:
//  - "Attributes": what stands in the object's own record (Description, ObjectType, LongName, Tag, …);
//  - property sets and quantities, "Classification" (system → code and title) and "Document" of the occurrence;
//  - of those of its type the ones whose set and name the occurrence does not have;
//  - "Presentation layer".
// At most kMostProperties: sets may hold each other, and be shared by everything.
constexpr std::size_t kMostProperties = 10'000;
// What is within a complex property or quantity has the set "Set › Property".
constexpr std::string_view kWithinProperty = " › ";
constexpr int kDeepestProperty = 8;
constexpr std::size_t kMostPropertiesInAll = 5'000'000;
std::vector<Property> propertiesOf(const Entity& object, const Relations& relations, const Model& model);
// Those of one set: IfcPropertySet, IfcElementQuantity, IfcMaterialProperties, or a set whose properties are attributes
// (IfcDoorLiningProperties, IfcOpticalMaterialProperties). `prefix` is written before the set's name.
void appendProperties(std::vector<Property>& properties, const Entity& set, const Model& model,
                      const std::string& prefix = {});

}  // namespace standpoint::ifc
