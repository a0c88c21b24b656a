// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/survey.h"
#include "scanners/forecast/scan_forecast.h"
#include "survey/stations/placement.h"
#include "survey/stations/station_places.h"

namespace standpoint {

// A part of the scene's surface, counted in samples.
struct SurfaceCoverage {
  std::string name;                                // a class, a storey, or a product's id
  std::uint32_t product = 0;                       // of a product's share
  std::uint64_t exposed = 0, seen = 0, twice = 0;  // twice: from two stations or more
  double coverage() const { return exposed == 0 ? 0 : static_cast<double>(seen) / static_cast<double>(exposed); }
};

// What two stations have in common; the share of the one that sees less is the overlap.
struct StationPair {
  std::size_t a = 0, b = 0;  // of SurveyPlan::forecasts
  double common_m2 = 0, of_a = 0, of_b = 0;
  double overlap() const { return of_a > of_b ? of_a : of_b; }
};

// What the scans of a job would bring.
struct SurveyPlan {
  SurfaceSamples samples;
  std::vector<std::string> stations;
  std::vector<ScanForecast> forecasts;  // of each station
  std::vector<double> seen_m2, bytes;   // of each station
  SurfaceCoverage all;
  std::vector<SurfaceCoverage> classes, storeys, holes;  // holes: products, by what of them is not seen
  std::vector<StationPair> pairs;
};

struct PlanRequest {
  Instrument instrument;
  ScanSettings settings;
  std::vector<std::size_t> stations;  // indices into the job
  ScanChannels channels;              // that the file would have
  SeenWhen wanted;
  std::size_t samples = 40000;
  std::uint64_t seed = 1;
};

Result<SurveyPlan> planSurvey(const Job& job, std::shared_ptr<const RayScene> scene,
                              std::shared_ptr<const MaterialAssignment> assignment, const PlanRequest& request,
                              Progress& progress);

// The place for another station that adds most to what is seen; the instrument's centre and the area that it adds.
struct NextStation {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double adds_m2 = 0;
};
std::optional<NextStation> nextStation(const Job& job, const GroundSearch& search, const StationPlacement& placement,
                                       const SurfaceSamples& samples, const std::vector<std::uint8_t>& seen,
                                       const SightLimits& limits, Progress& progress);

}  // namespace standpoint
