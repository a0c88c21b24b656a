// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "core/scratch_folder.h"
#include "emulated-ui/rehearsal/rehearsal.h"

namespace standpoint {

// An exercise as its own solution does it, with the scans that come of it; they go with this.
struct CarriedOutSolution {
  ScratchFolder folder;
  std::unique_ptr<Rehearsal> rehearsal;
  std::string refused;  // the first action that the device refused, and why; empty: none
};
// On this one of its devices; empty: the first. Progress is by actions. Errors: it has no solution, cannot be prepared,
// or was cancelled.
Result<CarriedOutSolution> carryOutSolution(const Exercise& exercise, const std::string& device, Progress& progress);

}  // namespace standpoint
