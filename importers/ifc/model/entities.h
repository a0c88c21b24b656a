// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace standpoint::ifc {

enum class EntityKind {
  other,
  product,     // a beam of light meets it
  intangible,  // openings, grids, annotations, analysis models …: a product that no beam meets
  space,       // a room: in the spatial tree, and an intangible product
  spatial,     // site, building, storey, road …: in the spatial tree, a product where it has a body (terrain)
  project,
  type,
};

struct EntityName {
  const char* name;  // in the schema's spelling
  EntityKind kind;
  int predefined_type;  // position of PredefinedType, -1 where there is none
};

// nullptr when no schema we know has it.
const EntityName* entityName(std::string_view upper_case_name);
// "IfcWallStandardCase"; of unknown names "IfcSomething".
std::string schemaSpelling(std::string_view upper_case_name);

}  // namespace standpoint::ifc
