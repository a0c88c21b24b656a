// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "project/survey/survey_verbs.h"

namespace standpoint {

// What a scanner sees that is carried along trajectories: predicted by rays, or measured from their scans.
struct CoverageOptions {
  std::vector<std::string> trajectories;  // names; empty: all
  std::string instrument;                 // id; empty: that of each trajectory's last scan
  KeyValues settings;
  TrajectoryError trajectory_error = TrajectoryError::of_instrument;
  Switch closures = Switch::on, anchors = Switch::off;
  std::filesystem::path control;
  bool measured = false;
  Switch movers = Switch::on;
  double movers_from_s = 0;  // their clock when the trajectory begins
  double density_per_m2 = 100, max_incidence_deg = 75, pass_gap_s = 30;
  std::size_t samples = 40000;
  std::uint64_t seed = 1;
};
const Fields<CoverageOptions>& coverageFields();

// Of a part of the surface that light gets to.
struct CoverageShare {
  double exposed_m2 = 0, covered_m2 = 0, twice_m2 = 0;  // twice: in two passes or more
  double coverage = 0, twice = 0;                       // 0..1, of what is exposed
  // What is blind, by the reason (survey/trajectories/path_coverage.h).
  double passed_by_m2 = 0, sparse_m2 = 0, grazing_m2 = 0, out_of_view_m2 = 0, out_of_range_m2 = 0, occluded_m2 = 0,
         unreachable_m2 = 0;
};
const AnswerFields<CoverageShare>& answerFields(const CoverageShare*);
struct CoverageTrajectory : CoverageShare {
  std::string trajectory, instrument;
  double length_m = 0, seconds = 0, mean_mps = 0, fastest_mps = 0, fastest_turn_degps = 0;
  std::uint64_t closures = 0;
  double expected_rms_m = 0, expected_most_m = 0;  // of its position's error over all seeds, along its time; at worst
  double alone_m2 = 0;                             // that no other of these trajectories covers …
  double alone_m2_per_minute = 0;                  // … and by the minutes that it takes
};
const AnswerFields<CoverageTrajectory>& answerFields(const CoverageTrajectory*);
struct CoverageClass : CoverageShare {
  std::string ifc_class;
};
const AnswerFields<CoverageClass>& answerFields(const CoverageClass*);
struct CoverageStorey : CoverageShare {
  std::string storey;
};
const AnswerFields<CoverageStorey>& answerFields(const CoverageStorey*);
struct CoverageProduct : CoverageShare, ProductIdentity {};
const AnswerFields<CoverageProduct>& answerFields(const CoverageProduct*);
struct CoverageAnswer : CoverageShare {  // of all these trajectories together
  bool measured = false;
  double common_m2 = 0;  // that each of them covers
  std::vector<CoverageTrajectory> trajectories;
  std::vector<CoverageClass> classes;
  std::vector<CoverageStorey> storeys;
  std::vector<CoverageProduct> products;  // by what of them is blind, most of it first
  std::vector<PlanPatch> blind;           // largest first; each has a reason
};
const AnswerFields<CoverageAnswer>& answerFields(const CoverageAnswer*);
Result<Answered<CoverageAnswer>> runCoverage(const Document& document, const CoverageOptions& options,
                                             Progress& progress);

}  // namespace standpoint
