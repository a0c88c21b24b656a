// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/city/city_classes.h"

#include <algorithm>
#include <array>

namespace standpoint {

namespace {

constexpr std::uint32_t kWall = 0xD8D2C4U, kRoof = 0xA5543EU, kFloor = 0x9C9488U, kGlazed = 0x9DB8C9U,
                        kGreen = 0x6B8E4EU, kWater = 0x6C9BBFU, kEarth = 0x8F8A6AU, kPaved = 0x7E7E80U,
                        kWooden = 0x8B6B4AU, kPlain = 0xB3B3B3U;

constexpr CityClass place(std::string_view type, std::string_view ifc_class, bool tangible = true) {
  return {type, ifc_class, "", true, tangible, kWall};
}
constexpr CityClass thing(std::string_view type, std::string_view ifc_class, std::uint32_t rgb,
                          std::string_view predefined_type = "") {
  return {type, ifc_class, predefined_type, false, true, rgb};
}

// Types of CityGML 1.0 to 3.0 and CityJSON 1.0 to 2.0 by their local names.
constexpr std::array kClasses{
    place("Building", "IfcBuilding"),
    place("BuildingPart", "IfcBuilding"),
    place("BuildingStorey", "IfcBuildingStorey", false),
    place("Storey", "IfcBuildingStorey", false),
    place("BuildingUnit", "IfcSpatialZone", false),
    place("BuildingRoom", "IfcSpace", false),
    place("Room", "IfcSpace", false),
    place("Bridge", "IfcBridge"),
    place("BridgePart", "IfcBridge"),
    place("BridgeRoom", "IfcSpace", false),
    place("Tunnel", "IfcFacility"),
    place("TunnelPart", "IfcFacility"),
    place("TunnelHollowSpace", "IfcSpace", false),
    place("HollowSpace", "IfcSpace", false),
    thing("WallSurface", "IfcWall", kWall),
    thing("InteriorWallSurface", "IfcWall", 0xE6E4DEU),
    thing("RoofSurface", "IfcRoof", kRoof),
    thing("GroundSurface", "IfcSlab", kFloor, "BASESLAB"),
    thing("FloorSurface", "IfcSlab", kFloor, "FLOOR"),
    thing("OuterFloorSurface", "IfcSlab", kFloor, "FLOOR"),
    thing("CeilingSurface", "IfcCovering", 0xE6E4DEU, "CEILING"),
    thing("OuterCeilingSurface", "IfcCovering", 0xE6E4DEU, "CEILING"),
    CityClass{"ClosureSurface", "IfcVirtualElement", "", false, false, kPlain},
    thing("Window", "IfcWindow", kGlazed),
    thing("WindowSurface", "IfcWindow", kGlazed),
    thing("Door", "IfcDoor", kWooden),
    thing("DoorSurface", "IfcDoor", kWooden),
    thing("BuildingFurniture", "IfcFurniture", kWooden),
    thing("BridgeFurniture", "IfcFurniture", kWooden),
    thing("TunnelFurniture", "IfcFurniture", kWooden),
    thing("CityFurniture", "IfcFurniture", kPlain),
    thing("TINRelief", "IfcGeographicElement", kEarth, "TERRAIN"),
    thing("ReliefFeature", "IfcGeographicElement", kEarth, "TERRAIN"),
    thing("LandUse", "IfcGeographicElement", kEarth, "TERRAIN"),
    thing("PlantCover", "IfcGeographicElement", kGreen, "VEGETATION"),
    thing("SolitaryVegetationObject", "IfcGeographicElement", kGreen, "VEGETATION"),
    thing("WaterBody", "IfcGeographicElement", kWater),
    thing("WaterSurface", "IfcGeographicElement", kWater),
    thing("WaterGroundSurface", "IfcGeographicElement", kEarth, "TERRAIN"),
    CityClass{"WaterClosureSurface", "IfcVirtualElement", "", false, false, kPlain},
    thing("Road", "IfcPavement", kPaved),
    thing("Square", "IfcPavement", kPaved),
    thing("TransportSquare", "IfcPavement", kPaved),
    thing("Track", "IfcPavement", kPaved),
    thing("Railway", "IfcRail", kPaved),
    thing("Waterway", "IfcGeographicElement", kWater),
    thing("TransportationComplex", "IfcPavement", kPaved),
    thing("TrafficArea", "IfcPavement", kPaved),
    thing("AuxiliaryTrafficArea", "IfcPavement", kPaved),
    thing("Section", "IfcPavement", kPaved),
    thing("Intersection", "IfcPavement", kPaved),
};

constexpr CityClass kUnknown = thing("", "IfcBuildingElementProxy", kPlain);

}  // namespace

const CityClass& cityClassOf(std::string_view type) {
  const auto* found =
      std::find_if(kClasses.begin(), kClasses.end(), [&](const CityClass& c) { return c.type == type; });
  return found == kClasses.end() ? kUnknown : *found;
}

}  // namespace standpoint
