// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "pointclouds/datasets/class_map.h"

namespace standpoint {

// The id of the class of each point of a cloud, all its scans one after the other: four bytes a point. A cloud whose
// points have no products is an error.
Result<std::vector<std::uint32_t>> trueClasses(const std::filesystem::path& cloud, const ClassMap& map,
                                               Progress& progress);

}  // namespace standpoint
