// SPDX-License-Identifier: GPL-3.0-or-later
#include "pointclouds/las/las_classes.h"

#include <utility>

namespace standpoint::las {
namespace {

// By the beginning of the class's name, the first that fits. 1 is "unclassified": movable things have no class there.
constexpr std::pair<std::string_view, std::uint8_t> kClasses[] = {{"IfcSite", 2},
                                                                  {"IfcGeographicElement", 2},
                                                                  {"IfcGeotechnical", 2},
                                                                  {"IfcEarthworks", 2},
                                                                  {"IfcGeomodel", 2},
                                                                  {"IfcPavement", 11},
                                                                  {"IfcRoad", 11},
                                                                  {"IfcKerb", 11},
                                                                  {"IfcCourse", 11},
                                                                  {"IfcRail", 10},
                                                                  {"IfcTrack", 10},
                                                                  {"IfcBridge", 17},
                                                                  {"IfcBearing", 17},
                                                                  {"IfcTendon", 17},
                                                                  {"IfcFurn", 1},
                                                                  {"IfcSystemFurniture", 1},
                                                                  {"IfcTransportElement", 1},
                                                                  {"IfcSign", 1},
                                                                  {"IfcVehicle", 1},
                                                                  {"IfcAnnotation", 1},
                                                                  {"IfcBuildingElementProxy", 1},
                                                                  {"IfcProxy", 1},
                                                                  {"IfcVirtualElement", 1},
                                                                  {"Ifc", 6}};

}  // namespace

std::uint8_t classOf(std::string_view ifc_class) {
  for (const auto& [begins, number] : kClasses)
    if (ifc_class.starts_with(begins)) return number;
  return 1;
}

}  // namespace standpoint::las
