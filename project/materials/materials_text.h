// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/environment.h"
#include "materials/materials.h"

namespace standpoint {

// What the command line tells of `materials`: the coverage, each material's share, the findings by kind, and how to go
// on.
std::string materialsText(const Environment& environment, const MaterialReport& report);

// Of the answer's "libraries": what was taken in, and where what changed is used. Empty without.
std::string libraryText(const nlohmann::json& answer);

// Of the answer's "where".
std::string whereText(const nlohmann::json& where);

}  // namespace standpoint
