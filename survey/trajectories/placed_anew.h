// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/report.h"
#include "core/result.h"

namespace standpoint {

// Copies a cloud (formats as convertCloud, `as` a variant) whose points were placed by the trajectory `was` as `is` has
// it: each point by its own time, P' = T_is(t) T_was(t)⁻¹ P, so that one scan is solved as often as one likes. Files of
// trajectories of any format but SBET, in the coordinates of the cloud; the time of a point counts from the first
// sample of `was`. An error where the points have no times, where `is` leaves some of them out, or names the file.
Result<std::vector<std::filesystem::path>> placeAnew(const std::filesystem::path& in, const std::filesystem::path& out,
                                                     const std::string& as, const std::filesystem::path& was,
                                                     const std::filesystem::path& is, Report& report,
                                                     Progress& progress);

}  // namespace standpoint
