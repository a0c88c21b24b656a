// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "core/progress.h"
#include "core/result.h"
#include "optimizer/simplify/mesh_job.h"

namespace standpoint {

// All forms of each work, to choose from; then how far each is followed so that the budgets of the shares hold.
Result<void> makeAllLevels(std::vector<MeshJob>& jobs, Progress& progress);
void shareAll(std::vector<MeshJob>& jobs, const OptimizeOptions& options);

// Brings all works to the budgets of their shares: logs, shared by cost; then measured, and where a deviation is over
// its cap the work's levels are cut and the budget is shared again. Large smooth shapes are refined (collapse.h).
Result<void> simplify(std::vector<MeshJob>& jobs, const OptimizeOptions& options, Progress& progress);

}  // namespace standpoint
