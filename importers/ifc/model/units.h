// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/report.h"
#include "importers/ifc/model/step_file.h"

namespace standpoint::ifc {

struct Units {
  double length_m = 1;
  double angle_rad = 1;
  std::map<std::string, std::string> symbol_of_type;  // "LENGTHUNIT" → "mm"
};

// `given_m` > 0 is the user's word on what the numbers are; it stands above the file's.
Units readUnits(const StepFile& file, double given_m, Report& report);

// Metres (radians, …) per unit of an IfcSIUnit, IfcConversionBasedUnit or IfcMeasureWithUnit; 0 when it is none of
// them.
double siFactor(const Entity& unit);
std::string unitSymbol(const Entity& unit);
// "LENGTHUNIT" of "IFCPOSITIVELENGTHMEASURE", "AREAUNIT" of "IFCQUANTITYAREA"; empty for what is not measured.
std::string unitTypeOf(std::string_view measure);

// An SI unit by its symbol: MILLI, METRE and 0.001 of "mm".
struct SiUnitName {
  std::string_view prefix;  // empty: none
  std::string_view name;
  double factor = 1;
};
std::optional<SiUnitName> siUnitOf(std::string_view symbol);

}  // namespace standpoint::ifc
