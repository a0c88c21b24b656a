// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/surface_fit.h"
#include "project/answers.h"
#include "project/fields.h"
#include "survey/registration/registration.h"

namespace standpoint {

std::span<const Choice<TargetMatching>> choices(TargetMatching);

// "x,y,turn": an offset in plan, m, and a turn about itself, degrees.
struct StartOffset {
  double x_m = 0, y_m = 0, turn_deg = 0;
};
template <>
struct FieldValue<StartOffset> {
  static constexpr auto kKind = ParameterKind::text;
  static void describe(Parameter&) {}
  static Result<StartOffset> read(const nlohmann::json& text);
  static nlohmann::json write(const StartOffset& offset);
};

struct RegisterOptions {
  std::vector<std::filesystem::path> files;
  std::string fix;  // station that keeps its pose; empty: the first
  TargetMatching by = TargetMatching::by_names;
  std::filesystem::path control;
  bool cloud = false;
  std::filesystem::path output;
  double reach_m = 0.5;                     // of `cloud`
  std::optional<StartOffset> start_offset;  // likewise
  double click_m = MeasuringRequest{}.click_m;
  std::uint64_t seed = 1;
};
const Fields<RegisterOptions>& registerFields();

struct TargetDifference {  // of a target as two stations have it
  std::string target;
  double dx_m = 0, dy_m = 0, dz_m = 0, d3_m = 0;
};
const AnswerFields<TargetDifference>& answerFields(const TargetDifference*);
struct RegisterLink {
  std::string from, to;
  std::size_t targets = 0;
  double rms_m = 0, mean_m = 0;
  std::optional<double> unbiased_m;
  std::vector<TargetDifference> differences;
};
const AnswerFields<RegisterLink>& answerFields(const RegisterLink*);
struct StationResidual {  // of a target, from one station
  std::string station;
  double dx_m = 0, dy_m = 0, dz_m = 0, d3_m = 0;
};
const AnswerFields<StationResidual>& answerFields(const StationResidual*);
struct RegisteredTarget {
  std::string name;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // m, the model's file frame
  std::vector<StationResidual> residuals;
  std::optional<double> true_error_m;  // of a target of the job
};
const AnswerFields<RegisteredTarget>& answerFields(const RegisteredTarget*);
struct RegisterMeasured {
  std::string station, target;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero(), sigma_m = Eigen::Vector3d::Zero();  // scanner's frame
  std::size_t points = 0;
  double residual_m = 0, true_error_m = 0;
  std::optional<double> incidence_rad;  // of a checkerboard
};
const AnswerFields<RegisterMeasured>& answerFields(const RegisterMeasured*);
struct RegisterMissed {
  std::string station, target, why;
};
const AnswerFields<RegisterMissed>& answerFields(const RegisterMissed*);
struct RegisterMeasurements {
  std::vector<RegisterMeasured> found;
  std::vector<RegisterMissed> missed;
};
const AnswerFields<RegisterMeasurements>& answerFields(const RegisterMeasurements*);
struct RegisteredStation {
  std::string name;
  Pose solved_pose;  // file_from_scanner
  double true_error_m = 0, true_turn_error_rad = 0;
  std::optional<bool> held;                                      // by targets, like the next two
  std::optional<Eigen::Vector3d> sigma_shift_m, sigma_turn_rad;  // 1 σ
  std::optional<SurfaceFit> fit;                                 // by clouds, of all but the held one
};
const AnswerFields<RegisteredStation>& answerFields(const RegisteredStation*);

struct RegisterAnswer {
  std::vector<RegisteredStation> stations;
  // By targets only:
  std::optional<std::vector<RegisterLink>> links;
  std::optional<std::vector<RegisteredTarget>> targets;
  std::optional<std::optional<double>> mean_target_error_m;  // null without links
  std::optional<double> sigma_factor;
  std::optional<int> redundancy;
  std::optional<std::size_t> wrong_matches;
  std::optional<RegisterMeasurements> measured;
  std::vector<std::filesystem::path> files;  // that were written
};
const AnswerFields<RegisterAnswer>& answerFields(const RegisterAnswer*);
Result<Answered<RegisterAnswer>> runRegister(const Document& document, const RegisterOptions& options,
                                             Progress& progress);

}  // namespace standpoint
