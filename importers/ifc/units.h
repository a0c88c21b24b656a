// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "core/report.h"
#include "importers/ifc/step_file.h"

namespace standpoint::ifc {

struct Units {
  double length_m = 1;
  double angle_rad = 1;
  std::map<std::string, std::string> symbol_of_type;   // "LENGTHUNIT" → "mm"
};

Units readUnits(const StepFile& file, Report& report);

// Metres (radians, …) per unit of an IfcSIUnit, IfcConversionBasedUnit or IfcMeasureWithUnit; 0 when it is none of them.
double siFactor(const Entity& unit);
std::string unitSymbol(const Entity& unit);

}  // namespace standpoint::ifc
