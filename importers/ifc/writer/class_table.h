// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace standpoint::ifc {

enum class Schema { ifc4, ifc4x3 };

// Does the schema have a class of products of this name ("IfcWall")?
bool hasClass(Schema schema, std::string_view name);
// The one to write for a class of any schema: itself; what took its place ("IfcBeam" for "IfcBeamStandardCase" in
// IFC4X3, "IfcElectricDistributionBoard" for IFC2X3's "IfcElectricDistributionPoint"); else IfcBuildingElementProxy.
std::string_view classToWrite(Schema schema, std::string_view name);
// Names of the attributes from the eighth on; "!" after one: an enumeration that must have a value. `name` is one of
// the schema's.
std::vector<std::string_view> attributesOf(Schema schema, std::string_view name);
// Is it a word of the class's PredefinedType besides USERDEFINED and NOTDEFINED?
bool isPredefined(Schema schema, std::string_view name, std::string_view word);
// "IfcWallType"; "IfcTypeProduct" where a class has no types of its own.
std::string typeClassOf(Schema schema, std::string_view name);
// From the tenth attribute on; empty for IfcTypeProduct, which has eight.
std::vector<std::string_view> typeAttributesOf(Schema schema, std::string_view type_class);

}  // namespace standpoint::ifc
