// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The materials of a document as they stand in project.json; readers throw as those of project_json.h do.

#include <nlohmann/json.hpp>

#include "project/document.h"

namespace standpoint {

nlohmann::json materialsToJson(const MaterialChoice& choice);
MaterialChoice materialsFrom(const nlohmann::json& part);

}  // namespace standpoint
