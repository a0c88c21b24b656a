// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "core/rigid_fit.h"
#include "core/surface_fit.h"
#include "pointclouds/statistics/cloud_sample.h"
#include "project/document.h"
#include "project/fields.h"

namespace standpoint {

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

// Fits the cloud to the model's scene from where `file_from_cloud` puts it; the fit's poses are in the model's file
// frame.
Result<SurfaceFit> fitCloudToModel(const Document& document, const CloudSample& sample, const Pose& file_from_cloud,
                                   double reach_m, Progress& progress);
constexpr std::size_t kSampleForFit = 1000000;

// "along (1.00, 0.00, 0.00)", "about (0.00, 0.00, 1.00)"
std::string describe(const FreeMotion& motion);
nlohmann::json toJson(const SurfaceFit& fit);

// Registers the underlay by pairs, to the model's surface, or first the one and then the other. `answer` gets what came
// of it.
struct RegisterRequest {
  std::vector<PlacePair> pairs;
  bool to_surface = false;
  double reach_m = 0.5;
};
Result<Underlay> registered(const Document& document, const Underlay& underlay, const RegisterRequest& request,
                            nlohmann::json& answer, Report& report, Progress& progress);

}  // namespace standpoint
