// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "core/json_file.h"
#include "core/physical_material.h"

namespace standpoint {

// Where figures come from, by the id that they refer to.
struct FigureSource {
  std::string text, licence;
};
using SourceTable = std::map<std::string, FigureSource, std::less<>>;

// One entry of a library, all but what takes the other entries: the reflectance of a wet state.
Result<PhysicalMaterial> readMaterial(const nlohmann::json& entry, const JsonPlace& at, const SourceTable& sources);

// Gives a wet state its reflectance; `dry` is null when the library has none of that name.
Result<void> wet(PhysicalMaterial& material, const PhysicalMaterial* dry, const JsonPlace& at);

}  // namespace standpoint
