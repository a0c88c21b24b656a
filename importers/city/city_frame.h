// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "core/environment.h"
#include "importers/files/importer.h"

namespace standpoint {

// What a file says of its coordinate reference system.
struct CityFrame {
  std::string crs;    // "EPSG:7415", else as the file has it; empty where it is silent
  std::string place;  // where it says so
};

// Of "https://www.opengis.net/def/crs/EPSG/0/7415", "urn:ogc:def:crs:EPSG::25832", "EPSG:3068",
// "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783" (the first) and "urn:adv:crs:ETRS89_UTM32*DE_DHHN92_NH".
std::string crsOfCityName(const std::string& name);

// Metres per unit of the coordinates. Refused where they are degrees; what is odd is said.
Result<double> cityUnit(const CityFrame& frame, const Bounds& file_bounds, const std::string& file_name,
                        Report& report);

// The file's frame is the map's.
void georeferenceCity(const CityFrame& frame, Georeference& georeference);

}  // namespace standpoint
