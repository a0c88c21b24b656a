// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/survey.h"
#include "scanners/instruments/instrument.h"

namespace standpoint {

// A target as it is sold: a shape and a size.
struct TargetArticle {
  std::string id, label;  // "sphere-145"
  TargetKind shape = TargetKind::sphere;
  double size_m = 0;  // diameter or side
};

// What office people go by when they set up targets.
struct TargetRules {
  int min_points = 0;  // on a target, to be fitted well
  double max_distance_m = 0;
  double max_incidence_rad = 0;  // of what is flat
};

struct TargetKinds {
  TargetRules rules;
  std::vector<TargetArticle> articles;       // at least one
  std::map<std::string, Evidence> evidence;  // by JSON pointer
};

// Errors name the file and the JSON pointer.
Result<TargetKinds> readTargetKinds(const std::filesystem::path& file);

// Points that a scan with these settings lays on a target: its cross-section over the grid's solid angle.
double pointsOn(const Target& target, double distance_m, double incidence_rad, const ScanSettings& settings);
// Where it still gets `points`, seen square-on.
double distanceFor(const Target& target, double points, const ScanSettings& settings);

}  // namespace standpoint
