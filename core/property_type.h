// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace standpoint {

// What an IFC file calls the type of a property's value, "IFCTHERMALTRANSMITTANCEMEASURE", of a quantity,
// "IFCQUANTITYAREA", or of several values, "IFCPROPERTYLISTVALUE(IFCLABEL)": members of IfcValue of IFC4X3, the simple
// quantities, usual lists and bounds. Of other values and of files that state no types it is kNoPropertyType.
using PropertyType = std::uint8_t;
constexpr PropertyType kNoPropertyType = 0;

// Upper case, as in STEP; kNoPropertyType for what is not known.
PropertyType propertyTypeOf(std::string_view keyword);
// Empty for kNoPropertyType.
std::string_view keywordOf(PropertyType type);

}  // namespace standpoint
