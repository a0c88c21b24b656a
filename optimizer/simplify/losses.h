// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "optimizer/simplify/mesh_job.h"

namespace standpoint {

// What each product lost, and what all lost together, from what each mesh lost. `before` is what `works` were prepared
// from.
void sumLosses(const Environment& before, const std::vector<MeshJob>& jobs, const std::vector<double>& residual_m,
               OptimizeResult& result);

// What went before anything was simplified, by its rule: counts with its distance from its own centre, as there is
// nothing left of it.
void addDropped(const Environment& environment, const OptimizeOptions& options, OptimizeResult& result);

// What went to reach the budget, and what was done without loss.
void reportDropped(const Environment& before, const std::vector<MeshJob>& jobs, Report& report);
void reportLossless(const Environment& before, const std::vector<MeshJob>& jobs, Report& report);

// Which engine made which shape: for each product, and a note for each engine but ours; a warning where the one that
// was asked for refused.
void reportEngines(const Environment& before, const std::vector<MeshJob>& jobs, const OptimizeOptions& options,
                   OptimizeResult& result);

// A warning for each share whose caps do not allow its budget; the least that they allow is what is left of it.
void checkBudgets(const std::vector<MeshJob>& jobs, const OptimizeOptions& options, OptimizeResult& result);

}  // namespace standpoint
