// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/report.h"
#include "project/dataset/recipe.h"

namespace standpoint {

struct SetEnvironmentForecast {
  std::string environment, building, split;
  std::size_t places = 0, stations = 0, scans = 0;
  double points = 0, bytes = 0, instrument_seconds = 0;
};
// Points of a class in one split.
struct SetClassForecast {
  std::string classes, split, name;  // id of the map; of the class
  double points = 0;
  double share = 0;      // 0..1, of the split's points that are not ignored
  bool starved = false;  // below the recipe's limit
};
struct SetForecast {
  std::vector<SetEnvironmentForecast> environments;
  std::vector<SetClassForecast> classes;
  std::size_t scans = 0;
  double points = 0, bytes = 0, instrument_seconds = 0;  // bytes of clouds and labels
  std::vector<std::string> unmapped;                     // "s3dis: IfcFlowTerminal"
};

// What a recipe would make, without scanning: the models are read, the stations found and each scan forecast by the
// laws of its instrument (scanners/forecast), in clear air and with one return of a pulse. `samples` on the surfaces of
// each environment carry the balance of the classes, and of each instrument there some thousand points are written as
// the recipe wants them, for the bytes.
Result<SetForecast> forecastSet(const Recipe& recipe, std::size_t samples, Report& report, Progress& progress);

}  // namespace standpoint
