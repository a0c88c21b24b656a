// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/points.h"
#include "core/progress.h"
#include "core/report.h"
#include "core/survey.h"
#include "pointclouds/targets/target_fit.h"

namespace standpoint {

// A job's targets as the scans in point-cloud files show them. Indices are into the job's lists.
struct MeasuredTarget {
  std::size_t station = 0, target = 0;
  TargetFit fit;  // in the station's own frame
};
struct MissedTarget {
  std::size_t station = 0, target = 0;
  std::string why;
  NoFit reason = NoFit::none;
};
struct ScannedStation {
  std::size_t station = 0;
  std::string file;
  bool has_intensity = false;
  std::vector<Eigen::Vector3d> sample;  // of its points, own frame; only when asked for
};
struct TargetMeasurements {
  std::vector<ScannedStation> scans;  // in the order of the job's stations
  std::vector<MeasuredTarget> found;
  std::vector<MissedTarget> missed;
  Report report;  // of reading
};

// Which station each scan of a file is of: its name says it, else the file that the job says its scans are in.
class StationsOfFile {
 public:
  StationsOfFile(const Job& job, std::filesystem::path file);
  Result<std::size_t> next(const ScanHeader& header);  // of the next scan of the file

 private:
  const Job& job_;
  std::filesystem::path file_;
  std::vector<std::size_t> in_file_;
  std::size_t scans_ = 0;
};

struct MeasuringRequest {
  std::vector<std::filesystem::path> files;
  std::uint64_t seed = 1;
  double click_m = 0.2;  // how far at most the operator's click is from a target: the search starts there
  bool targets = true;
  bool sample = false;
};

// Reads every file once; keeps only points near where targets are, and a sample.
Result<TargetMeasurements> measureTargets(const Job& job, const MeasuringRequest& request, Progress& progress);

}  // namespace standpoint
