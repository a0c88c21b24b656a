// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "core/result.h"
#include "pointclouds/datasets/class_map.h"
#include "pointclouds/datasets/label_array.h"

namespace standpoint {

// The id of the class of each point of a cloud and its instance (its product's place in the scan's table, from 1; 0
// without a product), all its scans one after the other: eight bytes a point. A cloud whose points have no products is
// an error.
Result<PointLabels> trueClasses(const std::filesystem::path& cloud, const ClassMap& map, Progress& progress);

}  // namespace standpoint
