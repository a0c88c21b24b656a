// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "project/dataset/set_verify.h"

namespace standpoint {

// A STAC item (1.0.0) of an environment with its clouds, by the extensions pointcloud 2.0.0 and file 2.1.0: a footprint
// in WGS 84, the recipe's date and licence, number of points, and address, type, size and checksum of each cloud.
// Nothing where the environment has no place in a projected CRS that PROJ knows.
Result<std::optional<std::string>> stacItem(const Recipe& recipe, const SetCheck& check, std::size_t environment);
std::string stacFile(const RecipeEnvironment& environment);  // "stac/house.json"

}  // namespace standpoint
