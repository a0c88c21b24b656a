// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pointclouds/target_fit.h"
#include "project/document.h"

namespace standpoint {

// A job's targets as the scans in point-cloud files show them. Indices are into the job's lists.
struct MeasuredTarget {
  std::size_t station = 0, target = 0;
  TargetFit fit;                   // in the station's own frame
};
struct MissedTarget {
  std::size_t station = 0, target = 0;
  std::string why;
};
struct ScannedStation {
  std::size_t station = 0;
  std::string file;
  bool has_intensity = false;
  std::vector<Eigen::Vector3d> sample;   // of its points, own frame; only when asked for
};
struct TargetMeasurements {
  std::vector<ScannedStation> scans;     // in the order of the job's stations
  std::vector<MeasuredTarget> found;
  std::vector<MissedTarget> missed;
  Report report;                         // of reading
};

struct MeasuringRequest {
  std::vector<std::filesystem::path> files;
  std::uint64_t seed = 1;
  double click_m = 0.2;            // how far at most the operator's click is from a target: the search starts there
  bool targets = true;
  bool sample = false;
};

// Reads every file once; keeps only points near where targets are, and a sample. Which station a scan is says its name,
// else the file that the job says its scans are in.
Result<TargetMeasurements> measureTargets(const Document& document, const MeasuringRequest& request, Progress& progress);

}  // namespace standpoint
