// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "core/json_fields.h"
#include "core/json_file.h"
#include "core/physical_material.h"

namespace standpoint {

// Where figures come from, by the id that they refer to.
struct FigureSource {
  std::string text, licence;
};
using SourceTable = std::map<std::string, FigureSource, std::less<>>;

std::string readId(JsonFields& fields);  // of a-z, 0-9 and _

// One entry of a library, all but what takes the other entries: the reflectance of a wet state.
Result<PhysicalMaterial> readMaterial(JsonFields& fields, const SourceTable& sources);

// Gives a wet state its reflectance; `dry` is null when the library has none of that name.
Result<void> wet(PhysicalMaterial& material, const PhysicalMaterial* dry, const JsonPlace& at);

}  // namespace standpoint
