// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/report.h"
#include "core/survey.h"
#include "scanners/engine/ray_engine.h"
#include "scanners/instruments/target_kinds.h"

namespace standpoint {

// How a station would see a target.
struct TargetSight {
  std::string station;
  double distance_m = 0, incidence_rad = 0;
  double seen_fraction = 0;      // of its face
  std::string hidden_by;         // where not all is seen
  std::optional<double> points;  // that the instrument lays on it, hidden or not; nothing where none is known
  double max_distance_m = 0;     // at which this instrument's grid, or the rule, still does
  std::string why_not;           // empty: it can be measured from there
};

struct SightRequest {
  std::string instrument;  // id; empty: those that scanned from each station
  SettingValues settings;
};

// From one station; without `settings` only the rules say how far.
TargetSight sightFrom(const Station& station, const RayScene& scene, const Target& target, const TargetRules& rules,
                      const std::optional<ScanSettings>& settings);
Result<std::vector<TargetSight>> sightsOf(const Job& job, const RayScene& scene, const Target& target,
                                          const TargetRules& rules, const SightRequest& request);
void tell(const Target& target, const std::vector<TargetSight>& sights, Report& report);

}  // namespace standpoint
