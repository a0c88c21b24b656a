// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How values are written in the answers of the verbs (`--json`): metres, degrees, the file's own frame.

#include <string>

#include <nlohmann/json.hpp>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/report.h"
#include "core/result.h"
#include "core/surface_fit.h"
#include "core/survey.h"
#include "project/answer_fields.h"

namespace standpoint {

nlohmann::json toJson(const Eigen::Vector3d& v);
Eigen::Vector3d vectorFrom(const nlohmann::json& array);  // of three numbers
nlohmann::json toJson(const Bounds& bounds);              // null when empty
nlohmann::json toJson(const Report& report);
nlohmann::json poseToJson(const Pose& pose);
Pose poseFrom(const nlohmann::json& pose);
nlohmann::json georeferenceToJson(const Georeference& georeference);
Result<Georeference> georeferenceFrom(const nlohmann::json& object);

// Parts of typed answers.
template <>
struct AnswerValue<Bounds> {  // in the frame that they are shown in; null when empty
  static nlohmann::json write(const Bounds& bounds) { return toJson(bounds); }
  static std::vector<std::string> names() { return {}; }
};
Bounds fileBounds(const Bounds& local, const Eigen::Vector3d& shift_m);  // in the model's file frame
const AnswerFields<Pose>& answerFields(const Pose*);
const AnswerFields<MapConversion>& answerFields(const MapConversion*);
const AnswerFields<GeographicPosition>& answerFields(const GeographicPosition*);
const AnswerFields<Georeference>& answerFields(const Georeference*);
const AnswerFields<FreeMotion>& answerFields(const FreeMotion*);
const AnswerFields<SurfaceFit>& answerFields(const SurfaceFit*);

struct ProductIdentity {
  std::string id, global_id, ifc_class, name;
};
ProductIdentity identityOf(const Product& product);
const AnswerFields<ProductIdentity>& answerFields(const ProductIdentity*);

// "1,2,3" → three numbers, "1,2" → two; anything else is an error that says so.
Result<nlohmann::json> parseNumbers(const std::string& text);

}  // namespace standpoint
