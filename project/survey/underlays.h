// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/surface_fit.h"
#include "project/answers.h"
#include "project/fields.h"

namespace standpoint {

using Underlays = std::vector<std::shared_ptr<const Underlay>>;

// As they stand in project.json, their files as storedPlace() has it. Readers throw nlohmann::json::exception.
nlohmann::json underlaysToJson(const Underlays& underlays, const std::filesystem::path& project_folder);
Underlays underlaysFrom(const nlohmann::json& part, const std::filesystem::path& project_folder);

// Of the cloud in the model's file frame.
Bounds boundsInFile(const Underlay& underlay);
// Of the imported model, or where the project has none, of its clouds; file frame.
Bounds siteInFile(const Document& document);

// The same place as the cloud's file and as the model's has it.
struct PlacePair {
  Eigen::Vector3d cloud_m = Eigen::Vector3d::Zero(), model_m = Eigen::Vector3d::Zero();
};
// "x,y,z=X,Y,Z" of each; errors name the pair.
template <>
struct FieldValue<std::vector<PlacePair>> {
  static constexpr auto kKind = ParameterKind::pairs;
  static void describe(Parameter&) {}
  static Result<std::vector<PlacePair>> read(const nlohmann::json& texts);
  static nlohmann::json write(const std::vector<PlacePair>& pairs);
};

// Registers the underlay by pairs, to the model's surface, or first the one and then the other.
struct RegisterRequest {
  std::vector<PlacePair> pairs;
  bool to_surface = false;
  double reach_m = 0.5;
};
struct PairResidual {
  Eigen::Vector3d cloud_m = Eigen::Vector3d::Zero(), model_m = Eigen::Vector3d::Zero();
  double residual_m = 0;
};
const AnswerFields<PairResidual>& answerFields(const PairResidual*);
struct UnderlayRegistration {
  std::vector<PairResidual> pairs;  // empty, and the three below nothing, where it was not registered by pairs
  std::optional<double> pairs_rms_m, scale, scale_sigma;
  std::optional<SurfaceFit> icp;
  Pose file_from_cloud;
};
const AnswerFields<UnderlayRegistration>& answerFields(const UnderlayRegistration*);
// `came_of_it` gets the figures.
Result<Underlay> registered(const Document& document, const Underlay& underlay, const RegisterRequest& request,
                            UnderlayRegistration& came_of_it, Report& report, Progress& progress);

// Adds, moves, registers, shows, hides, removes or lists clouds that lie under the model.
// Of the actions at most one; none lists.
struct UnderlayOptions : RegisterRequest {  // for `fit`
  std::optional<std::filesystem::path> add;
  std::string name;  // of what is added, empty: the file's; the new one, for `rename`
  std::optional<std::string> move, fit, rename, remove, show, hide;
  std::optional<Eigen::Vector3d> at;  // the cloud's origin in the file's frame, m
  std::optional<double> yaw_deg;
};
const Fields<UnderlayOptions>& underlayFields();

// Reads the cloud to be added and finds its place among what the document has; the name is one that is free there.
Result<Underlay> readUnderlay(const Document& document, const UnderlayOptions& options, Report& report,
                              Progress& progress);

struct UnderlayRow {
  std::string name, file;  // absolute
  bool file_there = false;
  std::string format;
  std::uint64_t points = 0;
  Bounds bounds_cloud_m, bounds_file_m;
  Pose file_from_cloud;
  std::string crs;
  bool visible = true;
};
const AnswerFields<UnderlayRow>& answerFields(const UnderlayRow*);
UnderlayRow underlayRow(const Underlay& underlay);
struct UnderlayAnswer {
  std::optional<UnderlayRow> placed;               // what was added
  std::optional<UnderlayRegistration> registered;  // what was registered
  std::vector<UnderlayRow> underlays;
};
const AnswerFields<UnderlayAnswer>& answerFields(const UnderlayAnswer*);
Result<Answered<UnderlayAnswer>> runUnderlay(const Document& document, const UnderlayOptions& options,
                                             Progress& progress);

}  // namespace standpoint
