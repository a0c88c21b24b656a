// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

namespace standpoint {

// What a type of the CityGML data model is among the classes of IFC.
struct CityClass {
  std::string_view type;       // "WallSurface"
  std::string_view ifc_class;  // "IfcWall"
  std::string_view predefined_type;
  bool place = false;             // a node of the spatial structure: a building, a storey, a room
  bool tangible = true;           // false: its own polygons bound a space, no beam meets them
  std::uint32_t rgb = 0xB3B3B3U;  // where the file states no appearance
};

// Of a type that the table does not have: IfcBuildingElementProxy.
const CityClass& cityClassOf(std::string_view type);

}  // namespace standpoint
