// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "project/survey/survey_verbs.h"
#include "survey/quality/survey_quality.h"

namespace standpoint {

std::span<const Choice<QualityProfile>> choices(QualityProfile);

// Judges the scans that a job has: figures against limits, each with its worst place.
struct AssessOptions {
  StationNames stations;
  QualityProfile profile = QualityProfile::loa30;
  std::filesystem::path limits;  // file; empty: those of the profile
  double radius_m = QualityRequest().radius_m;
  std::filesystem::path output;  // .html or .csv; empty: none
};
const Fields<AssessOptions>& assessFields();

struct AssessPlace {
  std::optional<Eigen::Vector3d> at;  // m, the model's file frame
  std::optional<ProductIdentity> product;
  std::vector<std::string> stations;
  std::string what = {};  // there: "Incidence 87°"
  bool any() const { return at || product || !stations.empty(); }
};
const AnswerFields<AssessPlace>& answerFields(const AssessPlace*);
struct AssessRow {
  std::string id, label, unit;
  std::optional<double> value;
  std::optional<double> good, bad;                // limits: good up to the one, bad beyond the other
  std::string good_text, bad_text, limit_source;  // "≥ 95 %", "< 85 %"; empty where there is no limit
  Verdict verdict = Verdict::unknown;
  std::string note;
  std::optional<AssessPlace> worst;
};
const AnswerFields<AssessRow>& answerFields(const AssessRow*);
struct AssessScan {
  std::string station, file;
  std::uint64_t points = 0;
  double stray_fraction = 0;
  std::optional<double> deviation_median_m, deviation_95_m, noise_m, noise_ratio;
  bool moved = false;
};
const AnswerFields<AssessScan>& answerFields(const AssessScan*);
struct AssessStation {
  std::string station;
  double seen_m2 = 0;
  std::optional<double> pose_error_m, pose_error_rad;
  std::optional<std::size_t> targets;
};
const AnswerFields<AssessStation>& answerFields(const AssessStation*);

// What the report draws from above; not in the JSON.
struct AssessSketch {
  struct Place {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    bool seen = false;
  };
  struct Mark {
    std::string name;
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
  };
  struct Gap {  // one of the patches
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    std::vector<std::array<Eigen::Vector2d, 2>> rim;
  };
  std::vector<Place> surface;
  std::vector<Gap> gaps;  // in the patches' order
  std::vector<Mark> stations;
};

struct AssessAnswer {
  std::string project, profile, limits;                  // limits: name of the user's file, or empty
  std::size_t good = 0, warn = 0, bad = 0, unknown = 0;  // rows
  double radius_m = 0, exposed_m2 = 0;
  std::size_t samples = 0;
  std::vector<AssessRow> rows;
  std::vector<AssessScan> scans;
  std::vector<AssessStation> stations;
  std::vector<PlanPair> pairs;
  std::vector<PlanHole> holes;  // largest first, like the patches
  std::vector<PlanPatch> patches;
  AssessSketch sketch;
};
const AnswerFields<AssessAnswer>& answerFields(const AssessAnswer*);
Result<Answered<AssessAnswer>> runAssess(const Document& document, const AssessOptions& options, Progress& progress);

// "4 good, 2 to check, 1 bad, 1 not known"
std::string verdictText(const AssessAnswer& answer);
std::string valueText(const AssessRow& row);  // "97.3 %", or "–"

// .html (one page without anything from elsewhere) or .csv (its rows).
Result<void> writeQualityReport(const AssessAnswer& answer, const std::filesystem::path& file);

}  // namespace standpoint
