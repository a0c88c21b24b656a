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
#include "survey/stations/surface_holes.h"
#include "survey/stations/surfaces_seen.h"

namespace standpoint {

// What the scans of a job would bring.
struct SurveyPlan : SurfacesSeen {
  SurfaceSamples samples;
  std::vector<std::string> stations;
  std::vector<ScanForecast> forecasts;  // of each station
  std::vector<double> bytes;            // of each station
  std::vector<SurfaceHole> patches;     // what no station sees
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

// Of a point in an E57 of ours, with its share of the pages' sums.
double bytesPerPoint(const ScanSettings& settings, const ScanChannels& channels, const Environment& environment,
                     std::size_t materials);

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
