// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/report.h"
#include "core/survey.h"
#include "scanners/instruments/target_kinds.h"
#include "survey/quality/quality_limits.h"
#include "survey/stations/surface_holes.h"
#include "survey/stations/surfaces_seen.h"

namespace standpoint {

// Where a figure is worst. Local frame.
struct WorstPlace {
  std::optional<Eigen::Vector3d> at;
  std::optional<std::uint32_t> product;
  std::vector<std::string> stations;
  std::string what = {};  // there: "Incidence 87°"
};

// A place among others, and their mean value or number.
struct WorstCell {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double value = 0;
};

// What one scan of the job shows against the model.
struct ScanFigures {
  std::size_t station = 0;  // of the job
  std::string file;
  std::uint64_t points = 0;
  Pose placed;                                       // local_from_scanner, as it is believed
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // from where it was measured
  bool has_pose = false;                             // the file knows where its scanner stood
  bool moved = false;                                // the station stands elsewhere now
  std::vector<std::uint32_t> counts;                 // of points, by sample
  double stray_fraction = 0;                         // of the points: further than the radius from every surface
  std::optional<Eigen::Vector3d> stray_at;
  std::optional<double> deviation_median_m, deviation_95_m;  // along the normal, of the points that are no strays
  std::optional<WorstCell> deviation_at;                     // m
  std::optional<double> noise_m, noise_ratio;  // median 1 σ along the beam on planes; and of that over the expected
  std::optional<WorstCell> noise_at;           // where it is the largest multiple of the expected; m
};

// A scan that could not be assessed, or only with reserve, and the remedy.
struct ScanTrouble {
  std::size_t station = 0;
  Verdict verdict = Verdict::bad;
  std::string what;
};

struct StationQuality {
  std::size_t station = 0;                             // of the job
  std::vector<std::uint8_t> seen;                      // of each sample
  std::optional<double> pose_error_m, pose_error_rad;  // believed against true; not of one that was moved since
  std::optional<std::size_t> targets;                  // that it can measure
};

struct QualityRow {
  std::string id, label, unit;
  std::optional<double> value;
  std::optional<QualityLimit> limit;
  Verdict verdict = Verdict::unknown;
  std::string note;
  WorstPlace worst;
};

struct SurveyQuality {
  SurfaceSamples samples;
  std::vector<std::uint8_t> surveyed;  // of each sample (surveyed_samples.h): where a worst place is looked for first
  double radius_m = 0;
  std::vector<ScanFigures> scans;
  std::vector<ScanTrouble> troubles;
  std::vector<StationQuality> stations;  // that have a scan which could be read
  SurfacesSeen seen;                     // pairs are of `stations`
  std::vector<SurfaceHole> patches;      // without a point
  std::vector<QualityRow> rows;
  Report report;
};

struct QualityRequest {
  std::vector<std::size_t> stations;  // of the job
  double radius_m = 0.05;
  std::size_t samples = 40000;
  std::uint64_t seed = 1;
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  QualityLimits limits;
  TargetRules target_rules;
};

// `scene`: the world that the scans saw, targets included; `model`: without them, for what targets are hidden by. Reads
// every scan file once; what of them is missing or damaged is a trouble, no error.
Result<SurveyQuality> assessSurvey(const Job& job, const std::shared_ptr<const RayScene>& scene, const RayScene& model,
                                   const std::shared_ptr<const MaterialAssignment>& assignment,
                                   const QualityRequest& request, Progress& progress);

// The cell of 1 m in which the values of places are the largest on average, or in which most places are; the middle of
// these places.
enum class WorstBy { mean, number };
std::optional<WorstCell> worstPlace(const std::vector<Eigen::Vector3d>& places, const std::vector<double>& values,
                                    WorstBy by);
// The smallest value that this fraction of all does not exceed; reorders them.
double fractile(std::vector<double>& values, double fraction);

std::vector<QualityRow> qualityRows(const SurveyQuality& quality, const Job& job, const QualityLimits& limits);

}  // namespace standpoint
