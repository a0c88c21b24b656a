// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

namespace standpoint {

// What the EPSG dataset (through PROJ's database) says of a code. Where the database is not installed nothing is said.
struct EpsgCrs {
  bool projected = false;
  double unit = 1;  // metres (radians) per unit of its first axis
};
struct EpsgAnswer {
  bool asked = false;          // false: there is no database
  std::optional<EpsgCrs> crs;  // nothing: there is no CRS of that code
};
EpsgAnswer epsgCrs(const std::string& digits);
// Whether it is a vertical (else geodetic) datum or CRS; also true when there is no database.
bool isEpsgReference(const std::string& digits, bool vertical);

// "25832" of "EPSG:25832", "epsg: 25832", "25832" and "urn:ogc:def:crs:EPSG::25832"; empty where it is no EPSG code.
std::string epsgDigits(const std::string& name);

}  // namespace standpoint
