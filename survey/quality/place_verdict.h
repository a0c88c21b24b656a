// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/quality/place_forecast.h"
#include "survey/quality/quality_limits.h"
#include "survey/stations/placement.h"

namespace standpoint {

// How good a place for a station is: bad where it is refused, to check where something speaks against it.
struct PlaceVerdict {
  Verdict verdict = Verdict::good;
  std::string brief;   // in some five words: "18 cm from wall"; "Good place" where nothing speaks against it
  std::string reason;  // of a refusal, in full, with what helps
};

// Reason and remedy.
std::string sentenceOf(const Refusal& refusal);

// On a surface that was pointed at. `nearest_m` is the shortest range that the instrument measures: what is nearer
// stays unseen.
PlaceVerdict judgePlace(const StationPlacement& placement, const RayHit& hit, double height_m, double nearest_m);
// Of a station that is there, by its centre: on what lies straight below it; one that is held or hangs by its clearance
// alone.
PlaceVerdict judgeStation(const StationPlacement& placement, const Eigen::Vector3d& centre, bool on_tripod,
                          double nearest_m);

// The same verdict, where it is good, with what is expected to be seen from there: "Overlaps K2 by 12 %".
PlaceVerdict withForecast(PlaceVerdict verdict, const PlaceForecast& forecast);

// Of the figures that withForecast() goes by, each at worst to be checked. That of an overlap is of the largest one:
// one is enough. The angle of incidence has none: what is met aslant from here is for the other stations.
Verdict overlapVerdict(const PlaceForecast& forecast);
Verdict spacingVerdict(const PlaceForecast& forecast);

}  // namespace standpoint
