// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"
#include "emulated-ui/classroom/assignment.h"

namespace standpoint {

// A variant that was tried out.
struct CheckedVariant {
  Variant variant;
  double seconds = 0;          // of the device's clock, that the solution takes
  double neighbour_score = 0;  // what the next variant's solution is worth here
};

// Variants that may be given: of each, the solution has full marks with a margin of a tenth to each limit that a
// measured figure must keep; doing nothing fails, and so does each of the exercise's known mistakes; the next variant's
// solution fails, so that copying is no way; the solution takes as long as with the others, within 15 %. At most
// `most`, drawn by the key; those that were refused are warnings in `report`. No variant that may be given is an error.
// An exercise that leaves no figure open has one variant.
Result<std::vector<CheckedVariant>> checkedVariants(const nlohmann::json& exercise, const std::string& file_name,
                                                    std::size_t most, const SigningKey& key, Report& report,
                                                    Progress& progress);

}  // namespace standpoint
