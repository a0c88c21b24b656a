// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How values are written in the answers of the verbs (`--json`): metres, degrees, the file's own frame.

#include <nlohmann/json.hpp>

#include "core/environment.h"
#include "core/georeference.h"
#include "core/report.h"
#include "core/result.h"
#include "core/surface_fit.h"
#include "core/survey.h"

namespace standpoint {

nlohmann::json toJson(const Eigen::Vector3d& v);
Eigen::Vector3d vectorFrom(const nlohmann::json& array);                            // of three numbers
nlohmann::json toJson(const Bounds& bounds_local, const Eigen::Vector3d& shift_m);  // file frame; null when empty
nlohmann::json toJson(const Report& report);
nlohmann::json toJson(const SurfaceFit& fit);
nlohmann::json poseToJson(const Pose& pose);
Pose poseFrom(const nlohmann::json& pose);
nlohmann::json identity(const Product& product);  // id, GlobalId, class, name
nlohmann::json georeferenceToJson(const Georeference& georeference);
Result<Georeference> georeferenceFrom(const nlohmann::json& object);

// "1,2,3" → three numbers, "1,2" → two; anything else is an error that says so.
Result<nlohmann::json> parseNumbers(const std::string& text);

}  // namespace standpoint
